"""Actors whose first action begins later enter: they are there by then, as that action states."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any

import pytest

from tests.unit.cli.shell import Shell

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "{map}.xodr")
{cast}
    event go
    event done
"""
CAST = {"lead": "vehicle", "npc": "vehicle", "third": "vehicle", "ped": "person"}
LEAD = """lead.drive({how}) with:
                position({at}, at: start)
                lane({lane})
                speed({speed})"""


class Run:
    """A run, with its trace."""

    def __init__(self, shell: Shell, body: str, *options: str, map_file: str = "highway") -> None:
        cast = "\n".join(f"    {who}: {kind}" for who, kind in CAST.items() if f"{who}." in body)
        path = shell.write("top.osc", HEAD.format(map=map_file, cast=cast) + body)
        self.ended = shell("run", "--trace", "trace.jsonl", *options, path)
        self.lines: list[dict[str, Any]] = []
        if self.ended.code in (0, 5) and Path("trace.jsonl").exists():
            text = Path("trace.jsonl").read_text(encoding="utf-8")
            self.lines = [json.loads(line) for line in text.splitlines()]

    def states(self, actor: str) -> list[dict[str, Any]]:
        return [x for x in self.lines if x["kind"] == "state" and x["actor"] == actor]

    def at(self, actor: str, time: float) -> dict[str, Any]:
        return next(x for x in self.states(actor) if abs(x["t"] - time) < 1e-6)

    def entering(self) -> dict[str, tuple[float, float]]:
        """Return from when to when actors are on their way in."""
        times: dict[str, list[float]] = {}
        for line in self.lines:
            if line["kind"] == "action" and line["name"].endswith(" enter"):
                times.setdefault(line["actor"], []).append(line["t"])
        return {actor: (begin, end) for actor, (begin, end) in times.items()}

    def moves_steadily(self, actor: str, most: float = 8.0) -> bool:
        """Return whether an actor never jumps: each step fits its speeds."""
        states = self.states(actor)
        for one, two in itertools.pairwise(states):
            way = math.dist((one["x"], one["y"]), (two["x"], two["y"]))
            mean = 0.5 * abs(one["v"] + two["v"]) * 0.05
            if abs(way - mean) > 0.02 or abs(two["v"] - one["v"]) > most * 0.05 + 1e-6:
                return False
        return True

    def collides(self) -> bool:
        return any(line["kind"] == "collision" for line in self.lines)


FIRST = LEAD.format(how="duration: 5s", at="50m", lane="2", speed="15mps")
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


def test_relative_in_time_and_lane(shell: Shell) -> None:
    """1 s behind the lead at its speed is 15 m behind it."""
    run = Run(
        shell,
        """    do parallel(duration: 8s):
        lead.drive() with:
            position(50m, at: start)
            lane(2)
            speed(15mps)
        serial:
            wait elapsed(2s)
            emit go
        serial:
            wait @go
            npc.drive() with:
                position(time: 1s, behind: lead, at: start)
                lane(same_as: lead, at: start)
                speed(same_as: lead, at: start)
""",
    )
    assert run.ended.code == 0, run.ended.err
    here = run.at("npc", 2.0)
    assert (here["s"], here["lane"], here["v"]) == (pytest.approx(65.0), -3, pytest.approx(15.0))


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


def test_relative_to_one_that_enters_too(shell: Shell) -> None:
    run = Run(
        shell,
        """    do serial:
        lead.drive(duration: 4s) with:
            position(100m, at: start)
            lane(2)
            speed(15mps)
        parallel(duration: 2s):
            third.drive() with:
                position(20m, behind: npc, at: start)
                lane(1)
                speed(12mps)
            npc.drive() with:
                position(10m, ahead_of: lead, at: start)
                lane(1)
                speed(12mps)
""",
    )
    assert run.ended.code == 0, run.ended.err
    assert run.at("npc", 4.0)["s"] == pytest.approx(170.0)
    assert run.at("third", 4.0)["s"] == pytest.approx(150.0)
    assert run.at("third", 0.0)["s"] == pytest.approx(102.0)
    assert not run.collides()


def test_who_is_in_the_way_is_avoided(shell: Shell) -> None:
    """The lead stands where a steady way in would begin; the actor waits ahead of it."""
    run = Run(
        shell,
        """    do parallel(duration: 7s):
        lead.drive() with:
            position(60m, at: start)
            lane(1)
            speed(0mps)
        serial:
            wait elapsed(5s)
            npc.drive() with:
                position(110m, at: start)
                lane(1)
                speed(15mps)
""",
    )
    assert run.ended.code == 0, run.ended.err
    assert run.at("npc", 0.0)["s"] > 62.0
    assert run.at("npc", 5.0)["s"] == pytest.approx(110.0)
    assert run.at("npc", 5.0)["v"] == pytest.approx(15.0)
    assert not run.collides()


def test_a_place_that_is_taken_is_refused(shell: Shell) -> None:
    run = Run(
        shell,
        """    do parallel(duration: 7s):
        lead.drive() with:
            position(60m, at: start)
            lane(1)
            speed(0mps)
        serial:
            wait elapsed(5s)
            npc.drive() with:
                position(61m, at: start)
                lane(1)
                speed(5mps)
""",
    )
    assert run.ended.code == 5
    assert "npc overlaps lead by 3.60 m 61 m from the start" in run.ended.err


def test_a_walker_sets_out(shell: Shell) -> None:
    run = Run(
        shell,
        """    crossing_begin: position_3d with:
        keep(it.x == 100m)
        keep(it.y == -20m)
        keep(it.z == 0m)
    do serial:
        lead.drive(duration: 4s) with:
            position(50m, at: start)
            lane(2)
            speed(10mps)
        ped.walk(duration: 2s) with:
            position(at_point: crossing_begin, project_on_route: false, at: start)
            yaw(90deg, at: start)
            speed(1.4mps, at: start)
""",
    )
    assert run.ended.code == 0, run.ended.err
    here = run.at("ped", 4.0)
    assert (here["x"], here["y"]) == (pytest.approx(100.0), pytest.approx(-20.0))
    assert here["v"] == pytest.approx(1.4)
    assert run.at("ped", 0.0)["v"] == 0.0
    assert -21.5 < run.at("ped", 0.0)["y"] < -20.0


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


WAY = """    begin: pose_3d with:
        keep(it.position.x == 100m)
        keep(it.position.y == {y}m)
        keep(it.position.z == 0m)
    far: pose_3d with:
        keep(it.position.x == {x}m)
        keep(it.position.y == {to}m)
        keep(it.position.z == 0m)
    way: path with:
        keep(it.points == [begin, far])
        keep(it.interpolation == straight_line)
    do serial:
        {first}
        {action}
            speed({speed}mps)
"""
WAYS = [
    # 20 m north at 1.4 m/s; a walker sets out just before.
    ("ped.follow_path(absolute: way) with:", (100, -20, 0), 1.4, 5.0 + 20.0 / 1.4),
    # In a lane for 100 m at 10 m/s.
    ("npc.follow_path(absolute: way) with:", (200, -12.25, -12.25), 10.0, 15.0),
    ("npc.drive() with:\n            along(way)", (200, -12.25, -12.25), 10.0, 15.0),
    ("npc.replay_path(absolute: way) with:", (200, -12.25, -12.25), 10.0, 15.0),
]


@pytest.mark.parametrize(("action", "line", "speed", "ends"), WAYS)
def test_who_follows_a_path_enters_at_its_begin(
    shell: Shell, action: str, line: tuple[float, float, float], speed: float, ends: float
) -> None:
    x, y, to = line
    first = FIRST.replace("    " * 4, "    " * 3)
    run = Run(shell, WAY.format(x=x, y=y, to=to, first=first, action=action, speed=speed))
    assert run.ended.code == 0, run.ended.err
    assert "OSC81" not in run.ended.err
    who = action[:3]
    here = run.at(who, 5.0)
    assert [here[key] for key in ("x", "y", "v")] == pytest.approx([100.0, y, speed])
    assert run.moves_steadily(who)
    assert run.states(who)[-1]["t"] == pytest.approx(ends, abs=0.051)
    # A document would start it elsewhere: it says why there is none.
    built = shell("build", "--target", "xosc", "-o", "out", "top.osc")
    assert "a run plans how the actor gets to the path by then" in built.err


TIMED = """    begin: pose_3d with:
        keep(it.position.x == {x}m)
        keep(it.position.y == -12.25m)
        keep(it.position.z == 0m)
    far: pose_3d with:
        keep(it.position.x == 200m)
        keep(it.position.y == -12.25m)
        keep(it.position.z == 0m)
    way: trajectory with:
        keep(it.points == [begin, far])
        keep(it.time_stamps == [0s, 10s])
        keep(it.interpolation == straight_line)
    do serial:
        {first}
        {action}
"""
TRAJECTORIES = [
    "npc.follow_trajectory(absolute: way)",
    "npc.replay_trajectory(absolute: way)",
    "npc.drive() with:\n            along_trajectory(way)",
]


@pytest.mark.parametrize("action", TRAJECTORIES)
def test_who_follows_a_trajectory_enters_with_its_speed(shell: Shell, action: str) -> None:
    first = FIRST.replace("    " * 4, "    " * 3)
    run = Run(shell, TIMED.format(x=100, first=first, action=action))
    assert run.ended.code == 0, run.ended.err
    assert "OSC81" not in run.ended.err
    here = run.at("npc", 5.0)
    assert [here[key] for key in ("x", "y", "v")] == pytest.approx([100.0, -12.25, 10.0])
    assert run.moves_steadily("npc")
    assert run.states("npc")[-1]["t"] == pytest.approx(15.0, abs=0.051)
    assert run.entering() == {"npc": (0.0, 5.0)}


@pytest.mark.parametrize(("action", "code"), [*zip(TRAJECTORIES, (5, 0, 5), strict=True)])
def test_only_a_replay_begins_where_no_way_leads(shell: Shell, action: str, code: int) -> None:
    """No speed of arrival fits in 2 m of lane before the begin, not even from a standstill."""
    first = FIRST.replace("    " * 4, "    " * 3)
    body = TIMED.format(x=2, first=first, action=action)
    run = Run(shell, body.replace("200m", "402m"))
    assert run.ended.code == code, run.ended.err
    if code:
        assert "npc has no way in" in run.ended.err
    else:
        assert run.at("npc", 5.05)["x"] == pytest.approx(2.0 + 0.05 * 40.0)


@pytest.mark.parametrize(("map_file", "way"), [("highway", 1.0), ("urban_crossing", -1.0)])
@pytest.mark.parametrize("turned", ["", "yaw(angle: 90deg, relative_to: lead)"])
def test_a_pedestrian_enters_beside_the_lane_of_another(
    shell: Shell, map_file: str, way: float, turned: str
) -> None:
    """2 s later, 40 m ahead of the car and 4 m to its right."""
    run = Run(
        shell,
        f"""    do parallel:
        lead.drive(duration: 8s) with:
            lane(1, at: start)
            position(20m, at: start)
            speed(8mps)
        serial:
            wait elapsed(2s)
            ped.walk(duration: 5s) with:
                position(40m, ahead_of: lead, at: start)
                lateral(4m, side_of: lead, side: right, at: start)
                speed(1.5mps)
                {turned or "avoid_collisions(false)"}
""",
        map_file=map_file,
    )
    assert run.ended.code == 0, run.ended.err
    lead, ped = run.at("lead", 2.0), run.at("ped", 2.0)
    assert way * (ped["x"] - lead["x"]) == pytest.approx(40.0, abs=1e-3)
    assert way * (lead["y"] - ped["y"]) == pytest.approx(4.0, abs=1e-3)
    assert run.moves_steadily("ped")
    moved = run.at("ped", 7.0)["y" if turned else "x"] - ped["y" if turned else "x"]
    assert way * moved == pytest.approx(7.5, abs=1e-3)
    assert "OSC811" not in run.ended.err


def test_a_heading_counts_from_the_road_on_both_carriageways(shell: Shell) -> None:
    """A pedestrian walks straight over the middle line of the road."""
    run = Run(
        shell,
        """    do ped.walk(duration: 6s) with:
        position(80m, at: start)
        lane(1, at: start)
        yaw(angle: 90deg)
        speed(1.5mps)
""",
        map_file="urban_crossing",
    )
    assert run.ended.code == 0 and "OSC811" not in run.ended.err
    start, end = run.at("ped", 0.0), run.at("ped", 6.0)
    assert end["x"] == pytest.approx(start["x"], abs=1e-6)
    assert (start["lane"] < 0.0) is not (end["lane"] < 0.0)
    assert abs(end["y"] - start["y"]) == pytest.approx(9.0, abs=1e-3)


def test_one_that_is_kept_relative_to_another_enters_with_its_speed(shell: Shell) -> None:
    """Its place at the start and at the end are stated, its speed is open."""
    run = Run(
        shell,
        """    do parallel:
        lead.drive(duration: 8s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(20mps)
        serial:
            wait elapsed(2s)
            npc.drive(duration: 6s) with:
                lane(side_of: lead, side: left)
                position(25m, behind: lead, at: start)
                position(15m, ahead_of: lead, at: end)
""",
    )
    assert run.ended.code == 0, run.ended.err
    assert run.at("npc", 2.0)["v"] == pytest.approx(20.0, abs=1e-6)
    for time, ahead in ((2.0, -25.0), (8.0, 15.0)):
        assert run.at("npc", time)["x"] - run.at("lead", time)["x"] == pytest.approx(ahead, abs=0.1)
    assert run.moves_steadily("npc")


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
