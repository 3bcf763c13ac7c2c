"""Commands for shapes of positions: the position of an actor over time (DSL 8.9.1.2)."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from osc2tx_runtime.domain.modifiers import Along, Distance, Position, value_of
from osc2tx_runtime.domain.modifiers.base import course_of, own_course, target_of
from osc2tx_runtime.domain.planning.feasibility import check_course, check_peak
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.domain.routes.lane_coordinates import position_from, way_to_position
from osc2tx_runtime.domain.routes.place_on_route import place_on_route
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.commands import Command, Cover, GapCourse
from osc2tx_runtime.world.geometry.function_profiles import Computed, Mapped, change_profile
from osc2tx_runtime.world.measuring.distances import along_lanes
from osc2tx_runtime.world.motion.moving_body import cruise_of

from .goals import way_to

if TYPE_CHECKING:
    from osc2tx_runtime.domain.modifiers.base import Shape
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion
    from osc2tx_runtime.world.geometry.profiles import Profile

    Placing = Along | Distance | Position

_THERE = 0.1  # m
_ONE_WAY = 3.0  # times the distance at the present speed: beyond it the cubic overshoots


class _Way(NamedTuple):
    """Relation between the quantity of a shape and the distance of the actor.

    Attributes:
        here: Value of the quantity now (m).
        target: Its target (m), if the shape states none.
        sign: Sign of its change while the actor moves forwards.
        speed: Rate of the quantity now (m/s).
    """

    here: float
    target: float
    sign: float
    speed: float


def position_command(action: ModifiedMotion, modifier: Placing) -> Command:
    """The command that follows a shape.

    Raises:
        Refused: It is not possible.
    """
    shape = modifier.shape
    assert shape is not None
    relative = isinstance(modifier, Position) and modifier.reference is not None
    way = _gap(action, modifier) if relative else _way(action, modifier)
    course = _course(action, modifier, shape, way)
    moved: Profile = Mapped(course, way.sign, 0.0 if relative else -way.sign * way.here)
    if isinstance(modifier, Position) and modifier.is_on_road and own_course(shape) is not None:
        moved = _along_lane(action, course)
    if relative:
        assert isinstance(modifier, Position) and modifier.reference is not None
        other = action.world.state(modifier.reference.id).v
        check_course(action, modifier, moved, other, ends=False)
        return GapCourse(modifier.reference.id, moved, modifier.projected, action.may_jump)
    ends = modifier.at == "end" or not isinstance(modifier, Position)
    check_course(action, modifier, moved, 0.0, ends=ends)
    return Cover(moved, action.may_jump)


def check_way_to_gap(action: ModifiedMotion, position: Position, time: float | None) -> None:
    """Rejects an approach in which the distance is not monotonous.

    Args:
        action: The action.
        position: The target position.
        time: Seconds until then, with the least effort; None: comfortable motion.
    """
    if position.timed:
        return  # it depends on the speed, which changes meanwhile
    way = _gap(action, position)
    missing = way.target - way.here
    away = missing * way.speed < 0.0
    beyond = time is not None and abs(way.speed) * time > _ONE_WAY * abs(missing)
    if abs(missing) > _THERE and (away or (beyond and way.speed != 0.0)):
        raise Refused(
            f"position: it would have to reverse, for the distance changes by {way.speed:.2f} m/s"
            f" and is to change by {missing:.2f} m"
        )


def _way(action: ModifiedMotion, modifier: Placing) -> _Way:
    v = action.here.v
    match modifier:
        case Distance():
            return _Way(0.0, modifier.way(), 1.0, v)
        case Along():
            return _along(action, modifier)
    place = action.place_of(action.actor.id)
    if modifier.reference_point is not None:
        low, high = way_to(action, modifier)
        least, most = modifier.size()
        sign = 1.0 if modifier.ahead else -1.0
        here = least - low if modifier.ahead else least + high
        return _Way(here, min(max(here, least), most), sign, sign * v)
    here = position_from(action.world.map, action.origin, place)
    low, high = way_to(action, modifier)
    return _Way(here, min(max(here, here + low), here + high), 1.0, v)


def _along_lane(action: ModifiedMotion, course: Profile) -> Computed:
    """The distance (m) along the lane over time, from positions along the road over time."""
    here = action.place_of(action.actor.id)
    way = partial(way_to_position, action.world.map, action.origin, here)
    return Computed(lambda t: way(course.value(t)), course.duration)


def _along(action: ModifiedMotion, along: Along) -> _Way:
    try:
        here, length = place_on_route(action.world.map, along.way, action.here)
    except ScenarioError as error:
        raise Refused(error.message) from error
    end = length - value_of(along.end_offset)
    target = target_of(along.shape)
    if target is not None and abs(target - end) > 1e-3:
        raise Refused(
            f"the shape ends {target:g} m along the route, which it has to leave after {end:g} m"
        )
    return _Way(here, end, 1.0, action.here.v)


def _gap(action: ModifiedMotion, modifier: Placing) -> _Way:
    assert isinstance(modifier, Position) and modifier.reference is not None
    other = action.world.state(modifier.reference.id)
    ahead = along_lanes(action.world.map, other, action.here)
    if ahead is None:
        raise Refused(f"there is no route along lanes to {modifier.reference.id}")
    sign = 1.0 if modifier.ahead else -1.0
    least, most = modifier.size()
    here = sign * ahead
    return _Way(here, min(max(here, least), most), sign, sign * (action.here.v - other.v))


def _course(action: ModifiedMotion, modifier: Placing, shape: Shape, way: _Way) -> Profile:
    """The quantity over time."""
    own = own_course(shape)
    if own is not None:
        return own
    profile, peak = course_of(shape)
    check_peak(peak, "m/s")
    if profile == "smooth" and peak is not None and peak <= abs(way.speed):
        raise Refused(
            f"a rate_peak of {peak:g} m/s cannot be reached from {abs(way.speed):.2f} m/s"
        )
    timed = modifier.at == "end" or isinstance(modifier, Distance | Along)
    time = action.time_left() if timed and peak is None and profile != "asap" else None
    limits = action.limits
    usual = abs(way.speed) or cruise_of(action.movable.spec().kind)
    least = min(limits.acceleration, limits.deceleration)
    return change_profile(way.here, way.target, way.speed, (profile, peak, time), (usual, least))
