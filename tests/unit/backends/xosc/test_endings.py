"""A `parallel` of an action and a movement without end is over when it is in the embedded world."""

import json
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.catalogue import catalogue
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions, XmlOptions
from osc2tx_runtime import RunSettings, run_scenario
from osc2tx_runtime.errors import UnsupportedError
from tests.unit.backends.xosc.documents import compiled, documents, module_of
from tests.xosc.parity import played

DT = 0.05
SOURCE = """\
import osc.standard.all

namespace null use std, stdtypes

scenario endings:
    road: map with:
        keep(it.map_file == "highway.xodr")
    sky: environment
    ego: vehicle
    other: vehicle
    cart: trailer
    event over
    {coupling}
    do parallel(duration: 4s):
        ego.drive() with:
            lane(2, at: start)
            position(100m, at: start)
            speed(10mps, at: start)
        other.drive() with:
            lane(3, at: start)
            position(100m, at: start)
            speed(10mps, at: start)
        serial:
            wait elapsed(1s)
            parallel:
                {action}
                ego.drive()
            emit over
            wait elapsed(1s)
"""
ACTIONS = {
    "vehicle.disconnect_trailer": "ego.disconnect_trailer()",
    "movable_object.assign_speed": "other.assign_speed(12mps)",
    "movable_object.change_speed": "other.change_speed(12mps)",
    "environment.rain": "sky.rain(5mmph)",
    "vehicle.set_lights": 'other.set_lights("low_beam")',
}


def in_the_world(path: Path, options: CompileOptions) -> float | None:
    """Return when the event occurs; `None` if the world refuses to wait for it."""
    with scenarios_of_module(emit(module_of(compiled(path, options)))) as scenarios:
        try:
            result = run_scenario(scenarios["endings"], RunSettings(dt=DT))
        except UnsupportedError as error:
            assert "never ends by itself" in error.message
            return None
    lines = map(json.loads, result.trace_lines)
    return next(x["t"] for x in lines if x["kind"] == "event" and x["name"] == "over")


@pytest.mark.parametrize("name", sorted(ACTIONS))
def test_what_follows_begins_when_it_does_in_the_world(name: str, tmp_path: Path) -> None:
    path = tmp_path / "endings.osc"
    coupling = "ego.tow_trailer(cart)" if "trailer" in name else ""
    path.write_text(SOURCE.format(action=ACTIONS[name], coupling=coupling), encoding="utf-8")
    options = CompileOptions(dialect="carla")
    should = in_the_world(path, options)
    assert (should is None) == (catalogue().actions[name].ends == "instant")
    compilation = compiled(path, options)
    said = {report.code for report in compilation.diagnostics}
    assert ("OSC432" in said) == (should is None)
    (document,) = documents(compilation, XmlOptions(version="1.3", allow_approx=True))
    if should is None:
        (obstacle,) = document.report.obstacles
        assert document.xml is None and "never ends by itself" in obstacle.reason
        return
    assert document.xml is not None, document.report.obstacles
    assert played(document.xml, DT).starts["emit_over"] == pytest.approx(should, abs=4 * DT)


KEPT = """\
import osc.standard.all

namespace null use std, stdtypes

scenario kept:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    event late
    event reached
    do parallel(duration: 8s):
        serial:
            wait elapsed(6s)
            emit late
            wait elapsed(2s)
        serial:
            {composition}:
                ego.drive() with:
                    lane(2)
                    position(100m, at: start)
                    speed(10mps, at: start)
                    speed(15mps, at: end)
            with:
                until @late
            emit reached
            ego.drive()
"""


@pytest.mark.parametrize("composition", ["serial", "parallel"])
def test_a_goal_is_kept_until_the_event_of_a_composition(composition: str, tmp_path: Path) -> None:
    path = tmp_path / "kept.osc"
    path.write_text(KEPT.format(composition=composition), encoding="utf-8")
    (document,) = documents(compiled(path, CompileOptions()), XmlOptions(version="1.3"))
    assert document.xml is not None, document.report.obstacles
    assert played(document.xml, DT).starts["emit_reached"] == pytest.approx(6.0, abs=4 * DT)
