"""Poses, headings and tilts that modifiers require."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeVar

from osc2tx_runtime import opendrive
from osc2tx_runtime.domain.modifiers import Modifier, Orient, Position, Yaw
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt, tilt_on
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.motion.moving_body import ANY_LANE

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import PhysicalObject
    from osc2tx_runtime.world.protocol import World
    from osc2tx_runtime.world.state import ActorState

# Added to an angle between axes to get the heading: the width axis points left.
_AXES = {"length_to_width": 0.5 * math.pi, "width_to_length": -0.5 * math.pi}

ModifierT = TypeVar("ModifierT", bound=Modifier)


def one_of_kind(modifiers: Sequence[Modifier], kind: type[ModifierT]) -> ModifierT | None:
    """The only modifier of a kind; None without one."""
    found = [modifier for modifier in modifiers if isinstance(modifier, kind)]
    if len(found) > 1:
        raise PlacementError(f"{found[0].name} is given {len(found)} times")
    return found[0] if found else None


def heading_of(
    world: World,
    actor: PhysicalObject,
    modifiers: Sequence[Modifier],
    at: opendrive.Pose | ActorState,
) -> float | None:
    """Heading (rad) that yaw or orientation require; None if not given.

    For a range, the heading nearest to the present one.

    Args:
        world: The world.
        actor: The actor to turn.
        modifiers: The modifiers of an action or a placement.
        at: The position of the actor.
    """
    found = headings_of(world, actor, modifiers, at)
    if found is None:
        return None
    low, high = found
    beyond = turn_between(low, at.h)  # its turn to the left of the least angle
    if low == high or 0.0 <= beyond <= high - low:
        return low if low == high else at.h
    return low if abs(beyond) <= abs(turn_between(high, at.h)) else high


def headings_of(
    world: World,
    actor: PhysicalObject,
    modifiers: Sequence[Modifier],
    at: opendrive.Pose | ActorState,
) -> tuple[float, float] | None:
    """Least and greatest heading (rad) that yaw or orientation allow; arguments as above."""
    turned = one_of_kind(modifiers, Yaw) or one_of_kind(modifiers, Orient)
    angles = None if turned is None else turned.angles()
    if turned is None or angles is None:
        return None
    low, high = angles
    base = heading_base(world, turned, at)
    return base + low, base + high


def heading_base(
    world: World,
    turned: Yaw | Orient,
    at: opendrive.Pose | ActorState,
    other: ActorState | None = None,
) -> float:
    """The heading (rad) from which an angle counts.

    Args:
        world: The world.
        turned: The modifier.
        at: Position or state of the actor.
        other: State of the reference of the modifier; default: the present one.
    """
    if isinstance(turned, Orient):
        base = 0.0 if turned.measure_by == "absolute" else road_heading(world.map, at)
    else:
        north = turned.measure_by == "relative_to_north"
        base = 0.5 * math.pi if north else road_heading(world.map, at)
        base += _AXES.get(turned.measure_by, 0.0)
    if turned.relative_to is not None and turned.measure_by != "absolute":
        other = other or world.state(turned.relative_to.id)
        base = other.h + _AXES.get(turned.measure_by or "", 0.0)
    return base


def tilt_of(world: World, modifiers: Sequence[Modifier], at: opendrive.Pose | ActorState) -> Tilt:
    """Pitch and roll (rad) that an orientation requires; arguments as above."""
    turned = one_of_kind(modifiers, Orient)
    if turned is None or (turned.pitch is None and turned.roll is None):
        return LEVEL
    pitch, roll = turned.tilt()
    base = (0.0, 0.0)
    if turned.relative_to is not None and turned.measure_by != "absolute":
        other = world.state(turned.relative_to.id)
        base = (other.pitch, other.roll)
    elif turned.measure_by != "absolute":
        on = world.map.locate(at.x, at.y, at.z, lane_types=ANY_LANE, max_distance=1e-3)
        base = (0.0, 0.0) if on is None else tilt_on(world.map.pose(on), at.h)
    return Tilt(
        None if pitch is None else base[0] + pitch, None if roll is None else base[1] + roll
    )


def road_heading(road_map: RoadMap, at: opendrive.Pose | ActorState) -> float:
    """Direction of travel (rad) of the lane under a point, else of the nearest driving lane."""
    on = road_map.locate(at.x, at.y, at.z, lane_types=ANY_LANE, max_distance=1e-3)
    if on is None:
        on = road_map.locate(at.x, at.y, at.z)
    return 0.0 if on is None else road_map.pose(on).h


def pose_of(actor: PhysicalObject, position: Position) -> tuple[opendrive.Pose, float | None]:
    """Pose of the reference point, and the heading if one is given."""
    if position.at_point is not None:
        point = position.at_point
        heading = None if position.h is None else float(position.h)
        return opendrive.Pose(point.x, point.y, point.z, heading or 0.0), heading
    x, y, z = position.x or 0.0, position.y or 0.0, position.z or 0.0
    heading = None if position.h is None else float(position.h)
    if position.frame == "world":
        return opendrive.Pose(x, y, z, heading or 0.0), heading
    heading = None if heading is None else -heading
    h = heading or 0.0
    back = actor.shape.centre  # CARLA places the box centre
    return opendrive.Pose(x - back * math.cos(h), -y - back * math.sin(h), z, h), heading
