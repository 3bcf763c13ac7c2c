"""Assignments take no scenario time, whatever the step; in parallel they may not contradict."""

import json
from collections.abc import Callable
from itertools import permutations
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.errors import SlotConflict
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    env: environment
    far: position_3d with:
        keep(it.x == 600m)
        keep(it.y == -5.25m)
        keep(it.z == 0m)
    turned: orientation_3d with:
        keep(it.yaw == 30deg)
        keep(it.pitch == 0deg)
        keep(it.roll == 0deg)
    event told(x: length, v: speed)
    event done
"""


@pytest.fixture
def play(load: Load, tmp_path: Path) -> Callable[..., Trace]:
    """Run a `do` block in the scenario above."""

    def play(body: str, **settings: float) -> Trace:
        lines = "".join(f"    {line}\n" for line in body.strip("\n").splitlines())
        made = load(emit(asam(HEAD + lines, tmp_path)))
        return run(made, RunSettings(**settings))  # type: ignore[arg-type]

    return play


def arguments(trace: Trace) -> list[dict[str, float]]:
    lines = map(json.loads, trace.text.splitlines())
    return [e["arguments"] for e in lines if e["kind"] == "event" and e["name"] == "told"]


@pytest.mark.parametrize("dt", [0.01, 0.05, 0.1, 0.07])
def test_no_drift(play: Callable[..., Trace], dt: float) -> None:
    """Twenty pairs of assignments between waits of one step: their number does not count."""
    pairs = "\n".join(
        f"    ego.assign_speed({n + 1}mps)\n    ego.assign_acceleration(1mpss)\n"
        f"    wait elapsed({dt}s)"
        for n in range(20)
    )
    trace = play(f"do serial:\n{pairs}\n    emit done", dt=dt)
    assert trace.time == pytest.approx(20 * dt)
    v = [state["v"] for state in trace.of_kind("state")]
    assert v == pytest.approx([*range(1, 21), 20])


def test_place_and_speed_of_an_event_are_the_new_ones(play: Callable[..., Trace]) -> None:
    trace = play("""
do serial:
    ego.assign_speed(speed: 10mps)
    ego.assign_position(position: far)
    emit told(ego.pose.position.x, ego.speed)
    wait elapsed(1s)
    emit told(ego.pose.position.x, ego.speed)
""")
    first, second = arguments(trace)
    assert (first["x"], first["v"]) == (600.0, 10.0)
    assert (second["x"], second["v"]) == pytest.approx((610.0, 10.0))


@pytest.mark.parametrize("dt", [0.05, 0.1])
def test_an_acceleration_acts_from_its_instant_on(play: Callable[..., Trace], dt: float) -> None:
    trace = play(
        """
do serial:
    ego.assign_speed(speed: 10mps)
    ego.assign_acceleration(2mpss)
    ego.keep_acceleration(duration: 3s)
""",
        dt=dt,
    )
    for state in trace.of_kind("state"):
        assert state["v"] == pytest.approx(10.0 + 2.0 * state["t"])


def test_different_things_are_assigned_together_in_any_order(play: Callable[..., Trace]) -> None:
    members = [
        "    ego.assign_speed(speed: 10mps)",
        "    ego.assign_orientation(orientation: turned)",
        "    ego.assign_position(position: far)",
        "    env.air(temperature: 300K)",
    ]
    texts = {
        json.dumps([{**line, "source": ""} for line in trace.lines if line["kind"] == "state"])
        for order in permutations(members)
        for trace in [play("\n".join(["do serial:", "    parallel:", *(f"    {m}" for m in order),
                                      "    wait elapsed(0.1s)"]))]
    }  # fmt: skip
    assert len(texts) == 1
    first = json.loads(texts.pop())[0]
    assert (first["x"], first["y"], first["v"]) == (600.0, -5.25, 10.0)
    assert first["h"] == pytest.approx(0.523599)


@pytest.mark.parametrize(
    ("one", "other", "what"),
    [
        ("ego.assign_speed(10mps)", "ego.assign_speed(12mps)", "speed ego"),
        ("ego.assign_acceleration(1mpss)", "ego.assign_acceleration(2mpss)", "acceleration ego"),
        ("env.air(temperature: 280K)", "env.air(temperature: 290K)", "environment temperature"),
    ],
)
def test_parallel_assignments_of_one_quantity(
    play: Callable[..., Trace], one: str, other: str, what: str
) -> None:
    for pair in ((one, other), (other, one)):
        with pytest.raises(SlotConflict, match=what):
            play("do parallel:\n" + "".join(f"    {member}\n" for member in pair))


def test_one_of_them_may_come_later_in_the_instant(play: Callable[..., Trace]) -> None:
    with pytest.raises(SlotConflict, match="speed ego"):
        play("""
do parallel:
    ego.assign_speed(10mps)
    serial:
        ego.assign_position(position: far)
        emit done
        ego.assign_speed(12mps)
""")


def test_equal_ones_are_no_conflict(play: Callable[..., Trace]) -> None:
    trace = play("do parallel:\n    ego.assign_speed(10mps)\n    ego.assign_speed(10mps)")
    assert (trace.status, trace.time) == ("success", 0.0)


@pytest.mark.parametrize(
    "beside", ["ego.change_speed(target: 20mps)", "ego.drive() with:\n        speed(5mps)"]
)
def test_who_has_the_speed_beside_an_assignment(play: Callable[..., Trace], beside: str) -> None:
    members = [
        f"    {beside}\n",
        "    serial:\n        wait elapsed(1s)\n        ego.assign_speed(1mps)\n"
        "        wait elapsed(1s)\n",
    ]
    for order in (members, members[::-1]):
        with pytest.raises(SlotConflict, match="longitudinal slot of ego"):
            play("do parallel:\n" + "".join(order))


def test_an_assignment_that_is_cut_short_is_none(play: Callable[..., Trace]) -> None:
    """The emit needs no assignment, so it wins before there is one."""
    trace = play("do one_of:\n    ego.assign_speed(10mps)\n    emit done")
    assert [state["v"] for state in trace.of_kind("state")] == [0.0]
