"""Actors that follow a path or trajectory enter at its begin."""

from __future__ import annotations

import pytest

from tests.unit.cli.shell import Shell

from .entering import FIRST, Run

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
