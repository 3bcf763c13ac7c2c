"""Scenario `own_types`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass
from typing import Unpack

from osc2tx_runtime import (
    Behaviour,
    Map,
    Person,
    Point,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    main,
    not_given,
    require_api,
)
from osc2tx_runtime.fields import VehicleFields
from osc2tx_runtime.modifiers import position, speed
from osc2tx_runtime.units import Length, Speed, Time, m, mps, s

require_api(1)


@dataclass(frozen=True, kw_only=True, eq=False)
class DrivingStyle:
    """Struct `driving_style`.

    How a test car is driven.
    """

    v: Speed = 10 * mps
    # To whoever is in front
    gap: Length
    remarks: list[str] = not_given


@dataclass(frozen=True, kw_only=True, eq=False)
class CalmStyle(DrivingStyle):
    """Struct `calm_style`."""

    patience: Time = 5 * s


@dataclass(frozen=True, kw_only=True, eq=False)
class Waypoint(Point):
    """Struct `waypoint`."""

    title: str = "nowhere"


class TestCar(Vehicle):
    """Actor `test_car`."""

    kinds = ("test_car", *Vehicle.kinds)

    def __init__(self, *, seats: int = 5, number: int, **fields: Unpack[VehicleFields]) -> None:
        super().__init__(**fields)
        self.seats = seats
        # Painted on the door
        self.number = number


class LongCar(TestCar):
    """Actor `long_car`."""

    kinds = ("long_car", *TestCar.kinds)

    class Inherited(VehicleFields, total=False):
        """Keywords of the bases."""

        seats: int
        number: int

    def __init__(self, *, doors: int, **fields: Unpack[Inherited]) -> None:
        super().__init__(**fields)
        # keep(it == 3)
        self.doors = doors


class Child(Person):
    """Actor `child`."""

    kinds = ("child", *Person.kinds)


class OwnTypes(Scenario):
    name = "own_types"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.style = self.argument("style", CalmStyle(gap=12 * m))
        self.start = self.argument("start", Waypoint(x=100 * m, y=-8.75 * m, title="lane 2"))
        self.ego = self.cast("ego", TestCar(number=7, vehicle_category="truck"))
        self.coach = self.cast(
            "coach", LongCar(vehicle_category="bus", doors=3, number=self.ego.number + 1)
        )
        self.kid = self.cast("kid", Child())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, position(at_point=self.start), speed(self.style.v), throughout=True)

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.assign_position(position(at_point=self.start), speed(self.style.v)),
            self.ego.drive(speed(self.coach.number * (1 * mps)), duration=self.style.patience),
            Wait(lambda: self.ego.number > self.ego.seats or self.start.title == "nowhere"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OwnTypes().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OwnTypes))
