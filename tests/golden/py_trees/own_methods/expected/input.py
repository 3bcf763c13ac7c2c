"""Scenario `own_methods`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass
from typing import Unpack

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    main,
    require_api,
)
from osc2tx_runtime.fields import VehicleFields
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Speed, kph, s

require_api(1)


class Coach(Vehicle):
    """Actor `coach`."""

    kinds = ("coach", *Vehicle.kinds)

    def __init__(self, *, seats: int = 30, **fields: Unpack[VehicleFields]) -> None:
        super().__init__(**fields)
        self.seats = seats

    def is_full(self, guests: int) -> bool:
        return guests >= self.seats


class DoubleDecker(Coach):
    """Actor `double_decker`."""

    kinds = ("double_decker", *Coach.kinds)

    def is_full(self, guests: int) -> bool:
        return guests >= 2 * self.seats


@dataclass(frozen=True, kw_only=True, eq=False)
class Limits:
    """Struct `limits`."""

    low: Speed
    high: Speed = 50 * kph

    # keep(low < high)

    def middle(self) -> Speed:
        return (self.low + self.high) / 2.0


class OwnMethods(Scenario):
    name = "own_methods"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Coach())
        self.other = self.cast("other", DoubleDecker(seats=40))
        self.range_of_speed = self.argument("range_of_speed", Limits(low=10 * kph))
        self.base = self.parameter("base", 10 * kph, unit="kph")
        # A value may need a method whose body needs a later value.
        self.cruise = self.parameter("cruise", self.scaled(2.0), unit="mps")

        self.keep(self.range_of_speed.low < self.range_of_speed.high)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.range_of_speed.middle()), throughout=True)

    def scaled(self, factor: float) -> Speed:
        return self.base * factor

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(self.range_of_speed.middle()), duration=1 * s),
            self.ego.drive(speed(self.cruise, at="end"), duration=1 * s),
            Wait(lambda: self.ego.is_full(40) and not self.other.is_full(40)),
            Wait(lambda: self.other.seats == 40 and self.ego.speed > 1 * kph),
            Wait(
                lambda: isinstance(self.ego, DoubleDecker)
                or self.ego.speed < self.range_of_speed.high
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OwnMethods().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OwnMethods))
