"""Start conditions of an action (`at: start`): checked, or set instantly.

If physics need not hold (`physical_movement(prefer_non_physical)`), the actor is set to them
instantly. Otherwise the preceding actions have to establish them; if they have not, the action
fails.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import (
    Along,
    Lane,
    Lateral,
    Modifier,
    Orient,
    Position,
    Speed,
    Yaw,
    value_of,
)
from osc2tx_runtime.domain.modifiers.groups import PLACES
from osc2tx_runtime.domain.placing.placer import Placer
from osc2tx_runtime.domain.placing.pose_resolution import (
    heading_of,
    headings_of,
    pose_of,
    tilt_of,
)
from osc2tx_runtime.domain.planning.lateral.lateral_speed_planning import lateral_speed_bounds
from osc2tx_runtime.domain.planning.lateral.lateral_targets import lanes_wanted
from osc2tx_runtime.domain.planning.longitudinal.goals import way_to
from osc2tx_runtime.domain.planning.longitudinal.longitudinal_planning import speed_at_start
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.domain.routes.lane_coordinates import position_from
from osc2tx_runtime.domain.routes.place_on_route import driven_on_route
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.measuring.deviation import PLACE_TOLERANCE, SPEED_TOLERANCE
from osc2tx_runtime.world.measuring.distances import along_lanes, is_oncoming, lateral_on_road

from .orientation_planning import check_tilt

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .motion_action import ModifiedMotion

_NEAR = 0.1  # m
_SPEED_NEAR = 0.05  # m/s
_TURNED = 0.01  # rad


def hold_or_jump(action: ModifiedMotion) -> bool:
    """Establishes the conditions at the start.

    Returns:
        True if the actor is moved, which is visible from the next pass on.

    Raises:
        Refused: It does not hold.
        PlacementError: There is no such place.
    """
    at_start = [m for m in action.modifiers if getattr(m, "at", "all") == "start" or _stands(m)]
    places = [modifier for modifier in at_start if isinstance(modifier, (*PLACES, Along))]
    if not action.may_jump:
        for modifier in at_start:
            _check(action, modifier)
        _check_measured(action, at_start)
        return False
    if places:
        speeds = [m for m in at_start if isinstance(m, Speed) and m.direction == "longitudinal"]
        _jump(action, [*places, *speeds])
    return bool(places)


def _stands(modifier: Modifier) -> bool:
    return isinstance(modifier, Position) and modifier.stands


def _jump(action: ModifiedMotion, modifiers: Sequence[Modifier]) -> None:
    world = action.world
    if not any(isinstance(modifier, Along | Position | Lane | Lateral) for modifier in modifiers):
        heading = heading_of(world, action.movable, modifiers, action.here)
        action.turn(heading, tilt_of(world, modifiers, action.here))
        return
    draws = action.generator(f"{action.action_name} start")
    action.be_at(Placer(world).initial_state(action.movable, modifiers, action.here, draws=draws))


def _check(action: ModifiedMotion, modifier: Modifier) -> None:
    match modifier:
        case Speed(direction="longitudinal"):
            low, high = speed_at_start(action, modifier)
            _within(action.here.v, low, high, _SPEED_NEAR, "its speed is", "m/s")
        case Speed():
            low, high = lateral_speed_bounds(action, modifier)
            aside = action.here.lateral_speed
            _within(aside, low, high, _SPEED_NEAR, "its lateral speed is", "m/s")
        case Position():
            _check_place(action, modifier)
        case Along():
            _check_route(action, modifier)
        case Lane():
            lanes = lanes_wanted(action, modifier)
            if lanes:
                here = action.place_of(action.actor.id)
                side = "right" if lanes > 0 else "left"
                raise Refused(
                    f"at its start it is in lane {here.lane} of road {here.road}, {abs(lanes)} to"
                    f" the {side} of the required one"
                )
        case Lateral():
            _check_lateral(action, modifier)
        case Yaw() | Orient():
            check_tilt(action, modifier)
            found = headings_of(action.world, action.movable, [modifier], action.here)
            if found is None:
                return
            low, high = found
            turn = turn_between(low, action.here.h)
            if not -_TURNED <= turn <= high - low + _TURNED:
                raise Refused(
                    f"at its start its heading deviates by {math.degrees(turn):.1f} degrees from"
                    f" the one that {modifier.name} requires"
                )


def _check_measured(action: ModifiedMotion, at_start: Sequence[Modifier]) -> None:
    """Rejects conditions that hold for the commanded state, but not for the measured one."""
    off = action.world.deviation(action.actor.id, ())
    if off is None:
        return
    if abs(off.speed) > SPEED_TOLERANCE and any(isinstance(m, Speed) for m in at_start):
        raise Refused(f"at its start its speed deviates by {off.speed:+.2f} m/s")
    if abs(off.place) > PLACE_TOLERANCE and any(isinstance(m, PLACES) for m in at_start):
        raise Refused(f"at its start it is {abs(off.place):.2f} m off its path")


def _check_place(action: ModifiedMotion, position: Position) -> None:
    if position.absolute and not position.project_on_route:
        at, _ = pose_of(action.movable, position)
        off = math.hypot(action.here.x - at.x, action.here.y - at.y)
        _within(off, 0.0, 0.0, _NEAR, "its distance from its point is", "m")
        return
    here, low, high, what = measured(action, position)
    _within(here, low, high, _NEAR, what, "m")


def _check_route(action: ModifiedMotion, along: Along) -> None:
    """Rejects a start on a route at another position than its offset.

    With a position, a start off it.
    """
    try:
        here, _ = driven_on_route(action.world.map, along.way, action.here)
    except ScenarioError as error:
        raise Refused(f"at its start {error.message}") from None
    if not any(isinstance(m, Position) and m.at == "start" for m in action.modifiers):
        offset = value_of(along.start_offset)
        _within(here, offset, offset, _NEAR, "its distance along the route is", "m")


def measured(action: ModifiedMotion, position: Position) -> tuple[float, float, float, str]:
    """The measured position (m) of an actor, its required range, and its name in messages.

    Raises:
        Refused: No route leads to the reference.
    """
    if position.reference is None:
        place = action.place_of(action.actor.id)
        here = position_from(action.world.map, action.origin, place)
        what = "its position along its road is"
        if position.is_on_road:
            return here, *position.size(), what
        low, high = way_to(action, position)
        return here, here + low, here + high, what
    other = action.world.state(position.reference.id)
    along = along_lanes(action.world.map, other, action.here)
    if along is None:
        raise Refused(f"there is no route along lanes to {position.reference.id}")
    low, high = position.size()
    if position.timed:
        trailing = max(other.v if position.ahead else action.here.v, 0.0)
        low, high = low * trailing, high * trailing
    here = along if position.ahead else -along
    side = "ahead of" if position.ahead else "behind"
    return here, low, high, f"its distance {side} {position.reference.id} is"


class PlaceWatch:
    """A position to reach while another modifier determines the speed.

    Attributes:
        missed: How the position is missed at the present step; None if it is reached.
    """

    def __init__(self, position: Position) -> None:
        self._position = position
        self._before: float | None = None
        self.missed: str | None = None

    def reached(self, action: ModifiedMotion) -> bool:
        """Whether the actor is there, or has passed the position if its end is unknown."""
        here, low, high, what = measured(action, self._position)
        off = here - min(max(here, low), high)
        before, self._before = self._before, off
        passed = before is not None and before * off <= 0.0 and not action.end_is_known
        if passed or abs(off) <= _NEAR:
            self.missed = None
            return True
        wanted = f"{low:.2f}" if low == high else f"from {low:.2f} to {high:.2f}"
        self.missed = f"at its end {what} {here:.2f} m, not {wanted} m"
        return False


def _check_lateral(action: ModifiedMotion, lateral: Lateral) -> None:
    here = action.here
    place = action.place_of(action.actor.id)
    if lateral.side_of is None:
        width = action.world.map.lane_width(place.road, place.lane, place.s)
        low, high = lateral.offsets(here.width, width)
        _within(place.offset, low, high, _NEAR, "its distance left of its lane's centre is", "m")
        return
    other = action.world.state(lateral.side_of.id)
    aside = lateral_on_road(action.world.map, here, other)
    if aside is None:
        raise Refused(f"there is no route along lanes to {lateral.side_of.id}")
    low, high = lateral.offsets(here.width, other.width, oncoming=is_oncoming(here, other))
    _within(0.0 - aside, low, high, _NEAR, f"its distance left of {lateral.side_of.id} is", "m")


def _within(value: float, low: float, high: float, near: float, what: str, unit: str) -> None:
    """Rejects a value outside its bounds."""
    if low - near <= value <= high + near:
        return
    wanted = f"{low:.2f}" if low == high else f"from {low:.2f} to {high:.2f}"
    raise Refused(f"at its start {what} {value:.2f} {unit}, not {wanted} {unit}")
