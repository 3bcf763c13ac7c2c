"""Modifiers of the user stand for their bodies; overrides may stand in a `with` block."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import Severity
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, ScenarioError
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

modifier vehicle.starting of vehicle.drive:
    v: speed = 10mps
    number: uint = 2
    lane(number, at: start)
    position(50m, at: start)
    speed(v, at: start)

modifier vehicle.careful:
    limit: speed
    margin: speed = 2mps
    keep(limit <= 20mps)
    actor.speed(limit - margin)

modifier steady of vehicle.drive:
    v: speed with:
        keep(it == 6mps)
    speed(v)

modifier bare:
    limit: speed
    speed(limit)

modifier again:
    again()

modifier quick_start:
    v: speed
    starting(v: v, number: 3)
    keep_lane()

scenario own_modifiers:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do """


BODY = """serial:
        first: ego.drive(duration: 2s) with:
            starting()
            careful(12mps)
        second: ego.drive(duration: 6s) with:
            ego.careful(limit: 8mps, margin: 1mps)
        third: ego.drive(duration: 6s) with:
            steady()
"""


FIRST = HEAD.count("\n") + 1


def speed_at_end(trace: Trace, line: int) -> float:
    """Speed when the action of a line ends (m/s)."""
    return float(trace.state("ego", trace.action(f"case.osc:{line}", "end"))["v"])


def test_bodies_are_carried_out(load: Load, tmp_path: Path) -> None:
    trace = run(load(emit(asam(HEAD + BODY, tmp_path))))
    assert trace.status == "success"
    start = trace.states("ego")[0]
    assert (start["v"], start["lane"]) == (10.0, -3)
    assert speed_at_end(trace, FIRST + 1) == pytest.approx(10.0)
    assert speed_at_end(trace, FIRST + 4) == pytest.approx(7.0)
    assert speed_at_end(trace, FIRST + 6) == pytest.approx(6.0)


def test_modifiers_nest(load: Load, tmp_path: Path) -> None:
    body = """ego.drive(duration: 1s) with:
        quick_start([15mps..16mps])
"""
    trace = run(load(emit(asam(HEAD + body, tmp_path))))
    start = trace.states("ego")[0]
    assert 15.0 <= start["v"] <= 16.0
    assert start["lane"] == -2


def refused(body: str, tmp_path: Path) -> list[tuple[str, int, str]]:
    path = tmp_path / "case.osc"
    path.write_text(HEAD + body, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    assert compilation.ir is None or compilation.module is None
    return [
        (d.code, d.primary.line, d.message)
        for d in compilation.diagnostics
        if d.primary is not None and d.severity is Severity.ERROR
    ]


@pytest.mark.parametrize(
    ("body", "code", "line", "message"),
    [
        (
            "ego.change_lane(1) with:\n        quick_start(5mps)\n",
            "OSC406",
            FIRST + 1,
            "modifier `starting` does not apply to `vehicle.change_lane`",
        ),
        (
            "ego.drive(duration: 1s) with:\n        again()\n",
            "OSC508",
            HEAD[: HEAD.index("    again()")].count("\n") + 1,
            "modifier `again`, which applies itself, is not supported",
        ),
        (
            "serial:\n        ego.drive(duration: 1s) with:\n            careful(25mps)\n",
            "OSC423",
            FIRST + 2,
            "argument `careful.limit` contradicts a constraint",
        ),
    ],
)
def test_what_does_not_fit_is_refused(
    body: str, code: str, line: int, message: str, tmp_path: Path
) -> None:
    assert (code, line, message) in refused(body, tmp_path)


def test_what_nobody_says_of_a_modifier_is_left_to_settings(load: Load, tmp_path: Path) -> None:
    body = "ego.drive(duration: 1s) with:\n        bare()\n"
    scenario = load(emit(asam(HEAD + body, tmp_path)))
    with pytest.raises(ScenarioError, match=r"leaves ego\.drive\.bare\.limit open"):
        run(scenario)


def test_a_constraint_of_a_modifier_is_checked_before_the_run(load: Load, tmp_path: Path) -> None:
    head = HEAD.replace("    ego: vehicle\n", "    ego: vehicle\n    v: speed = 15mps\n")
    body = "ego.drive(duration: 1s) with:\n        careful(v)\n        starting()\n"
    scenario = load(emit(asam(head + body, tmp_path)))
    assert run(scenario).status == "success"
    with pytest.raises(ScenarioError, match="the scenario allows at most 20"):
        run(scenario, RunSettings(set={"v": 25.0}))


OVERRIDE = """parallel:
        cruise: ego.drive() with:
            starting()
            override(cruise, brake)
        warning: serial:
            wait elapsed(2s)
            brake: ego.change_speed(target: 6mps, rate_profile: constant, rate_peak: 4mpss)
"""


def test_an_override_of_an_invocation(load: Load, tmp_path: Path) -> None:
    trace = run(load(emit(asam(HEAD + OVERRIDE, tmp_path))))
    assert trace.status == "success"
    assert trace.states("ego")[-1]["t"] == pytest.approx(3.0)  # 4 m/s at 4 m/s^2 from 2 s on
    assert trace.states("ego")[-1]["v"] == pytest.approx(6.0)


def test_an_override_of_a_composition_is_the_one_of_the_scenario(tmp_path: Path) -> None:
    inside = OVERRIDE.replace("            override(cruise, brake)\n", "")
    whole = inside + "    with:\n        override(cruise, brake, when_active)\n"
    (scenario,) = asam(HEAD + whole, tmp_path).scenarios
    (override,) = scenario.overrides
    assert (override.overridden, override.by, override.mode) == ("cruise", "brake", "when_active")


def test_an_override_between_others_is_refused(tmp_path: Path) -> None:
    body = OVERRIDE.replace("            override(cruise, brake)\n", "").replace(
        "rate_peak: 4mpss)\n", "rate_peak: 4mpss)\n            last: ego.keep_speed(duration: 1s)"
    )
    body += " with:\n                override(cruise, brake)\n"
    ((code, _, message),) = refused(body, tmp_path)
    assert code == "OSC508"
    assert "others than parts of the `invocation`" in message
