"""Scenario `expressions`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

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
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, m, mps, s

require_api(1)


class Expressions(Scenario):
    name = "expressions"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())
        self.a = self.parameter("a", 2.5)
        self.b = self.parameter("b", 7)
        self.v = self.parameter("v", 36 * kph, unit="kph")
        self.half = (self.a + 1) / 2 - -self.a
        self.whole = self.b // 2 + self.b % 3
        self.mean = (self.v + 10 * mps) / 2
        self.long = self.v * (3 * s) + 10 * m
        self.choice = self.v if self.b > 5 and not self.a < 1.0 else 2 * self.v

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            Wait(
                lambda: self.ego.speed > self.v + 5 * kph
                or (not self.other.speed < self.v or self.ego.speed == self.other.speed)
            ),
            self.ego.drive(speed(lambda: self.other.speed + 5 * kph), duration=2 * (1 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Expressions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Expressions))
