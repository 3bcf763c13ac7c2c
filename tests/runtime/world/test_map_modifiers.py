"""Map modifiers (DSL 8.12.2.2): which roads and lanes of a map are chosen, and what is refused."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    CompoundLane,
    CompoundRoute,
    Junction,
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
from osc2tx_runtime.map_solver import MapSolver, Relation
from osc2tx_runtime.modifiers import (
    along,
    compound_lane_side,
    end_lane,
    lane,
    lane_side,
    number_of_lanes,
    on_path,
    position,
    roads_follow_in_junction,
    routes_are_in_sequence,
    routes_are_opposite,
    routes_overlap,
    set_map_file,
    speed,
    start_lane,
)
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.road_parts import RoadPart

Load = Callable[[str], RoadMap]


def solve(road_map: RoadMap, parts: list[RoadPart], *modifiers: Any) -> None:
    relations = [Relation(m, f"case.osc:{number}") for number, m in enumerate(modifiers, 1)]
    MapSolver(road_map, parts, relations).solve()


def lanes_of(*parts: RoadPart) -> list[tuple[str, int | None, int | None]]:
    return [(p.found.road, p.found.section, p.found.lane) for p in parts]


def test_number_of_lanes(load_map: Load) -> None:
    """The ramp of the merge is road 3; its roads have 2 and 3 lanes in one direction."""
    merge = load_map("merge")
    counts = {
        road.id: {sum(lane.type == "driving" for lane in s.lanes.values()) for s in road.sections}
        for road in merge.roads.values()
        if road.junction is None
    }
    for count in (1, 2, 3):
        expected = [road for road, numbers in counts.items() if numbers == {count}]
        chosen = Road()
        if expected:
            solve(merge, [chosen], number_of_lanes(route=chosen, num_of_lanes=count))
            assert chosen.found.road == expected[0]
        else:
            with pytest.raises(ScenarioError, match="nothing for which number_of_lanes holds"):
                solve(merge, [chosen], number_of_lanes(route=chosen, num_of_lanes=count))


def test_lanes_of_one_direction(load_map: Load) -> None:
    """The highway has four lanes with s and three against."""
    section = LaneSection()
    highway = load_map("highway")
    solve(highway, [section], number_of_lanes(route=section, num_of_lanes=3, lane_use="normal"))
    assert not section.found.forwards
    solve(highway, [section], number_of_lanes(route=section, num_of_lanes=4))
    assert section.found.forwards


@pytest.mark.parametrize(("side", "count"), [("left", 1), ("right", 2), ("left", 3)])
def test_lane_side(load_map: Load, side: Any, count: int) -> None:
    """Lanes of the highway with s are -4 to -1 from the right."""
    one, other, section = Lane(), Lane(), LaneSection()
    relation = lane_side(lane1=one, side=side, lane2=other, count=count, lane_section=section)
    solve(load_map("highway"), [section, one, other], relation)
    first, second = (p.found.lane for p in (one, other))
    assert first is not None and second is not None
    assert first - second == (count if side == "left" else -count)


def test_there_is_no_lane_so_far_beside(load_map: Load) -> None:
    one, other = Lane(), Lane()
    with pytest.raises(ScenarioError, match="lane_side") as caught:
        solve(load_map("highway"), [one, other], lane_side(one, "left", other, 4))
    assert caught.value.source == "case.osc:1"


@pytest.mark.parametrize(
    ("direction", "count", "roads"),
    [
        ("left", 1, ("1", "4")),
        ("straight", 2, ("1", "3")),
        ("right", 3, ("1", "2")),
    ],
)
def test_ways_through_a_junction(
    load_map: Load, direction: Any, count: int, roads: tuple[str, str]
) -> None:
    """Roads 1 to 4 lie in the east, north, west and south; clockwise from 1 comes 4."""
    crossing = load_map("urban_crossing")
    for given in ({"direction": direction}, {"clockwise_count": count}):
        start, end, junction = Road(anchors=["east"]), Road(), Junction()
        way, result, inside = Lane(), CompoundRoute(), Lane()
        relation = roads_follow_in_junction(
            junction=junction,
            in_road=start,
            out_road=end,
            number_of_roads=4,
            in_lane=way,
            resulting_route=result,
            **given,
        )
        solve(crossing, [start, end, junction, way, result], relation)
        assert (start.found.road, end.found.road, junction.found.road) == (*roads, "9")
        assert way.found.road == "1"
        assert [part.road for part in result.found.parts][::2] == list(roads)
        assert inside.kind == "lane"


def test_no_such_way_through_a_junction(load_map: Load) -> None:
    start, end = Road(), Road()
    relation = roads_follow_in_junction(in_road=start, out_road=end, direction="u_turn")
    with pytest.raises(ScenarioError, match="roads_follow_in_junction"):
        solve(load_map("urban_crossing"), [start, end], relation)


def test_sequence_of_roads_and_of_lanes(load_map: Load) -> None:
    crossing = load_map("urban_crossing")
    first, second = Road(anchors=["2"]), Road()
    solve(crossing, [first, second], routes_are_in_sequence(first, second))
    assert second.found.road == "1"
    merge = load_map("merge")
    one, other = Lane(), Lane()
    solve(merge, [one, other], routes_are_in_sequence(one, other))
    ends = [merge.successors(key(one)), key(other)]
    assert ends[1] in ends[0] or any(ends[1] in merge.successors(via) for via in ends[0])


def key(part: RoadPart) -> Any:
    from osc2tx_runtime.opendrive import LaneKey

    found = part.found
    assert found.section is not None and found.lane is not None
    return LaneKey(found.road, found.section, found.lane)


def test_lanes_that_begin_and_end(load_map: Load) -> None:
    merge = load_map("merge")
    begin, end = Lane(), Lane()
    solve(merge, [begin, end], start_lane(begin), end_lane(end))
    assert merge.predecessors(key(begin)) == ()
    assert merge.successors(key(end)) == ()


def test_opposite_routes(load_map: Load) -> None:
    one, other, road = Lane(), Lane(), Road()
    relation = routes_are_opposite(one, other, road)
    solve(load_map("highway"), [one, other, road], relation)
    first, second = one.found.lane, other.found.lane
    assert first is not None and second is not None and first * second < 0
    assert road.found.road == one.found.road == other.found.road
    with pytest.raises(ScenarioError, match="a road has no direction of its own"):
        routes_are_opposite(Road(), Lane())
    with pytest.raises(ScenarioError, match="driven in both directions"):
        routes_are_opposite(Lane(), Lane(), lateral_overlap="always")


def test_compound_lanes_side_by_side(load_map: Load) -> None:
    one, other, road = CompoundLane(), CompoundLane(), Road()
    relation = compound_lane_side(lane1=one, side="right", lane2=other, route=road)
    solve(load_map("highway"), [road, one, other], relation)
    assert (one.found.lane, other.found.lane) == (-4, -3)


def test_overlaps(load_map: Load) -> None:
    """A map whose road has several sections: a section overlaps a part of it."""
    merge = load_map("merge")
    road = next(r for r in merge.roads.values() if len(r.sections) > 1 and r.junction is None)
    cases = {"start": len(road.sections) - 1, "end": 0}
    for kind in ("start", "end", "equal", "inside", "other"):
        whole, piece = Road(anchors=[road.id]), LaneSection()
        relation = routes_overlap(whole, piece, kind)
        if kind in cases:
            solve(merge, [whole, piece], relation)
            section = merge.roads[road.id].sections[piece.found.section or 0]
            touched = section.begin == 0.0 if kind == "start" else section.end == road.length
            assert touched and section.end - section.begin < road.length
        elif kind in ("equal", "other"):
            with pytest.raises(ScenarioError, match="for which routes_overlap hold"):
                solve(merge, [whole, piece], relation)
        piece, outer = LaneSection(road=whole), Road(anchors=[road.id])
        solve(merge, [whole, piece, outer], routes_overlap(piece, whole, "other"))


def test_several_modifiers_are_solved_together(load_map: Load) -> None:
    """The middle one of three lanes side by side, of which the leftmost has no left neighbour."""
    left, middle, right = Lane(), Lane(), Lane()
    solve(
        load_map("highway"),
        [left, middle, right],
        lane_side(left, "left", middle),
        lane_side(right, "right", middle),
        lane_side(left, "left", right, 2),
        number_of_lanes(left, 1),
    )
    found = [part.found.lane for part in (left, middle, right)]
    assert found in ([-2, -3, -4], [-1, -2, -3])


def test_contradictions_name_the_part(load_map: Load) -> None:
    one, other = Lane(), Lane()
    with pytest.raises(ScenarioError, match="no lane for which lane_side hold") as caught:
        solve(
            load_map("highway"),
            [one, other],
            lane_side(one, "left", other),
            lane_side(one, "right", other),
        )
    assert caught.value.source == "case.osc:1"


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        ({"lane_type": "pedestrian"}, "pedestrian"),
        ({"lane_use": "bus"}, "bus"),
        ({"directionality": "split"}, "split"),
    ],
)
def test_what_maps_do_not_tell_is_refused(arguments: dict[str, str], what: str) -> None:
    with pytest.raises(ScenarioError, match=f"`{what}` cannot be told from a map"):
        number_of_lanes(Road(), 2, **arguments)


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
    solve(highway, [path])
    assert not path.found.forwards
    wide = RoadPath()
    solve(load_map("merge"), [wide])
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
        solve(load_map("highway"), [path])


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
