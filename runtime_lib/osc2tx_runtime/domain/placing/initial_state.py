"""Initial speed, heading and tilt of a placed actor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from osc2tx_runtime import opendrive
from osc2tx_runtime.domain.modifiers import Location, Modifier, Speed
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind, tilt_of
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt

if TYPE_CHECKING:
    from osc2tx_runtime.world.protocol import World

Choice = Callable[[tuple[float, float]], float]
"""Chooses a value between bounds."""


class InitialState(NamedTuple):
    """A required position with the required state.

    Attributes:
        at: Position on a lane, or pose of the reference point.
        speed: m/s; None if not stated.
        heading: rad, off the lanes or opposite to the lane; None if not stated.
        tilt: Pitch and roll, as far as stated.
        aside: Lateral speed (m/s).
    """

    at: LanePosition | opendrive.Pose
    speed: float | None
    heading: float | None
    tilt: Tilt = LEVEL
    aside: float = 0.0


def speed_at(world: World, modifiers: Sequence[Modifier], choose: Choice) -> float | None:
    """Speed (m/s) that modifiers require; None without one.

    Raises:
        PlacementError: They state how it is reached.
    """
    speed = _speed_in(modifiers, "longitudinal")
    if speed is None:
        return None
    if speed.shaped:
        raise PlacementError("a speed at the start takes no rate_profile or rate_peak")
    value = choose(speed.difference())
    if speed.reference is None:
        return value
    return speed.times * world.state(speed.reference.id).v + value


def aside_speed_at(world: World, modifiers: Sequence[Modifier], choose: Choice) -> float:
    """Lateral speed (m/s) that modifiers require; zero without one."""
    speed = _speed_in(modifiers, "lateral")
    if speed is None:
        return 0.0
    other = speed.reference
    base = 0.0 if other is None else speed.times * world.state(other.id).lateral_speed
    return base + choose(speed.difference())


def tilt_at(world: World, modifiers: Sequence[Modifier], pose: opendrive.Pose) -> Tilt:
    """Pitch and roll that modifiers require at a position."""
    location = one_of_kind(modifiers, Location)
    if location is None:
        return tilt_of(world, modifiers, pose)
    pitch, roll = location.pose.pitch, location.pose.roll
    return Tilt(pitch, roll) if pitch or roll else LEVEL


def _speed_in(modifiers: Sequence[Modifier], direction: str) -> Speed | None:
    """The speed in a direction; None without one."""
    return one_of_kind(
        [m for m in modifiers if isinstance(m, Speed) and m.direction == direction], Speed
    )
