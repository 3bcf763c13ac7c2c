"""Lateral commands for modifiers of lane and lateral position (DSL 8.9.8, 8.9.14, 8.9.15)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import ChangeLane, Lane, Lateral, MovementModifier
from osc2tx_runtime.domain.modifiers.base import course_of, own_course
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.planning.feasibility import check_one_way, check_peak
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.domain.shapes import OwnShape
from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.world.commands import Beside, Command, LaneChange, LaneOffset
from osc2tx_runtime.world.geometry.function_profiles import Computed
from osc2tx_runtime.world.geometry.lane_neighbours import offset_from, width_at
from osc2tx_runtime.world.lateral.execution import shift_profile
from osc2tx_runtime.world.measuring.distances import drift, is_oncoming, lateral_on_road
from osc2tx_shared.classes import replace

from .lateral_targets import check_shift, jump_aside, lanes_wanted, target_of_shift

if TYPE_CHECKING:
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion
    from osc2tx_runtime.world.geometry.profiles import Profile

_OFF = 0.1  # m between the start of a shape and the actor


def beside_command(action: ModifiedMotion, lateral: Lateral) -> Command:
    """The command for a lateral position beside another actor.

    Raises:
        Refused: It is not possible.
    """
    assert lateral.side_of is not None
    other = action.world.state(lateral.side_of.id)
    oncoming = is_oncoming(action.here, other)
    low, high = lateral.offsets(action.here.width, other.width, oncoming=oncoming)
    time = action.time_left() if lateral.at == "end" else None
    beside = Beside(
        lateral.side_of.id, low, spread=high - low, projected=lateral.projected, duration=time
    )
    if lateral.shape is None and not lateral.monotonous:
        return beside
    to_left = lateral_on_road(action.world.map, action.here, other)
    if to_left is None:
        raise Refused(f"there is no route along lanes to {lateral.side_of.id}")
    own = _own(action, lateral, other.width, oncoming)
    if own is not None:
        return replace(beside, course=own)
    profile, peak = course_of(lateral.shape)
    check_peak(peak, "m/s")
    rate = action.here.lateral_speed - drift(action.here, other)
    course = shift_profile(
        -to_left,
        min(max(-to_left, low), high),
        rate,
        (profile, peak, None if profile == "asap" or peak is not None else time),
        action.limits,
    )
    check_one_way(lateral, course)
    return replace(beside, course=course)


def lane_command(action: ModifiedMotion, lateral: Lateral | None) -> Command | None:
    """The command for a lane and an offset in it.

    None if no modifier states them, or if they are reached.

    Raises:
        Refused: It is not possible.
    """
    kinds = (Lane, ChangeLane, Lateral)
    found = [m for m in action.lasting if isinstance(m, kinds)]
    lanes = _lanes(action)
    if lanes is None and lateral is None:
        return None
    offset = 0.0
    if lateral is not None:
        offset = _offset(action, lateral, lanes or 0)
    shaped = next((modifier for modifier in found if modifier.shape is not None), None)
    if not lanes and lateral is None and shaped is None and _is_centred(action):
        return None
    if action.may_jump and not (shaped and isinstance(shaped.shape, OwnShape)):
        jump_aside(action, lanes or 0, offset)
        return None
    profile, peak = course_of(None if shaped is None else shaped.shape)
    check_peak(peak, "m/s")
    duration = None
    if any(modifier.at == "end" for modifier in found) and profile != "asap" and peak is None:
        duration = action.time_left()
    if duration is not None and action.strict:
        check_shift(action, lanes or 0, offset, duration)
    course = None if shaped is None else _own_across(action, shaped, lanes or 0)
    if any(modifier.monotonous for modifier in found):
        surprised = next(modifier for modifier in found if modifier.monotonous)
        _check_one_way(action, surprised, lanes or 0, offset, (profile, peak, duration), course)
    if lanes is None:
        return LaneOffset(offset, profile, peak, duration, course)
    return LaneChange(lanes, offset, profile, peak, duration, course)


def _check_one_way(
    action: ModifiedMotion,
    modifier: MovementModifier,
    lanes: int,
    offset: float,
    change: tuple[DynamicProfile, float | None, float | None],
    course: Profile | None,
) -> None:
    """Rejects a lateral motion that would overshoot."""
    if course is None:
        course = shift_profile(
            _start(action, lanes), offset, action.here.lateral_speed, change, action.limits
        )
    check_one_way(modifier, course)


def _own_across(
    action: ModifiedMotion, shaped: Lane | ChangeLane | Lateral, lanes: int
) -> Profile | None:
    """The offset to the left of the target lane centre over time, from a shape of the scenario."""
    there = target_of_shift(action, lanes)
    course = _own(action, shaped, width_at(action.world.map, there))
    if course is None:
        return None
    first, here = course.value(0.0), _start(action, lanes)
    if abs(first - here) > _OFF and not action.may_jump:
        raise Refused(
            f"the shape starts {first:.2f} m left of the centre of its lane, and it is"
            f" {here:.2f} m left of it"
        )
    return course


def _own(
    action: ModifiedMotion,
    shaped: Lane | ChangeLane | Lateral,
    width: float,
    oncoming: bool = False,
) -> Computed | None:
    """The offset (m to the left) over time, from a shape of the scenario and the adjacent width."""
    own = own_course(shaped.shape)
    if own is None or not isinstance(shaped, Lateral):
        return own
    mine = action.here.width
    return Computed(lambda t: shaped.place(own.value(t), mine, width, oncoming), own.duration)


def _is_centred(action: ModifiedMotion) -> bool:
    return action.here.offset == 0.0 or action.here.offset == target_of_shift(action, 0).offset


def _start(action: ModifiedMotion, lanes: int) -> float:
    """Its distance (m) to the left of the target lane centre."""
    there, here = target_of_shift(action, lanes), action.here
    return offset_from(action.world.map, there, here.x, here.y)


def _offset(action: ModifiedMotion, lateral: Lateral, lanes: int) -> float:
    """Metres to the left of the target lane centre."""
    there = target_of_shift(action, lanes)
    here = (action.here.offset or 0.0) - there.offset if lanes == 0 else 0.0
    return lateral.offset(action.here.width, width_at(action.world.map, there), here)


def _lanes(action: ModifiedMotion) -> int | None:
    """Number of lanes to the left of the present one; None if no modifier states a lane."""
    change = one_of_kind(action.lasting, ChangeLane)
    if change is not None:
        side = change.side or action.drawn_side(change.number)
        return change.number if side == "left" else -change.number
    lane = one_of_kind(action.lasting, Lane)
    return None if lane is None else lanes_wanted(action, lane)
