"""Scenarios `top`, `ride`.

Objects in objects: structs, actors and lists as fields, defaults that read others.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass
from typing import Unpack

from osc2tx_runtime import (
    Actor,
    Behaviour,
    Map,
    Person,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    any_of,
    main,
    require_api,
)
from osc2tx_runtime.fields import ActorFields, VehicleFields
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Speed, Time, mps, s

require_api(1)


class Company(Actor):
    """Actor `company`."""

    kinds = ("company", *Actor.kinds)

    def __init__(
        self, *, name_: str = "Example", cars: list[Vehicle], **fields: Unpack[ActorFields]
    ) -> None:
        super().__init__(**fields)
        self.name_ = name_
        self.cars = cars


@dataclass(frozen=True, kw_only=True, eq=False)
class Leg:
    """Struct `leg`."""

    pace: Speed = 10 * mps
    # twice as fast at most
    most: Speed
    # keep(it in [1s..2s])
    time_of: Time


@dataclass(frozen=True, kw_only=True, eq=False)
class Journey:
    """Struct `journey`."""

    first: Leg
    # keep(it.pace == 12mps)
    second: Leg
    stops: list[str]
    allowed: Speed
    is_late: bool = False

    def longest(self) -> Time:
        return self.first.time_of + self.second.time_of


class Cab(Vehicle):
    """Actor `cab`."""

    kinds = ("cab", *Vehicle.kinds)

    def __init__(
        self, *, trip: Journey, owner: Company, guest: Person, **fields: Unpack[VehicleFields]
    ) -> None:
        super().__init__(**fields)
        self.trip = trip
        self.owner = owner
        self.guest = guest

    def fare(self, km: float) -> float:
        return 2.5 * km


class Limousine(Cab):
    """Actor `limousine`."""

    kinds = ("limousine", *Cab.kinds)

    def fare(self, km: float) -> float:
        return 20.0 + 5.0 * km


class Top(Scenario):
    name = "top"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.limit = self.global_parameter("limit", 14 * mps, unit="mps")
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.other = self.cast("other", Vehicle())
        self.rentals = self.cast("rentals", Company(cars=[self.other]))
        self.rider = self.cast("rider", Person())
        self.ego = self.cast(
            "ego",
            Limousine(
                trip=Journey(
                    first=Leg(most=2 * (8 * mps), pace=8 * mps, time_of=1 * s),
                    second=Leg(most=2 * (12 * mps), pace=12 * mps, time_of=1.5 * s),
                    stops=["home", "work"],
                    allowed=self.limit,
                ),
                owner=self.rentals,
                guest=self.rider,
            ),
        )
        self.names_1 = self.parameter("names.1", any_of("second", "third"))
        self.names = self.argument("names", ["first", self.names_1])

        self.keep(self.names[0] == "first")
        self.keep(self.names[1] in ["second", "third"])

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.invoke(Ride, it_is=self.ego),
            self.ego.owner.cars[0].drive(speed(self.ego.trip.allowed), duration=1 * s),
            Wait(
                lambda: not self.ego.trip.is_late
                and len(self.names) == 2
                and self.ego.owner.name_ == "Example"
            ),
        )


class Ride(Scenario):
    name = "ride"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.it_is = self.required_argument("it_is", Cab)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.it_is, speed(self.it_is.trip.first.most), throughout=True)

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.it_is.drive(
                speed(self.it_is.trip.first.most), duration=self.it_is.trip.first.time_of
            ),
            self.it_is.drive(
                speed(self.it_is.trip.second.pace),
                duration=self.it_is.trip.longest() - self.it_is.trip.first.time_of,
            ),
            Wait(lambda: self.it_is.fare(2.0) == 30.0),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Top().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Top, Ride))
