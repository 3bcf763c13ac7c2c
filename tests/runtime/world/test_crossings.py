"""Crossings (DSL 8.5.8, 8.12.11): where they lie, what is known of them, people on them."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

import osc2tx_runtime
from osc2tx_runtime import (
    Behaviour,
    Crossing,
    CrossingType,
    Event,
    Lane,
    Map,
    Parallel,
    Person,
    RoutePoint,
    Scenario,
    ScenarioError,
    Vehicle,
    Wait,
    at_least,
    rise,
)
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.placing.map_solver import MapSolver, Relation
from osc2tx_runtime.domain.routes.lane_coordinates import place_of_route
from osc2tx_runtime.modifiers import along, crossing_connects, speed
from osc2tx_runtime.opendrive import RoadMap, read_map

MAP = Path(osc2tx_runtime.__file__).parent / "maps" / "crossing.xodr"
Load = Callable[[str], RoadMap]
OUTER = 3.5 + 0.5 * 2.5  # m: middle of the sidewalk, from the middle of the street


def walks() -> tuple[Lane, Lane]:
    return Lane(lane_type="pedestrian"), Lane(lane_type="pedestrian")


def solve(road_map: RoadMap, crossing: Crossing, *lanes: Any, **more: Any) -> None:
    relation = Relation(crossing_connects(crossing, *lanes, **more), "case.osc:1")
    MapSolver(road_map, [*lanes, crossing], [relation]).solve()


def test_a_crosswalk_of_the_map(load_map: Load) -> None:
    """It leads from the middle of one sidewalk to that of the other, at the crosswalk's s."""
    element = etree.parse(MAP).find(".//object[@type='crosswalk']")
    assert element is not None
    s, length = float(element.get("s", "")), 500.0
    for first, last in (("-2", "2"), ("2", "-2")):
        crossing = Crossing()
        ends = Lane(anchors=[f"1:{first}"], lane_type="pedestrian"), Lane(lane_type="pedestrian")
        solve(load_map("crossing"), crossing, *ends)
        line = crossing.line
        assert [str(lane.found.lane) for lane in ends] == [first, last]
        # Against s a lane is measured from the end of the road.
        along_first, along_last = (s, length - s) if first == "-2" else (length - s, s)
        assert (line.start_s, line.end_s) == pytest.approx((along_first, along_last), abs=1e-6)
        assert line.length == pytest.approx(2.0 * OUTER)
        assert (line.crosswalk, line.width) == (element.get("id"), float(element.get("length", "")))
        begin = -OUTER if first == "-2" else OUTER
        assert line.at(0.0)[:2] == pytest.approx((s, begin), abs=1e-6)


@pytest.mark.parametrize("degrees", [90.0, 60.0, 120.0, 30.0])
@pytest.mark.parametrize("first", [-2, 2])
def test_laid_by_the_scenario(load_map: Load, degrees: float, first: int) -> None:
    """At an angle to the lane that it leaves, to the side on which the other one is."""
    crossing = Crossing()
    ends = Lane(anchors=[f"1:{first}"], lane_type="pedestrian"), Lane(lane_type="pedestrian")
    angle = math.radians(degrees)
    solve(load_map("crossing"), crossing, *ends, start_s_coord=100.0, start_angle=angle)
    line = crossing.line
    assert line.length == pytest.approx(2.0 * OUTER / math.sin(angle))
    ahead = 2.0 * OUTER / math.tan(angle)
    assert line.start_s == pytest.approx(100.0)
    assert line.end_s == pytest.approx(500.0 - (100.0 + ahead), abs=1e-6)
    assert line.crosswalk is None
    end = (100.0 + ahead, OUTER) if first < 0 else (400.0 - ahead, -OUTER)
    assert line.at(line.length)[:2] == pytest.approx(end, abs=1e-6)


def test_over_a_bend(load_map: Load) -> None:
    """Lanes of a curve are met where the straight line meets them, not at the same s."""
    road_map, crossing = load_map("curve"), Crossing()
    ends = Lane(anchors=["1:-1"]), Lane(anchors=["1:2"])
    solve(road_map, crossing, *ends, start_s_coord=200.0, start_angle=math.radians(70.0))
    line = crossing.line
    graph = graph_of(road_map)
    for lane, along_lane, at in ((ends[0], line.start_s, 0.0), (ends[1], line.end_s, line.length)):
        s = graph.s_at(lane.found, along_lane)
        assert s is not None
        centre = place_of_route(road_map, RoutePoint(lane, along_lane))
        pose = road_map.pose(centre)  # type: ignore[arg-type]
        assert line.at(at) == pytest.approx((pose.x, pose.y, pose.z), abs=1e-5)
    begin = road_map.pose(place_of_route(road_map, RoutePoint(ends[0], line.start_s)))  # type: ignore[arg-type]
    assert math.remainder(line.heading - begin.h, math.tau) == pytest.approx(math.radians(70.0))


def test_without_a_word_people_cross_between_sidewalks(load_map: Load) -> None:
    one, other, crossing = Lane(), Lane(), Crossing()
    solve(load_map("crossing"), crossing, one, other, start_s_coord=20.0)
    assert {one.found.lane, other.found.lane} == {-2, 2}


@pytest.mark.parametrize(
    ("crossing", "more", "reason"),
    [
        (Crossing(anchors=["101"]), {}, "no crossing for which crossing_connects hold"),
        (Crossing(crossing_type=CrossingType(marking="marked")), {}, "no crossing for which"),
        (Crossing(crossing_type=CrossingType(use="bicycle")), {}, "no crossing for which"),
        (Crossing(width=at_least(5.0)), {}, "no crossing for which"),
        (Crossing(), {"start_s_coord": 501.0}, "nothing for which crossing_connects holds"),
        (
            Crossing(crossing_type=CrossingType(marking="zebra")),
            {"start_s_coord": 20.0},
            "no crossing for which",
        ),
    ],
)
def test_crossings_that_the_map_has_not(
    load_map: Load, crossing: Crossing, more: dict[str, Any], reason: str
) -> None:
    with pytest.raises(ScenarioError, match=reason):
        solve(load_map("crossing"), crossing, *walks(), **more)


def test_what_nothing_says(load_map: Load) -> None:
    with pytest.raises(ScenarioError, match="between 0 and 180 degrees"):
        crossing_connects(Crossing(), *walks(), start_angle=math.pi)
    with pytest.raises(ScenarioError, match="used before the map is known"):
        Crossing().line  # noqa: B018
    crossing = Crossing()
    solve(load_map("crossing"), crossing, *walks(), start_s_coord=20.0)
    with pytest.raises(ScenarioError, match="the width of the crossing of road 1 is not stated"):
        crossing.width  # noqa: B018


def test_its_own_members_say_the_same(load_map: Load) -> None:
    """What `crossing_connects` says can be written as members."""
    one, other = walks()
    crossing = Crossing(start_lane=one, end_lane=other, start_s_coord=40.0, width=3.0)
    MapSolver(load_map("crossing"), [crossing, one, other], []).solve()
    assert (one.found.lane, other.found.lane) == tuple(p.lane for p in crossing.found.parts)
    assert crossing.line.start_s == pytest.approx(40.0)
    assert crossing.width == 3.0


def test_a_crosswalk_where_the_scenario_lays_one(load_map: Load) -> None:
    """Laid across the crosswalk of the map, a crossing is that crosswalk."""
    crossing = Crossing(anchors=["crosswalk"])
    solve(load_map("crossing"), crossing, *walks(), start_s_coord=251.0)
    assert crossing.line.crosswalk == "100"
    assert crossing.width == pytest.approx(4.0)


def test_crosswalks_of_a_town(test_data: Path) -> None:
    """In a town of CARLA each crosswalk leads from one edge of the street to the other."""
    file = test_data / "maps" / "carla-2020" / "Town10HD.xodr"
    in_file = {o.get("id") for o in etree.parse(file).iterfind(".//object[@type='crosswalk']")}
    graph = graph_of(read_map(file))
    lengths = {crosswalk.id: crosswalk.length for crosswalk in graph.map.crosswalks()}
    first = {
        crossing.line.crosswalk: crossing for crossing in reversed(graph.crossings) if crossing.line
    }
    assert set(first) == set(lengths) == in_file
    for identity, crossing in first.items():
        assert identity is not None and crossing.line is not None
        assert "driving" not in [graph.kind_of(lane).type for lane in crossing.parts]
        # edges and crosswalks end within a lane of each other
        assert crossing.line.length == pytest.approx(lengths[identity], abs=3.0)


class Walk(Scenario):
    """A person on a crossing, from its start to its end."""

    name = "walk"
    source = "walk.osc"

    def declare(self) -> None:
        self.net = Map(map_file="crossing")
        self.walker, self.one, self.other = Person(), *walks()
        self.way = Crossing()

    def placement(self) -> None:
        self.require(self.net, crossing_connects(self.way, self.one, self.other))
        self.place(self.walker, along(self.way, start_offset=1.0), speed(1.5))

    def behavior(self) -> Behaviour:
        return self.walker.walk(along(self.way), speed(1.5))


def test_a_person_walks_over_it(run: Callable[..., Any]) -> None:
    done = run(Walk)
    first, last = done.at("walker", 0.0), done.states("walker")[-1]
    assert done.result.status == "success"
    begin = -OUTER if first["h"] > 0.0 else OUTER
    toward = math.copysign(1.0, -begin)
    assert (first["x"], first["y"]) == pytest.approx((250.0, begin + toward), abs=1e-6)
    assert (last["x"], last["y"]) == pytest.approx((250.0, -begin), abs=0.08)
    assert done.result.time == pytest.approx((2.0 * OUTER - 1.0) / 1.5, abs=0.06)


def test_a_vehicle_crosses_like_a_path(run: Callable[..., Any]) -> None:
    class Drive(Walk):
        def declare(self) -> None:
            super().declare()
            self.walker = Vehicle()  # type: ignore[assignment]

        def behavior(self) -> Behaviour:
            return self.walker.drive(along(self.way), speed(1.5))  # type: ignore[attr-defined]

    done = run(Drive)
    assert done.result.status == "success"
    ys = [state["y"] for state in done.states("walker")]
    assert max(ys) - min(ys) == pytest.approx(2.0 * OUTER - 1.0, abs=0.1)


def test_coordinates_on_a_crossing(run: Callable[..., Any]) -> None:
    """s and t of the crossing that the scenario declares, and of somebody ahead on it."""
    seen: dict[str, Any] = {}

    class Look(Walk):
        def declare(self) -> None:
            super().declare()
            self.friend = Person()
            self.half = Event(rise(lambda: self.walker.get_s_coord("on_crossing") >= 4.0))
            self.seen = self.sample(self.look, self.half, 0.0)

        def placement(self) -> None:
            super().placement()
            self.place(self.friend, along(self.way, start_offset=8.5))

        def look(self) -> float:
            point = self.walker.get_route_point("on_crossing")
            seen["s"], seen["t"] = point.s, self.walker.get_t_coord("on_crossing")
            seen["length"] = point.route.length  # type: ignore[union-attr]
            seen["ahead"], seen["left"] = (
                self.walker.road_distance(self.friend, direction, "reference_points", "on_crossing")
                for direction in ("longitudinal", "lateral")
            )
            return point.s

        def behavior(self) -> Behaviour:
            walk = self.walker.walk(along(self.way), speed(1.5))
            return Parallel("both", walk, Wait(self.half))

    done = run(Look)
    assert done.result.status == "success"
    # At 1.5 m/s from 1 m on: 4 m are reached at 2 s.
    assert seen["s"] == pytest.approx(4.0, abs=0.08)
    assert seen["t"] == pytest.approx(0.0, abs=1e-6)
    assert seen["length"] == pytest.approx(2.0 * OUTER)
    assert seen["ahead"] == pytest.approx(8.5 - seen["s"])
    assert seen["left"] == pytest.approx(0.0, abs=1e-6)


def test_coordinates_where_there_is_no_crossing(run: Callable[..., Any]) -> None:
    class Beside(Walk):
        def placement(self) -> None:
            self.require(self.net, crossing_connects(self.way, self.one, self.other))
            self.place(self.walker, along(self.one, start_offset=10.0))

        def behavior(self) -> Behaviour:
            return Wait(rise(lambda: self.walker.get_s_coord("on_crossing") > 0.0))

    with pytest.raises(ScenarioError, match="walker: it is not on a crossing"):
        run(Beside)


def test_coordinates_on_a_lane_section(run: Callable[..., Any]) -> None:
    """The axis of a section is its rightmost lane: of four lanes the second is 3.5 m left of it."""
    seen: list[tuple[float, float]] = []

    class Section(Scenario):
        name = "section"
        source = "section.osc"

        def declare(self) -> None:
            self.net = Map(map_file="highway")
            self.car, self.lane = Vehicle(), Lane(anchors=["1:-3"])

        def placement(self) -> None:
            self.place(self.car, along(self.lane, start_offset=70.0), speed(10.0))

        def note(self) -> bool:
            point = self.car.get_route_point("on_lane_section")
            seen.append((point.s, point.t))
            return len(seen) > 1

        def behavior(self) -> Behaviour:
            return Wait(rise(self.note))

    run(Section)
    assert seen[0] == pytest.approx((70.0, 3.5))
