"""Value classes for parts of physical objects (DSL 8.6, 8.7.11 to 8.7.14).

A scenario may declare a part as a whole or some members of it. Open members are `UNSAID` in the
value, and the actor that the part belongs to fills them in from the catalogue.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import field, fields
from typing import Protocol, TypeVar

from osc2tx_runtime.domain.points_and_poses import Point
from osc2tx_runtime.enums import HitchType
from osc2tx_runtime.errors import UnsupportedError
from osc2tx_shared.classes import dataclass, replace

UNSAID = math.nan
"""A number that is not stated."""

_NOWHERE = Point(UNSAID, UNSAID, UNSAID)

PartT = TypeVar("PartT", "BoundingBox", "Axle", "HitchReceiver", "HitchCoupler")


@dataclass(frozen=True, slots=True)
class BoundingBox:
    """Box around an object without side mirrors, down to the ground.

    Attributes:
        center: Its centre (m), from the reference point of the object.
        length: Metres along x.
        width: Metres along y.
        height: Metres along z.
    """

    center: Point = _NOWHERE
    length: float = UNSAID
    width: float = UNSAID
    height: float = UNSAID


@dataclass(frozen=True, slots=True)
class Axle:
    """An axle with its wheels.

    Attributes:
        max_steering: Largest angle of its wheels (rad).
        wheel_diameter: Metres.
        track_width: Metres between the centre lines of the outer wheels.
        position_x: Metres ahead of the reference point of the vehicle.
        position_z: Metres above it.
        number_of_wheels: On both sides together.
    """

    max_steering: float = UNSAID
    wheel_diameter: float = UNSAID
    track_width: float = UNSAID
    position_x: float = UNSAID
    position_z: float = UNSAID
    number_of_wheels: int = 2


@dataclass(frozen=True, slots=True)
class HitchReceiver:
    """The receiver of a hitch, on the towing vehicle.

    Attributes:
        hitch_type: Type of the matching couplers.
        position_x: Metres ahead of the reference point of the vehicle.
        position_z: Metres above it.
        max_rotation: Largest yaw between both vehicles (rad).
        max_tilt: Largest pitch or roll between both vehicles (rad).
        connected: Returns whether a trailer is coupled now.
    """

    hitch_type: HitchType = "none"
    position_x: float = UNSAID
    position_z: float = UNSAID
    max_rotation: float = UNSAID
    max_tilt: float = UNSAID
    connected: Callable[[], bool] = field(default=lambda: False, compare=False, repr=False)

    @property
    def is_towing(self) -> bool:
        """Whether a trailer is coupled now."""
        return self.connected()


@dataclass(frozen=True, slots=True)
class HitchCoupler:
    """The coupler of a hitch, on the trailer.

    Attributes:
        hitch_type: Type of the matching receiver; None: open.
        position_x: Metres ahead of the reference point of the trailer.
        position_z: Metres above it.
        connected: Returns whether it is coupled now.
    """

    hitch_type: HitchType | None = None
    position_x: float = UNSAID
    position_z: float = UNSAID
    connected: Callable[[], bool] = field(default=lambda: False, compare=False, repr=False)

    @property
    def is_towed(self) -> bool:
        """Whether a vehicle tows it now."""
        return self.connected()


class Towable(Protocol):
    """A receiver for the coupler of a trailer."""

    id: str

    def misfit(self, receiver: HitchReceiver) -> str | None:
        """Return why a receiver does not fit, as far as it is declared; None if it fits."""


def completed(said: PartT, known: PartT) -> PartT:
    """Return the declared values, completed by the known ones."""
    names = [each.name for each in fields(said) if is_open(getattr(said, each.name))]
    return replace(said, **{name: getattr(known, name) for name in names})


def is_open(value: object) -> bool:
    """Whether a member of a part is not stated."""
    if isinstance(value, Point):
        return value.x != value.x
    return value is None or value != value


ENGINES = ("steady_driver", "careful_driver")
"""Names of the models that the embedded world has."""


@dataclass(frozen=True, slots=True)
class BmEngine:
    """The driver model of an object while no action controls it.

    Attributes:
        name: `steady_driver` holds the speed and keeps the lane; `careful_driver` also keeps a gap
            to vehicles ahead and stops at red lights.

    Raises:
        UnsupportedError: There is no model of this name.
    """

    name: str = ENGINES[0]

    def __post_init__(self) -> None:
        if type(self) is not BmEngine:
            raise UnsupportedError(
                f"the content of {type(self).__name__} means nothing to the embedded world; name"
                f" one of its models in `bm_engine.name`: {', '.join(ENGINES)}"
            )
        if self.name not in ENGINES:
            known = ", ".join(ENGINES)
            raise UnsupportedError(f"there is no behavioral model `{self.name}`; known: {known}")


@dataclass(frozen=True, slots=True)
class BehavioralModel:
    """The behavior of an object without actions (DSL 8.6)."""

    bm_engine: BmEngine = BmEngine()
