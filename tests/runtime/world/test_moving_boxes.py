"""Boxes that move and turn: times, gaps and contacts against runs of the world and polygons."""

from __future__ import annotations

import math
import random

import pytest

from osc2tx_runtime.domain.actors import Vehicle
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap
from osc2tx_runtime.world import ActorSpec, ActorState, EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.measuring.collision import box_of
from osc2tx_runtime.world.measuring.distances import object_distance, time_to_collision
from tests.runtime.world.pairs_of_boxes import swept_contacts
from tests.runtime.world.test_conditions import cast, common_area, corners, some_state

DT = 0.05


def flying(road_map: RoadMap, states: dict[str, ActorState], dt: float = DT) -> EmbeddedWorld:
    """A world in which each goes straight on, off all lanes."""
    world = EmbeddedWorld(road_map, dt)
    for name, state in states.items():
        world.add(ActorSpec(name, "movable_object", state.shape, limits=None))  # type: ignore[arg-type]
        world.place(name, Pose(state.x, state.y, state.z, state.h), state.v)
    return world


def pair(seed: int) -> tuple[ActorState, ActorState]:
    """Two boxes near each other, turned and moving somehow."""
    draw = random.Random(5000 + seed)
    a, b = (
        some_state(draw, 12.0, 25.0)._replace(
            x=draw.uniform(-20.0, 20.0), y=100.0 + draw.uniform(-9.0, 9.0)
        )
        for _ in range(2)
    )
    return a, b


@pytest.mark.parametrize("seed", range(60))
def test_the_time_to_collision_is_when_the_world_finds_one(highway: RoadMap, seed: int) -> None:
    """Both drive on: the contact is noted at the first step at or after that time."""
    a, b = pair(seed)
    expected = time_to_collision(a, b)
    world = flying(highway, {"a": a, "b": b})
    found = None
    for step in range(1, 101):
        world.step()
        if world.collisions():
            found = step
            break
    if expected > 100 * DT:
        assert found is None
    else:
        assert found == max(math.ceil(expected / DT - 1e-9), 1)


def test_the_seeds_have_hits_and_misses() -> None:
    kinds = set()
    for seed in range(60):
        time = time_to_collision(*pair(seed))
        kinds.add("now" if time == 0.0 else "hit" if time <= 5.0 else "miss")
    assert kinds == {"now", "hit", "miss"}


@pytest.mark.parametrize("direction", ["longitudinal", "lateral"])
def test_distances_of_turned_boxes_along_the_axes_of_the_caller(direction: str) -> None:
    """Between the shadows that all eight corners throw on an axis; negative behind and right."""
    for seed in range(40):
        draw = random.Random(3000 + seed)
        a, b = some_state(draw, 9.0, 0.0), some_state(draw, 9.0, 0.0)
        angle = a.h if direction == "longitudinal" else a.h + 0.5 * math.pi
        shadows = [
            [x * math.cos(angle) + y * math.sin(angle) for x, y in corners(state)]
            for state in (a, b)
        ]
        ahead = min(shadows[1]) - max(shadows[0])
        behind = max(shadows[1]) - min(shadows[0])
        expected = ahead if ahead > 0.0 else behind if behind < 0.0 else 0.0
        found = object_distance(a, b, direction, "bounding_boxes")  # type: ignore[arg-type]
        assert found == pytest.approx(expected, abs=1e-9), seed


def test_boxes_on_two_levels_never_meet() -> None:
    car = Shape(4.6, 1.9, 1.5, 0.92)
    below = ActorState(0.0, 0.0, 0.0, 0.0, 20.0, 0.0, None, 0.0, car)
    above = below._replace(x=50.0, z=5.5, h=math.pi)
    assert time_to_collision(below, above) == math.inf
    assert time_to_collision(below, above._replace(z=1.4)) == pytest.approx(
        (50.0 - 2 * car.front) / 40.0
    )
    begin, end = [below, above], [below._replace(x=60.0), above._replace(x=-10.0)]
    assert swept_contacts([box_of(s) for s in begin], [box_of(s) for s in end]) == []


@pytest.mark.parametrize("across", [5.0, 15.0, 40.0, 90.0])
def test_what_crosses_within_one_step_is_a_contact(highway: RoadMap, across: float) -> None:
    """A thin thing shoots through in front of, through, or behind a car, between two instants."""
    thin = Shape(0.1, 0.1, 1.0, 0.05)
    car = Shape(4.6, 1.9, 1.5, 0.92)
    for x, hits in ((5.0, False), (1.5, True), (-3.0, False)):
        still = ActorState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None, 0.0, car)
        # It is before the car at one instant and behind it at the next.
        shot = ActorState(x, -across * DT / 2, 0.0, 0.5 * math.pi, across, 0.0, None, 0.0, thin)
        world = flying(highway, {"car": still, "shot": shot})
        before = common_area(corners(still), corners(shot))
        world.step()
        assert (world.collisions() == (("car", "shot"),)) == hits
        if across * DT > 1.9 + 0.1:
            assert before == common_area(corners(still), corners(world.state("shot"))) == 0.0


@pytest.mark.parametrize("dt", [0.01, 0.05])
def test_a_turning_box_touches_with_its_corner(highway: RoadMap, dt: float) -> None:
    """A long one turns on the spot beside a post: the corner sweeps over it."""
    long = Shape(12.0, 2.5, 3.0, 6.0)
    post = Shape(0.2, 0.2, 2.0, 0.1)
    states = {
        "long": ActorState(0.0, 100.0, 0.0, 0.0, 0.0, 0.0, None, 0.0, long),
        "post": ActorState(4.5, 103.5, 0.0, 0.0, 0.0, 0.0, None, 0.0, post),
    }
    world = flying(highway, states, dt)
    found = None
    for step in range(1, round(1.5 / dt) + 1):
        world.assign("long", heading=step * dt * 0.5)
        world.step()
        if world.collisions() and found is None:
            found = step * dt
    touch = next(
        t * 1e-4
        for t in range(20000)
        if common_area(corners(states["long"]._replace(h=0.5e-4 * t)), corners(states["post"])) > 0
    )
    assert found is not None
    assert 0.0 <= found - touch <= dt + 1e-9


# --- across the road -----------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [0.8, -0.8])
def test_the_time_gap_across_is_when_the_sides_meet(highway: RoadMap, rate: float) -> None:
    """A car drifts sideways at a constant rate: towards the other one the time counts down."""
    a, b = Vehicle(name="a"), Vehicle(name="b")
    world = cast(
        highway,
        (a, LanePosition("1", -2, 100.0), 20.0),
        (b, LanePosition("1", -3, 101.0), 20.0),
    )
    heading = math.asin(rate / 20.0)
    world.assign("a", at=Pose(100.0, world.state("a").y, 0.0, heading))
    gap = a.space_gap(b, "lateral")
    assert gap == pytest.approx(3.5 - 1.9, abs=1e-6)  # it is left, so positive
    time = a.time_gap(b, "lateral")
    if rate > 0.0:
        assert time == math.inf  # it moves away
    else:
        assert time == pytest.approx(gap / 0.8)
        assert b.time_gap(a, "lateral") == pytest.approx(-gap / 0.8)
    later = 0.5
    for _ in range(round(later / DT)):
        world.step()
    assert a.space_gap(b, "lateral") == pytest.approx(gap + rate * later, abs=1e-6)


def test_behind_and_ahead_have_opposite_signs_for_gap_and_headway(highway: RoadMap) -> None:
    """For one situation: gaps are positive for who is ahead, headways for who trails."""
    lead, trail = Vehicle(name="lead", length=8.0, rear_overhang=2.0), Vehicle(name="trail")
    cast(
        highway,
        (lead, LanePosition("1", -2, 140.0), 6.0),
        (trail, LanePosition("1", -2, 100.0), 10.0),
    )
    front_to_front = 40.0 + 6.0 - (4.6 - 0.92)
    rear_to_front = 40.0 - 2.0 - (4.6 - 0.92)
    assert trail.space_headway(lead) == pytest.approx(front_to_front)
    assert lead.space_headway(trail) == pytest.approx(-front_to_front)
    assert lead.space_gap(trail, "longitudinal") == pytest.approx(rear_to_front)
    assert trail.space_gap(lead, "longitudinal") == pytest.approx(-rear_to_front)
    # All times divide by the speed of the trailing one.
    assert trail.time_headway(lead) == pytest.approx(front_to_front / 10.0)
    assert lead.time_headway(trail) == pytest.approx(-front_to_front / 10.0)
    assert lead.time_gap(trail, "longitudinal") == pytest.approx(rear_to_front / 10.0)
    assert trail.time_gap(lead, "longitudinal") == pytest.approx(-rear_to_front / 10.0)
    # It closes in with 4 m/s; the other one is never reached from the front.
    assert trail.time_to_collision(lead) == pytest.approx(rear_to_front / 4.0)
    assert lead.time_to_collision(trail) == pytest.approx(rear_to_front / 4.0)


def turning(seed: int) -> tuple[tuple[ActorState, ActorState], ...]:
    """Two boxes at begin and end of a step in which they move, and turn by up to 0.3 rad."""
    draw = random.Random(9000 + seed)
    found = []
    for _ in range(2):
        length, width = draw.uniform(2.0, 12.0), draw.uniform(0.5, 2.5)
        shape = Shape(length, width, 1.5, 0.5 * length)  # the reference point is the centre
        x, y, h = draw.uniform(-6.0, 6.0), draw.uniform(-4.0, 4.0), draw.uniform(-3.0, 3.0)
        begin = ActorState(x, y, 0.0, h, 0.0, 0.0, None, 0.0, shape)
        x, y, h = x + draw.uniform(-1.0, 1.0), y + draw.uniform(-1.0, 1.0), draw.uniform(-0.3, 0.3)
        found.append((begin, begin._replace(x=x, y=y, h=begin.h + h)))
    return tuple(found)


def share_area(pairs: tuple[tuple[ActorState, ActorState], ...], parts: int) -> bool:
    """Whether two boxes have common points at some of so many instants of a step."""
    for k in range(parts + 1):
        one, other = (
            corners(
                begin._replace(
                    **{
                        name: getattr(begin, name)
                        + k / parts * (getattr(end, name) - getattr(begin, name))
                        for name in ("x", "y", "h")
                    }
                )
            )
            for begin, end in pairs
        )
        if common_area(one, other) > 0.0:
            return True
    return False


@pytest.mark.parametrize("first", range(0, 300, 50))
def test_contacts_of_boxes_that_turn_in_a_step(first: int) -> None:
    """As polygons at many instants of it have them."""
    hits = misses = 0
    for seed in range(first, first + 50):
        pairs = turning(seed)
        found = swept_contacts([box_of(b) for b, _ in pairs], [box_of(e) for _, e in pairs])
        if found:
            assert share_area(pairs, 40) or share_area(pairs, 4000)
            hits += 1
        else:
            assert not share_area(pairs, 200)
            misses += 1
    assert hits and misses


def test_a_tip_that_passes_between_two_instants() -> None:
    """The tip of a bar of 12 m passes a post; at begin and end of the step it is 0.9 m beside."""
    bar = ActorState(0.0, 0.0, 0.0, -0.15, 0.0, 0.0, None, 0.0, Shape(12.0, 0.2, 1.5, 6.0))
    post = ActorState(6.05, 0.0, 0.0, 0.0, 0.0, 0.0, None, 0.0, Shape(0.2, 0.2, 1.5, 0.1))
    for away, touches in ((0.0, True), (0.06, False)):
        there = post._replace(x=post.x + away)
        begin, end = [box_of(bar), box_of(there)], [box_of(bar._replace(h=0.15)), box_of(there)]
        assert bool(swept_contacts(begin, end)) == touches
        assert not share_area(((bar, bar._replace(h=0.15)), (there, there)), 1)
