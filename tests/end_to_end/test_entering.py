"""Actors whose first action begins later enter: they are there by then, as that action states."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.unit.cli.shell import Shell

from .entering import FIRST, Run

SECOND = """
        parallel(duration: 2s):
            lead.drive() with:
                speed(15mps)
            npc.drive() with:
                position({position}, at: start)
                lane({lane})
                speed({speed})
        emit done
"""


@pytest.mark.parametrize(
    ("position", "lane", "speed", "s", "v", "begins"),
    [
        # Steady: it starts as far back as it drives in 5 s.
        ("30m, ahead_of: lead", 1, 15, 155.0, 15.0, 80.0),
        ("30m, ahead_of: lead", 1, 20, 155.0, 20.0, 55.0),
        ("20m, behind: lead", 3, 10, 105.0, 10.0, 55.0),
        # In the lane of the lead, from behind it: the lead is never in the way.
        ("20m, behind: lead", 2, 15, 105.0, 15.0, 30.0),
        ("400m", 1, 10, 400.0, 10.0, 350.0),
        # It stands where it has to be.
        ("300m", 1, 0, 300.0, 0.0, 300.0),
        # The lead has passed there: it comes behind it at 15 m/s, and brakes in 15/8 s (38 steps).
        ("30m, behind: lead", 2, 0, 95.0, 0.0, 95.0 - 15.0 * 3.1 - 7.5 * 1.9),
    ],
)
def test_second_phase(
    shell: Shell, position: str, lane: int, speed: int, s: float, v: float, begins: float
) -> None:
    text = SECOND.format(position=position, lane=lane, speed=f"{speed}mps")
    run = Run(shell, f"    do serial:\n        {FIRST.replace('    ' * 4, '    ' * 3)}{text}")
    assert run.ended.code == 0, run.ended.err
    assert "OSC8" not in run.ended.err
    assert run.at("npc", 0.0)["s"] == pytest.approx(begins)
    assert run.at("npc", 5.0)["s"] == pytest.approx(s)
    assert run.at("npc", 5.0)["v"] == pytest.approx(v)
    assert run.entering() == {"npc": (0.0, 5.0)}
    assert run.moves_steadily("npc")
    assert not run.collides()


def test_a_short_road_is_waited_on(shell: Shell) -> None:
    """40 m from the start at 15 m/s, half of the acceleration of a car: 60 m steady are too far."""
    run = Run(
        shell,
        """    do serial:
        wait elapsed(10s)
        npc.drive(duration: 2s) with:
            position(80m, at: start)
            lane(1)
            speed(15mps)
""",
    )
    assert run.ended.code == 0, run.ended.err
    states = run.states("npc")
    assert states[0]["v"] == 0.0
    here = run.at("npc", 10.0)
    assert (here["s"], here["v"]) == (pytest.approx(80.0), pytest.approx(15.0))
    assert run.moves_steadily("npc", most=2.5)


def test_no_way_in_is_refused(shell: Shell) -> None:
    run = Run(
        shell,
        """    do serial:
        wait elapsed(10s)
        npc.drive(duration: 2s) with:
            position(12m, at: start)
            lane(1)
            speed(30mps)
""",
    )
    assert run.ended.code == 5
    assert "top.osc:13:" in run.ended.err
    assert "npc has no way in to where its first action begins at 10.00 s" in run.ended.err
    assert "300.0 m of road are needed, and there are 12.0 m" in run.ended.err


def test_at_an_event(shell: Shell) -> None:
    """The lead passes 120 m at 7/1.5 s; nobody knows that before the run."""
    run = Run(
        shell,
        """    do parallel(duration: 8s):
        lead.drive() with:
            position(50m, at: start)
            lane(2)
            speed(15mps)
        serial:
            wait rise(lead.time > 0s) or elapsed(4s)
            npc.drive() with:
                position(20m, behind: lead, at: start)
                lane(3)
                speed(20mps)
""".replace("rise(lead.time > 0s) or elapsed(4s)", "elapsed(4.4s)"),
    )
    assert run.ended.code == 0, run.ended.err
    assert run.at("npc", 4.4)["s"] == pytest.approx(50.0 + 4.4 * 15.0 - 20.0)
    assert run.at("npc", 4.4)["v"] == pytest.approx(20.0)
    assert run.at("npc", 0.0)["s"] == pytest.approx(96.0 - 88.0)


def test_a_condition_that_depends_on_the_run(shell: Shell) -> None:
    run = Run(
        shell,
        """    do parallel(duration: 9s):
        lead.drive() with:
            position(50m, at: start)
            lane(2)
            speed(15mps)
        third.drive() with:
            position(100m, at: start)
            lane(2)
            speed(5mps)
        serial:
            wait lead.object_distance(reference: third, direction: longitudinal) < 10m
            emit go
        serial:
            wait @go
            npc.drive() with:
                position(30m, behind: lead, at: start)
                lane(1)
                speed(8mps)
""",
    )
    assert run.ended.code == 0, run.ended.err
    ((begin, end),) = run.entering().values()
    assert begin == 0.0
    assert 0.0 < end < 5.0
    assert run.at("npc", end)["s"] == pytest.approx(run.at("lead", end)["s"] - 30.0)
    assert run.moves_steadily("npc")


@pytest.mark.parametrize("policy", ["race", "first", "seeded"])
def test_inside_one_of(shell: Shell, policy: str) -> None:
    run = Run(
        shell,
        """    do serial:
        lead.drive(duration: 3s) with:
            position(50m, at: start)
            lane(2)
            speed(15mps)
        one_of:
            npc.drive(duration: 2s) with:
                position(30m, ahead_of: lead, at: start)
                lane(1)
                speed(15mps)
            lead.drive(duration: 2s)
""",
        "--one-of",
        policy,
    )
    assert run.ended.code == 0, run.ended.err
    starts = [x["t"] for x in run.lines if x["kind"] == "action" and x["name"] == "npc drive"]
    if starts:
        assert run.at("npc", 3.0)["s"] == pytest.approx(125.0)
        assert run.moves_steadily("npc")


def test_on_an_arc_beside_the_centre_of_the_lane(shell: Shell) -> None:
    """Steps on an arc and distances along it agree: it arrives within a millimetre."""
    run = Run(
        shell,
        """    do serial:
        lead.drive(duration: 5s) with:
            position(30m, at: start)
            lane(1)
            speed(15mps)
        npc.drive(duration: 2s) with:
            position(70m, at: start)
            lane(1)
            lateral(0.5m, side: left, at: start)
            speed(12mps)
""",
        map_file="curve",
    )
    assert run.ended.code == 0, run.ended.err
    here = run.at("npc", 5.0)
    found = [here[key] for key in ("s", "offset", "v")]
    assert found == pytest.approx([70.0, 0.5, 12.0], abs=1e-3)


def test_a_lane_change_is_the_first_action(shell: Shell) -> None:
    run = Run(
        shell,
        f"""    do serial:
        {FIRST.replace("    " * 4, "    " * 3)}
        npc.change_lane(side: left, duration: 3s) with:
            position(30m, ahead_of: lead, at: start)
            lane(1, at: start)
            speed(15mps, at: start)
""",
    )
    assert run.ended.code == 0, run.ended.err
    assert run.at("npc", 5.0)["s"] == pytest.approx(155.0)
    assert run.states("npc")[-1]["lane"] == -3


def test_who_has_acted_does_not_enter(shell: Shell) -> None:
    """What its earlier actions have not brought about fails, as before."""
    text = SECOND.format(position="30m, ahead_of: lead", lane=1, speed="15mps")
    later = """        npc.drive(duration: 2s) with:
            position(60m, ahead_of: lead, at: start)
"""
    first = FIRST.replace("    " * 4, "    " * 3)
    run = Run(shell, f"    do serial:\n        {first}{text}{later}")
    assert run.ended.code == 5
    assert "distance ahead of lead is 30.00 m, not 60.00 m" in run.ended.out


def test_a_finished_trace_is_verified(shell: Shell) -> None:
    text = SECOND.format(position="30m, ahead_of: lead", lane=1, speed="15mps")
    run = Run(shell, f"    do serial:\n        {FIRST.replace('    ' * 4, '    ' * 3)}{text}")
    assert run.ended.code == 0
    verified = shell("verify", "trace.jsonl", "top.osc")
    assert verified.code == 0, verified.err


def test_a_scenario_that_places_its_actor_second(shell: Shell) -> None:
    path = shell.write(
        "top.osc",
        """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.joins:
    other: vehicle
    do actor.drive(duration: 2s) with:
        position(25m, ahead_of: other, at: start)
        lane(1)
        speed(15mps)

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    lead, npc: vehicle
    do serial:
        lead.drive(duration: 4s) with:
            position(50m, at: start)
            lane(2)
            speed(15mps)
        npc.joins(other: lead)
""",
    )
    ended = shell("run", "--scenario", "top", "--trace", "trace.jsonl", path)
    assert ended.code == 0, ended.err
    lines = [json.loads(x) for x in Path("trace.jsonl").read_text("utf-8").splitlines()]
    (there,) = (x for x in lines if x["kind"] == "state" and (x["actor"], x["t"]) == ("npc", 4.0))
    assert there["s"] == pytest.approx(135.0)


@pytest.mark.parametrize("seed", ["0", "1", "2", "3"])
def test_what_holds_at_the_end_of_a_range_of_durations_is_planned(shell: Shell, seed: str) -> None:
    run = Run(
        shell,
        """    do parallel:
        lead.drive() with:
            lane(2, at: start)
            position(100m, at: start)
            speed(20mps)
        npc.drive(duration: [4s..6s]) with:
            lane(3, at: start)
            position(30m, ahead_of: lead, at: start)
            speed(20mps, at: start)
            lane(2, at: end)
            position(40m, ahead_of: lead, at: end)
            speed(22mps, at: end)
""",
        "--seed",
        seed,
    )
    assert run.ended.code == 0, run.ended.err
    lead, npc = run.states("lead")[-1], run.states("npc")[-1]
    assert 4.0 < npc["t"] < 6.0
    assert npc["x"] - lead["x"] == pytest.approx(40.0, abs=0.1)
    assert npc["v"] == pytest.approx(22.0, abs=0.1)
    assert npc["y"] == pytest.approx(lead["y"], abs=0.05)
