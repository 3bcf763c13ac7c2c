"""Actors on the roads that a map has for a scenario: where they start, and where they go."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    CompoundRoute,
    Lane,
    LaneSection,
    Map,
    Road,
    RoadPath,
    Scenario,
    ScenarioError,
    Serial,
    Vehicle,
    Wait,
    elapsed,
)
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.placing.map_solver import MapSolver
from osc2tx_runtime.modifiers import (
    along,
    lane,
    lane_side,
    number_of_lanes,
    on_path,
    position,
    roads_follow_in_junction,
    set_map_file,
    speed,
)
from osc2tx_runtime.opendrive import RoadMap

Load = Callable[[str], RoadMap]


class Placed(Scenario):
    """A car on a lane that is chosen by what is beside it."""

    name = "placed"
    source = "placed.osc"
    file = "highway"

    def declare(self) -> None:
        self.net = Map()
        self.one, self.other, self.way = Lane(), Lane(), LaneSection()
        self.car, self.second = Vehicle(), Vehicle()

    def placement(self) -> None:
        self.require(self.net, set_map_file(self.file))
        self.require(self.net, lane_side(self.one, "left", self.other, 2))
        self.require(self.net, number_of_lanes(self.way, 3))
        self.place(self.car, along(self.one), position(30.0), speed(10.0))
        self.place(self.second, along(self.way, start_offset=5.0), lane(2), position(30.0))

    def behavior(self) -> Behaviour:
        return Wait(elapsed(0.1))


def test_actors_start_on_what_was_chosen(run: Callable[..., Any]) -> None:
    """Two lanes left of the outermost; and against s, from the end of the road of 2 km."""
    done = run(Placed)
    start = done.at("car", 0.0)
    assert (start["road"], start["lane"], start["s"]) == ("1", -2, pytest.approx(30.0))
    other = done.at("second", 0.0)
    assert other["lane"] == 2 and other["s"] == pytest.approx(2000.0 - 35.0, abs=1e-3)


def test_two_maps_are_one_too_many(run: Callable[..., Any]) -> None:
    class Two(Placed):
        def declare(self) -> None:
            super().declare()
            self.net = Map(map_file="merge")

    with pytest.raises(ScenarioError, match="two maps are named: merge and highway"):
        run(Two)


def turning(direction: Any, **more: Any) -> type[Scenario]:
    """A car that goes along the way from arm 1 through the junction."""

    class Turning(Scenario):
        name = "turning"
        source = "turning.osc"

        def declare(self) -> None:
            self.net = Map(map_file="urban_crossing")
            self.arm, self.out, self.way = Road(anchors=["1"]), Road(), CompoundRoute()
            self.car = Vehicle()

        def placement(self) -> None:
            self.require(
                self.net,
                roads_follow_in_junction(
                    in_road=self.arm,
                    out_road=self.out,
                    direction=direction,
                    resulting_route=self.way,
                ),
            )
            self.place(self.car, along(self.way), position(100.0), *more.get("start", ()))

        def behavior(self) -> Behaviour:
            whole = along(self.way, end_offset=more.get("end", 0.0))
            return Serial("drive", self.car.drive(whole, speed(8.0)))

    return Turning


@pytest.mark.parametrize(
    ("direction", "lane_id", "inside", "end"),
    [
        # Quarter circles around the corners of a crossing of 40 m, lanes 3.5 m wide.
        ("left", -1, math.pi / 2 * (20.0 + 1.75), "4"),
        ("straight", -2, 40.0, "3"),
        ("right", -2, math.pi / 2 * (20.0 - 3.5 - 1.75), "2"),
    ],
)
def test_driving_along_a_route(
    run: Callable[..., Any], direction: Any, lane_id: int, inside: float, end: str
) -> None:
    """It starts in a lane that leads there, takes the branch, and ends 50 m before the end."""
    done = run(turning(direction, end=50.0))
    assert done.result.status == "success"
    first, last = done.at("car", 0.0), done.states("car")[-1]
    assert (first["road"], first["lane"]) == ("1", lane_id)
    assert last["road"] == end and last["s"] == pytest.approx(50.0, abs=0.5)
    way = 50.0 + inside + 100.0
    # From a stand: 8 m/s with half of 4 m/s^2 and a jerk of 10 m/s^3 takes 4.2 s and half the way.
    assert done.result.time == pytest.approx(way / 8.0 + 0.5 * 4.2, abs=0.1)


def test_a_route_may_end_where_the_map_ends(run: Callable[..., Any]) -> None:
    done = run(turning("left"))
    assert done.result.status == "success"
    assert done.states("car")[-1]["s"] == pytest.approx(0.0, abs=0.5)


def test_a_lane_that_does_not_lead_along_the_route(run: Callable[..., Any]) -> None:
    """From the right lane nobody turns left; the action fails where that is settled."""
    done = run(turning("left", start=(lane(1),)))
    assert done.result.status == "failure"
    assert "no lane leads from lane -2 of road 11 to the end of its route" in done.result.reason


def test_a_path_is_the_longest_section_with_all_that_is_asked(load_map: Load) -> None:
    """Three driving lanes only the direction against s has, so the choice is no accident."""
    highway, path = load_map("highway"), RoadPath(max_lanes=3, min_lanes=3, min_length=100.0)
    MapSolver(highway, [path], []).solve()
    assert not path.found.forwards
    wide = RoadPath()
    MapSolver(load_map("merge"), [wide], []).solve()
    found = load_map("merge").roads[wide.found.road].sections[wide.found.section or 0]
    longest = max(
        s.end - s.begin
        for road in load_map("merge").roads.values()
        if road.junction is None
        for s in road.sections
    )
    assert found.end - found.begin == pytest.approx(longest)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        (RoadPath(min_lanes=9), "no path for which there are at least 9 lanes"),
        (RoadPath(max_lanes=0), "no path for which there are at most 0 lanes"),
        (RoadPath(min_length=1e6), "no path for which there are 1e\\+06 m"),
    ],
)
def test_a_path_that_the_map_has_not(load_map: Load, path: RoadPath, message: str) -> None:
    with pytest.raises(ScenarioError, match=message):
        MapSolver(load_map("highway"), [path], []).solve()


def test_actors_on_a_path_have_room_behind_them(load_map: Load, run: Callable[..., Any]) -> None:
    """The first starts a third into it, and who starts 30 m behind still fits on the road."""

    class OnPath(Scenario):
        def declare(self) -> None:
            self.map = Map(map_file="highway")
            self.path = RoadPath(min_lanes=4)
            self.first, self.second = Vehicle(), Vehicle()

        def placement(self) -> None:
            self.place(self.first, on_path(self.path), lane(2))
            self.place(self.second, on_path(self.path), position(30.0, behind=self.first))

        def behavior(self) -> Behaviour:
            return Wait(elapsed(0.1))

    found = run(OnPath)
    first, second = found.at("first", 0.0), found.at("second", 0.0)
    length = load_map("highway").roads[first["road"]].length
    assert first["s"] >= length / 3.0
    assert first["lane"] == second["lane"] == -3
    assert first["s"] - second["s"] == pytest.approx(30.0, abs=6.0)


def test_paths_that_begin_and_end_elsewhere(load_map: Load) -> None:
    """The arms of the crossing: another direction, another arm."""
    crossing, first = load_map("urban_crossing"), RoadPath()
    same_end, elsewhere = RoadPath(different_origin=first), RoadPath(different_dest=first)
    both = RoadPath(different_dest=first, different_origin=first)
    MapSolver(crossing, [first, same_end, elsewhere, both], []).solve()
    graph = graph_of(crossing)
    begin, end = (crossing.pose(at(first.found)) for at in (graph.begin, graph.end))
    for path, ends in ((same_end, "begin"), (elsewhere, "end"), (both, "begin"), (both, "end")):
        here = crossing.pose(getattr(graph, ends)(path.found))
        there = begin if ends == "begin" else end
        assert math.hypot(here.x - there.x, here.y - there.y) > 1.0


def test_a_map_with_too_few_paths(load_map: Load) -> None:
    """Four lanes the highway has in one direction only, so there is one such path."""
    one = RoadPath(min_lanes=4)
    for wish in ({"different_dest": one}, {"different_origin": one}):
        (name,) = wish
        with pytest.raises(ScenarioError, match=f"no path for which path_{name} hold"):
            MapSolver(load_map("highway"), [one, RoadPath(min_lanes=4, **wish)], []).solve()
