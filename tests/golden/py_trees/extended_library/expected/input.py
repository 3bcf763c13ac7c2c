"""Scenario `extended_library`.

Members that a file adds to types of the library.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, Unpack

import osc2tx_runtime as library
from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    On,
    Parallel,
    Scenario,
    Serial,
    Wait,
    main,
    require_api,
    rise,
    within,
)
from osc2tx_runtime.fields import EnvironmentFields, ObjectFields, VehicleFields
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import m, mps, s

require_api(1)

# Enums that the scenario declares
Cargo: TypeAlias = Literal["goods", "people"]


class Environment(library.Environment):
    """Actor `environment` with what `extend` adds."""

    def __init__(self, *, is_festive: bool = False, **fields: Unpack[EnvironmentFields]) -> None:
        super().__init__(**fields)
        self.is_festive = is_festive


class PhysicalObject(library.PhysicalObject):
    """Actor `physical_object` with what `extend` adds.

    Each object has an owner.
    """

    def __init__(self, *, owner: str = "nobody", **fields: Unpack[ObjectFields]) -> None:
        super().__init__(**fields)
        self.owner = owner


class MovableObject(PhysicalObject, library.MovableObject):
    """Actor `movable_object` with what `extend` adds."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(**fields)


class TrafficParticipant(MovableObject, library.MovableObject):
    """Actor `traffic_participant` with what `extend` adds."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(**fields)


class Vehicle(TrafficParticipant, library.Vehicle):
    """Actor `vehicle` with what `extend` adds."""

    def __init__(self, *, carries: Cargo, seats: int, **fields: Any) -> None:
        super().__init__(**fields)
        self.carries = carries
        # keep(it in [2..50])
        self.seats = seats

    def is_larger(self, other: "Vehicle") -> bool:
        return self.seats > other.seats


class Bus1(Vehicle):
    """Actor `bus_1`."""

    kinds = ("bus_1", *Vehicle.kinds)

    class Inherited(VehicleFields, total=False):
        """Keywords of the bases."""

        owner: str
        carries: Cargo
        seats: int

    def __init__(self, *, line: int, **fields: Unpack[Inherited]) -> None:
        super().__init__(**fields)
        self.line = line


class Person(TrafficParticipant, library.Person):
    """Actor `person` with what `extend` adds."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(**fields)


@dataclass(frozen=True, kw_only=True, eq=False)
class Position3d(library.Point):
    """Struct `position_3d` with what `extend` adds."""

    note: str = ""


class ExtendedLibrary(Scenario):
    name = "extended_library"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.world = self.cast("world", Environment())
        self.ego_seats = self.parameter("ego.seats", within(2, 50))
        self.ego = self.cast(
            "ego", Vehicle(seats=self.ego_seats, carries="goods", owner="the shop")
        )
        self.other_seats = self.parameter("other.seats", within(2, 50))
        self.other = self.cast("other", Bus1(seats=self.other_seats, carries="people", line=12))
        self.walker = self.cast("walker", Person())
        self.spot = self.argument("spot", Position3d(x=1 * m, y=2 * m, z=0 * m))
        self.large = Event()
        self.ego_quick = Event(rise(lambda: self.ego.speed > 20 * mps), name="ego.quick")
        # Speed at which it was last seen to be quick.
        self.ego_quick_at = self.sample(
            lambda: self.ego.speed, self.ego_quick, 0 * mps, name="ego.quick_at"
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_drive_serial(),
            On(
                self.ego_quick,
                Emit(self.large),
            ),
        )

    def _ego_drive_serial(self) -> Behaviour:
        return Serial(
            "do serial",
            Wait(lambda: self.other.is_larger(self.ego) or self.walker.owner == "nobody"),
            self.ego.drive(speed(25 * mps), duration=5 * s),
            Wait(
                lambda: self.ego_quick_at < 20 * mps
                and not self.world.is_festive
                and self.spot.note == ""
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ExtendedLibrary().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ExtendedLibrary))
