"""Distances, gaps, headways, times and contacts against computations of their own.

Ways along the road are summed up from poses of the lanes' centre lines; boxes are cut with each
other as polygons, at many instants. Nothing of the code under test is used for either.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from itertools import pairwise

import pytest

from osc2tx_runtime.domain.actors import Vehicle
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap
from osc2tx_runtime.world import ActorState, EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.measuring.collision import box_of
from osc2tx_runtime.world.measuring.distances import object_distance, time_to_collision
from tests.runtime.world.pairs_of_boxes import swept_contacts

LoadMap = Callable[[str], RoadMap]
Leg = tuple[str, int, float, float]  # road, lane, s at its begin and its end

WAYS: dict[str, tuple[Leg, ...]] = {
    "curve": (("1", -2, 90.0, 420.0),),  # line, clothoid, arc, clothoids, arc
    "merge": (("1", -2, 250.0, 300.0), ("10", -2, 0.0, 40.0), ("2", -2, 0.0, 250.0)),
    "urban_crossing": (("1", -2, 100.0, 150.0), ("11", -2, 0.0, 40.0), ("3", 2, 150.0, 60.0)),
    "left_hand": (("1", -2, 420.0, 180.0),),  # against s
}


def line_of(road_map: RoadMap, way: Sequence[Leg]) -> list[Pose]:
    """The centre line of a way in steps of at most 5 cm."""
    points = []
    for road, lane, begin, end in way:
        count = math.ceil(abs(end - begin) / 0.05)
        places = (begin + (end - begin) * i / count for i in range(count + 1))
        points += [road_map.pose(LanePosition(road, lane, s)) for s in places]
    return points


def length_of(points: Sequence[Pose]) -> float:
    return sum(math.hypot(b.x - a.x, b.y - a.y) for a, b in pairwise(points))


def cast(road_map: RoadMap, *wishes: tuple[Vehicle, LanePosition, float]) -> EmbeddedWorld:
    world = EmbeddedWorld(road_map)
    context = ExecutionContext(world, None, {actor.id: actor for actor, _, _ in wishes})
    for actor, at, v in wishes:
        actor.bind(context)
        world.add(actor.spec())
        world.place(actor.id, at, v)
    return world


@pytest.mark.parametrize("name", WAYS)
def test_along_the_road(load_map: LoadMap, name: str) -> None:
    """On curves, over joins of roads, through junctions, against s: the length of the way."""
    road_map, way = load_map(name), WAYS[name]
    first, last = way[0], way[-1]
    front, back = Vehicle(name="front", length=8.0, rear_overhang=2.0), Vehicle(name="back")
    cast(
        road_map,
        (front, LanePosition(last[0], last[1], last[3]), 8.0),
        (back, LanePosition(first[0], first[1], first[2]), 10.0),
    )
    way_between = length_of(line_of(road_map, way))
    assert way_between > 100.0
    near = pytest.approx(way_between, abs=2e-3)
    assert front.position.ahead_of(back) == near
    assert back.position.behind(front) == near
    mode = "reference_points"
    assert back.road_distance(front, "longitudinal", mode, "on_lane") == near
    assert front.road_distance(back, "longitudinal", mode, "on_lane") == pytest.approx(
        -way_between, abs=2e-3
    )
    on_road = abs(last[3] - first[2]) if first[0] == last[0] else way_between
    assert back.road_distance(front, "longitudinal") == pytest.approx(on_road, abs=2e-3)
    gap = way_between - 2.0 - (4.6 - 0.92)
    assert front.space_gap(back, "longitudinal") == pytest.approx(gap, abs=2e-3)
    assert back.time_gap(front, "longitudinal") == pytest.approx(-gap / 10.0, abs=1e-3)
    headway = way_between + 6.0 - (4.6 - 0.92)
    assert back.space_headway(front) == pytest.approx(headway, abs=2e-3)
    assert back.time_headway(front) == pytest.approx(headway / 10.0, abs=1e-3)
    assert front.time_headway(back) == pytest.approx(-headway / 10.0, abs=1e-3)


def test_an_arc_is_as_long_as_its_radius_says(load_map: LoadMap) -> None:
    """100 m of s on the arc of 1/120 m, banked, are 100 (1 - t cos 0.05 / 120) m at t."""
    road_map = load_map("curve")
    for lane in (-3, -2, -1):
        a, b = Vehicle(name="a"), Vehicle(name="b")
        cast(
            road_map,
            (a, LanePosition("1", lane, 160.0), 0.0),
            (b, LanePosition("1", lane, 260.0), 0.0),
        )
        length = 100.0 * (1.0 - a.get_t_coord() * math.cos(0.05) / 120.0)
        assert b.position.ahead_of(a) == pytest.approx(length, abs=1e-4)


@pytest.mark.parametrize("name", WAYS)
def test_across_the_road(load_map: LoadMap, name: str) -> None:
    """How far left of a one is: the distance from its centre line, nearest point by search."""
    road_map, way = load_map(name), WAYS[name]
    first, last = way[0], way[-1]
    a, b = Vehicle(name="a"), Vehicle(name="b")
    cast(
        road_map,
        (a, LanePosition(first[0], first[1], first[2]), 5.0),
        (b, LanePosition(last[0], last[1], last[3], 1.2), 5.0),
    )
    here = b.state
    away = min(math.hypot(p.x - here.x, p.y - here.y) for p in line_of(road_map, way))
    assert a.road_distance(b, "lateral") == pytest.approx(away, abs=5e-3)
    # Seen from b the other one is right of the line that b is on.
    assert b.road_distance(a, "lateral") == pytest.approx(-away, abs=0.02)


def test_without_a_way_there_is_no_distance(load_map: LoadMap) -> None:
    a, b = Vehicle(name="a"), Vehicle(name="b")
    cast(
        load_map("curve"),
        (a, LanePosition("1", -2, 100.0), 5.0),
        (b, LanePosition("1", 2, 100.0), 5.0),
    )
    for read in (a.position.ahead_of, a.space_headway, a.time_headway):
        with pytest.raises(ScenarioError, match="no lane leads from a to b or back"):
            read(b)


def test_times_of_a_standing_one_stay_comparable(highway: RoadMap) -> None:
    front, back = Vehicle(name="front"), Vehicle(name="back")
    cast(
        highway,
        (front, LanePosition("1", -2, 130.0), 3.0),
        (back, LanePosition("1", -2, 100.0), 0.0),
    )
    assert back.time_headway(front) == math.inf
    assert front.time_headway(back) == -math.inf
    assert not back.time_headway(front) < 2.0
    assert back.time_to_collision(front) == math.inf


def test_side_by_side_has_no_gap(highway: RoadMap) -> None:
    a, b = Vehicle(name="a"), Vehicle(name="b")
    cast(
        highway,
        (a, LanePosition("1", -2, 100.0), 5.0),
        (b, LanePosition("1", -3, 103.0), 5.0),
    )
    assert a.space_gap(b, "longitudinal") == b.space_gap(a, "longitudinal") == 0.0
    assert a.time_gap(b, "longitudinal") == 0.0
    assert a.space_gap(b, "lateral") == pytest.approx(3.5 - 1.9)  # the caller is left
    assert b.space_gap(a, "lateral") == pytest.approx(1.9 - 3.5)


# --- boxes -------------------------------------------------------------------------------------

Point = tuple[float, float]


def corners(state: ActorState, time: float = 0.0) -> list[Point]:
    """Corners of the box of an actor that goes straight on."""
    c, s = math.cos(state.h), math.sin(state.h)
    x, y = state.x + time * state.v * c, state.y + time * state.v * s
    front, rear, half = state.shape.front, -state.shape.rear, 0.5 * state.shape.width
    box = ((front, -half), (front, half), (rear, half), (rear, -half))
    return [(x + a * c - b * s, y + a * s + b * c) for a, b in box]


def common_area(one: Sequence[Point], other: Sequence[Point]) -> float:
    """Area that two convex polygons (counter-clockwise) share, by cutting."""
    left = list(one)
    for (ax, ay), (bx, by) in zip(other, (*other[1:], other[0]), strict=True):
        kept: list[Point] = []
        sides = [(bx - ax) * (y - ay) - (by - ay) * (x - ax) for x, y in left]
        for i, (p, q) in enumerate(zip(left, (*left[1:], left[0]), strict=True)):
            a, b = sides[i], sides[(i + 1) % len(left)]
            if a >= 0.0:
                kept.append(p)
            if (a > 0.0) != (b > 0.0) and a != b:
                w = a / (a - b)
                kept.append((p[0] + w * (q[0] - p[0]), p[1] + w * (q[1] - p[1])))
        left = kept
        if not left:
            return 0.0
    return 0.5 * abs(
        sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(left, (*left[1:], left[0]), strict=True))
    )


def some_state(draw: random.Random, spread: float, fastest: float) -> ActorState:
    length = draw.uniform(0.5, 8.0)
    shape = Shape(length, draw.uniform(0.4, 2.5), 1.5, draw.uniform(0.0, 0.5) * length)
    place = draw.uniform(-spread, spread), draw.uniform(-spread, spread)
    return ActorState(
        *place, 0.0, draw.uniform(-math.pi, math.pi), draw.uniform(-5.0, fastest), 0.0,
        None, 0.0, shape,
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(80))
def test_time_to_collision_is_when_the_boxes_meet(seed: int) -> None:
    draw = random.Random(seed)
    a, b = some_state(draw, 8.0, 20.0), some_state(draw, 8.0, 20.0)
    found = time_to_collision(a, b)
    assert found == pytest.approx(time_to_collision(b, a))
    step, meet = 0.01, None
    for i in range(600):
        if common_area(corners(a, i * step), corners(b, i * step)) > 1e-9:
            meet = i * step
            break
    if meet is None:
        assert found > 5.99 or _grazes(a, b, found)
    else:
        assert found <= meet + 1e-9
        assert found >= meet - step - 1e-9 or _grazes(a, b, found)


def _grazes(a: ActorState, b: ActorState, time: float) -> bool:
    """Whether only corners meet for less than a step: nothing to see at the instants looked at."""
    around = (time + 1e-4 * i for i in range(101))
    return any(common_area(corners(a, t), corners(b, t)) > 0.0 for t in around)


def test_the_cases_of_the_search_are_of_both_kinds() -> None:
    times = []
    for seed in range(80):
        draw = random.Random(seed)
        times.append(time_to_collision(some_state(draw, 8.0, 20.0), some_state(draw, 8.0, 20.0)))
    assert sum(0.0 < time < 6.0 for time in times) >= 10
    assert sum(time == math.inf for time in times) >= 10


@pytest.mark.parametrize("seed", range(30))
def test_swept_contacts_miss_nothing_between_two_steps(seed: int) -> None:
    """Eight boxes at up to 60 m/s over 0.05 s against their polygons at 60 instants."""
    draw = random.Random(1000 + seed)
    states = [some_state(draw, 7.0, 60.0) for _ in range(8)]
    ends = [
        s._replace(x=s.x + 0.05 * s.v * math.cos(s.h), y=s.y + 0.05 * s.v * math.sin(s.h))
        for s in states
    ]
    found = set(swept_contacts([box_of(s) for s in states], [box_of(s) for s in ends]))
    seen = {
        (i, j)
        for i in range(8)
        for j in range(i + 1, 8)
        for k in range(61)
        if common_area(corners(states[i], k * 0.05 / 60), corners(states[j], k * 0.05 / 60)) > 1e-9
    }
    assert seen <= found
    for i, j in found - seen:  # touching for less than a 60th of the step
        assert _gap_at_best(states[i], states[j]) < 0.06


def _gap_at_best(a: ActorState, b: ActorState) -> float:
    """Distance between two boxes at the best of the instants."""
    gaps = []
    for k in range(61):
        later = [
            s._replace(
                x=s.x + k / 1200 * s.v * math.cos(s.h), y=s.y + k / 1200 * s.v * math.sin(s.h)
            )
            for s in (a, b)
        ]
        gaps.append(object_distance(later[0], later[1], "euclidean", "bounding_boxes"))
    return min(gaps)


@pytest.mark.parametrize("seed", range(40))
def test_distance_between_boxes_is_that_of_their_outlines(seed: int) -> None:
    draw = random.Random(2000 + seed)
    a, b = some_state(draw, 10.0, 0.0), some_state(draw, 10.0, 0.0)
    found = object_distance(a, b, "euclidean", "bounding_boxes")
    if common_area(corners(a), corners(b)) > 0.0:
        assert found == 0.0
        return
    outlines = [_outline(corners(s)) for s in (a, b)]
    nearest = min(math.dist(p, q) for p in outlines[0] for q in outlines[1])
    assert found == pytest.approx(nearest, abs=0.02)
    assert found <= nearest + 1e-9


def _outline(polygon: Sequence[Point]) -> list[Point]:
    """Points on the outline, 60 on each side."""
    return [
        (p[0] + i / 60 * (q[0] - p[0]), p[1] + i / 60 * (q[1] - p[1]))
        for p, q in zip(polygon, (*polygon[1:], polygon[0]), strict=True)
        for i in range(60)
    ]
