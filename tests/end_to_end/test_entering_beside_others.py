"""Actors enter relative to others, and past them; so do pedestrians."""

from __future__ import annotations

import pytest

from tests.unit.cli.shell import Shell

from .entering import Run


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
