"""Map modifiers (DSL 8.12.2.2): which roads and lanes of a map are chosen, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

import osc2tx_runtime
from osc2tx_runtime import (
    CompoundLane,
    CompoundRoute,
    Junction,
    Lane,
    LaneSection,
    Road,
    ScenarioError,
    at_least,
    at_most,
    within,
)
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.placing.map_solver import MapSolver, Relation
from osc2tx_runtime.modifiers import (
    compound_lane_side,
    end_lane,
    lane_side,
    number_of_lanes,
    roads_follow_in_junction,
    routes_are_in_sequence,
    routes_are_opposite,
    routes_overlap,
    start_lane,
)
from osc2tx_runtime.opendrive import RoadMap

Load = Callable[[str], RoadMap]
MAPS = Path(osc2tx_runtime.__file__).parent / "maps"


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


@pytest.mark.parametrize(
    ("kind", "parts", "wholes"),
    [
        ("start", {0}, {0}),
        ("end", {2}, {2}),
        ("other", {1}, set()),
        ("equal", set(), set()),
        ("inside", set(), {0, 1, 2}),
        ("any", {0, 1, 2}, {0, 1, 2}),
    ],
)
def test_overlaps(load_map: Load, kind: Any, parts: set[int], wholes: set[int]) -> None:
    """Of a road with the sections that it consists of: those may be the second route, the first.

    `start`, `end` and `equal` are about the points where routes begin and end (DSL 8.12.23).
    """
    merge = load_map("merge")

    def holds(number: int, is_first: bool) -> bool:
        sections = [LaneSection(), LaneSection(), LaneSection()]
        road = Road(anchors=["2"], s_positive=sections)
        pair = (sections[number], road) if is_first else (road, sections[number])
        try:
            solve(merge, [*sections, road], routes_overlap(*pair, kind))
        except ScenarioError as error:
            assert "for which routes_overlap" in str(error)
            return False
        return True

    assert {number for number in range(3) if holds(number, is_first=False)} == parts
    assert {number for number in range(3) if holds(number, is_first=True)} == wholes


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
    ("arguments", "type_"),
    [
        ({"lane_type": "pedestrian"}, "sidewalk"),
        ({"lane_use": "sidewalk", "directionality": "free"}, "sidewalk"),
        ({"lane_type": "driving", "directionality": "uni_direction"}, "driving"),
    ],
)
def test_lanes_of_a_kind_are_counted(load_map: Load, arguments: dict[str, Any], type_: str) -> None:
    """The arms of the crossing have two lanes each way and a sidewalk on either side."""
    found = etree.parse(MAPS / "urban_crossing.xodr").find("road[@id='1']")
    assert found is not None
    count = len(found.findall(f".//lane[@type='{type_}']"))
    road, other = Road(anchors=["1"]), Road(anchors=["1"])
    solve(load_map("urban_crossing"), [road], number_of_lanes(road, count, **arguments))
    with pytest.raises(ScenarioError, match="number_of_lanes"):
        solve(load_map("urban_crossing"), [other], number_of_lanes(other, count - 1, **arguments))


def test_a_lane_by_its_kind(load_map: Load) -> None:
    """Drivable lanes come first; others only if their kind is asked for."""
    plain, walk, bus = Lane(), Lane(lane_type="pedestrian", width=2.5), Lane(lane_use="bus")
    solve(load_map("crossing"), [plain, walk])
    assert (plain.found.lane, walk.found.lane) == (-1, -2)
    with pytest.raises(ScenarioError, match="no lane for which lane_use is bus"):
        solve(load_map("crossing"), [bus])


@pytest.mark.parametrize(
    ("part", "wish"),
    [
        (Road(length=at_least(1e4)), "there are at least 10000 m"),
        (Road(length=within(1.0, 2.0)), "there are 1 to 2 m"),
        (Road(length=7.0), "there are 7 m"),
        (LaneSection(min_lanes=3), "there are at least 3 lanes"),
        (LaneSection(max_lanes=at_most(0)), "there are at most 0 lanes"),
        (Road(directionality="bi_direction"), "directionality is bi_direction"),
        (Lane(width=within(1.0, 2.0)), "width is 1 to 2 m"),
    ],
)
def test_what_a_part_asks_for_is_named(load_map: Load, part: RoadPart, wish: str) -> None:
    with pytest.raises(ScenarioError, match=f"map crossing has no {part.kind} for which {wish}"):
        solve(load_map("crossing"), [part])


def test_wishes_that_the_map_fulfils(load_map: Load) -> None:
    """The street is 500 m long, its driving lanes 3.5 m wide."""
    road = Road(length=within(499.0, 501.0), directionality="split", min_lanes=2, max_lanes=2)
    lane_ = Lane(width=at_least(3.0), length=500.0)
    solve(load_map("crossing"), [road, lane_])
    assert road.found.road == lane_.found.road == "1"


def test_parts_that_are_listed(load_map: Load) -> None:
    """The motorway behind the merge has three sections; the first one three lanes."""
    lanes = [Lane(), Lane(), Lane()]
    wide, others = LaneSection(lanes=lanes, s_axis=lanes[0]), [LaneSection(), LaneSection()]
    road = Road(s_positive=[wide, *others])
    solve(load_map("merge"), [*lanes, wide, *others, road])
    assert [lane.found.lane for lane in lanes] == [-3, -2, -1]
    assert [part.found.section for part in (wide, *others)] == [0, 1, 2]
    assert {part.found.road for part in (wide, *others, road)} == {"2"}


def test_members_of_compound_parts(load_map: Load) -> None:
    chain = [Lane(), Lane(), Lane()]
    whole, road = CompoundLane(lanes=chain), Road(anchors=["2"])
    solve(load_map("merge"), [*chain, whole, road], routes_overlap(whole, road, "equal"))
    sections = [lane.found.section for lane in chain]
    assert sections == [0, 1, 2] and whole.found.parts == tuple(lane.found for lane in chain)
    arms = [Road() for _ in range(4)]
    junction = Junction(roads=arms)
    solve(load_map("urban_crossing"), [*arms, junction])
    assert [arm.found.road for arm in arms] == ["1", "2", "3", "4"]


@pytest.mark.parametrize("count", [1, 5])
def test_lists_of_another_length(load_map: Load, count: int) -> None:
    lanes = [Lane() for _ in range(count)]
    with pytest.raises(ScenarioError, match="nothing for which the list of its members holds"):
        solve(load_map("urban_crossing"), [*lanes, LaneSection(lanes=lanes)])
