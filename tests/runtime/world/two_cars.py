"""The small scenario most tests of actions are about."""

from __future__ import annotations

from collections.abc import Callable

from osc2tx_runtime import Behaviour, Environment, Map, Road, Scenario, Vehicle
from osc2tx_runtime.modifiers import lane, position, speed


class TwoCars(Scenario):
    """Car `a` at 50 m in lane 2 with 10 m/s, car `b` 40 m ahead of it with 12 m/s."""

    name = "two_cars"
    source = "two_cars.osc"

    def declare(self) -> None:
        self.road = Map(map_file="highway")
        self.sky = Environment()
        self.street = self.argument("street", Road())
        self.a = Vehicle()
        self.b = Vehicle()

    def placement(self) -> None:
        self.place(self.a, lane(2), position(distance=50.0), speed(10.0))
        self.place(
            self.b, lane(same_as=self.a), position(distance=40.0, ahead_of=self.a), speed(12.0)
        )


def scenario(body: Callable[[TwoCars], Behaviour]) -> type[Scenario]:
    """The scenario with a behaviour of its own."""

    class Made(TwoCars):
        def behavior(self) -> Behaviour:
            return body(self)

    return Made
