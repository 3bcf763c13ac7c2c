"""Commands for modifiers of the orientation: heading, pitch, roll (DSL 8.9.9, 8.9.10)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Orient, Yaw
from osc2tx_runtime.domain.modifiers.base import own_course
from osc2tx_runtime.domain.placing.pose_resolution import (
    heading_base,
    heading_of,
    tilt_of,
)
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.world.commands import Command, Slant, Turn
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.geometry.function_profiles import Mapped
from osc2tx_runtime.world.lateral.execution import HEADING_LIMIT

from .feasibility import check_one_way

if TYPE_CHECKING:
    from osc2tx_runtime.world.geometry.profiles import Profile

    from .motion_action import ModifiedMotion

_TILTED = 0.01  # rad


def turn_command(action: ModifiedMotion, turned: Yaw | Orient) -> Command | None:
    """The command to turn; None if only a tilt is stated, and the road has it.

    Raises:
        Refused: It cannot turn by this angle from its lane, or it has to follow the road.
    """
    here, world = action.here, action.world
    heading = heading_of(world, action.movable, [turned], here)
    course = _course(action, turned)
    tilt = tilt_of(world, [turned], here)
    if action.may_jump:
        _jump(action, heading if course is None else course.value(0.0), tilt)
    if not action.movable.lane_bound or here.lane_position is None:
        return Turn(heading, course, tilt.pitch, tilt.roll)
    if heading is None:
        return None
    lane = world.map.pose(here.lane_position)
    angle = turn_between(lane.h, heading)
    for each in (angle, *_samples(course, lane.h)):
        if abs(each) > HEADING_LIMIT:
            raise Refused(
                f"{action.actor.id} follows its lane and can turn"
                f" {math.degrees(HEADING_LIMIT):.1f} degrees from it, not"
                f" {math.degrees(abs(each)):.1f}"
            )
    return Slant(angle, None if course is None else Mapped(course, 1.0, -lane.h))


def check_tilt(action: ModifiedMotion, turned: Yaw | Orient) -> None:
    """Rejects a pitch and roll that an actor does not have.

    Raises:
        Refused: Its tilt differs.
    """
    here, tilt = action.here, tilt_of(action.world, [turned], action.here)
    for name, wanted, found in (
        ("pitch", tilt.pitch, here.pitch),
        ("roll", tilt.roll, here.roll),
    ):
        if wanted is not None and abs(turn_between(found, wanted)) > _TILTED:
            raise Refused(
                f"{action.actor.id} has a {name} of {math.degrees(found):.1f} degrees, not"
                f" {math.degrees(wanted):.1f}"
            )


def tilt_again(action: ModifiedMotion) -> None:
    """Keeps a tilt that the wheels would reset, or checks that the road still has it.

    Raises:
        Refused: The tilt of the road has changed.
    """
    turned = action.orient
    if turned is None:
        return
    if action.may_jump:
        _jump(action, None, tilt_of(action.world, [turned], action.here))
    elif turned.at == "all":
        check_tilt(action, turned)


def lies_so(action: ModifiedMotion) -> bool:
    """Whether a vehicle has the tilt required at the end; always true for actors that turn."""
    turned = action.orient
    if turned is None:
        return True
    try:
        check_tilt(action, turned)
    except Refused:
        return False
    return True


def _course(action: ModifiedMotion, turned: Yaw | Orient) -> Profile | None:
    """The heading (rad) over time, if a shape computes it."""
    own = own_course(turned.shape)
    if own is None:
        return None
    check_one_way(turned, own)
    return Mapped(own, 1.0, heading_base(action.world, turned, action.here))


def _samples(course: Profile | None, lane: float) -> list[float]:
    """Angles (rad) relative to the lane over time."""
    if course is None:
        return []
    end = 1.0 if math.isinf(course.duration) else course.duration
    return [turn_between(lane, course.value(end * i / 20.0)) for i in range(21)]


def _jump(action: ModifiedMotion, heading: float | None, tilt: Tilt) -> None:
    """Turns the actor instantly; an actor on a lane keeps the heading of the lane."""
    if action.movable.lane_bound and action.here.lane_position is not None:
        heading = None
    if (heading, tilt) != (None, LEVEL):
        action.turn(heading, tilt)
