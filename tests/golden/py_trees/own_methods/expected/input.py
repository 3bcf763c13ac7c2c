"""Scenario `own_methods`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
"""

from dataclasses import dataclass
from typing import Any

from osc2tx_runtime import Behaviour, Map, Scenario, Serial, Vehicle, Wait, main, require_api
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, s

require_api(1)


class Coach(Vehicle):
    """Actor `coach`."""

    kinds = ("coach", *Vehicle.kinds)

    def __init__(self, *, seats: int, **fields: Any) -> None:
        super().__init__(**fields)
        self.seats = seats


class DoubleDecker(Coach):
    """Actor `double_decker`."""

    kinds = ("double_decker", *Coach.kinds)


@dataclass(frozen=True, kw_only=True, eq=False)
class Limits:
    """Struct `limits`."""

    low: float
    high: float = 50 * kph


class OwnMethods(Scenario):
    name = "own_methods"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = Map(map_file="highway.xodr")
        self.ego = Coach(seats=30)
        self.other = DoubleDecker(seats=40)
        self.range_of_speed = Limits(low=10 * kph)
        self.base = self.parameter("base", 10 * kph)

        # A value may need a method whose body needs a later value.
        self.cruise = self.parameter("cruise", self.scaled(2.0))

        self.keep(self.range_of_speed.low < self.range_of_speed.high)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.limits_middle(self.range_of_speed)))

    def scaled(self, factor: float) -> float:
        return self.base * factor

    def limits_middle(self, limits: Limits) -> float:
        return (limits.low + limits.high) / 2.0

    def coach_is_full(self, coach: Coach, guests: int) -> bool:
        return (
            self.double_decker_is_full(coach, guests)
            if isinstance(coach, DoubleDecker)
            else guests >= coach.seats
        )

    def double_decker_is_full(self, double_decker: DoubleDecker, guests: int) -> bool:
        return guests >= 2 * double_decker.seats

    def behavior(self) -> Behaviour:
        return Serial(
            "own_methods",
            self.ego.drive(speed(self.limits_middle(self.range_of_speed)), duration=1 * s),
            self.ego.drive(speed(self.cruise, at="end"), duration=1 * s),
            Wait(
                lambda: self.coach_is_full(self.ego, 40)
                and not self.double_decker_is_full(self.other, 40)
            ),
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
