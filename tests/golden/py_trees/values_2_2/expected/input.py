"""Scenario `values`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.2, dialect asam.
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
    within,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, s

require_api(1)


class Values(Scenario):
    name = "values"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.cruise = self.argument("cruise", within(20 * kph, 40 * kph))
        self.exact = self.argument("exact", within(30 * kph, 30 * kph))
        self.steps = self.argument("steps", [within(1.0, 2.0), within(2.0, 3.0)])
        self.text = self.parameter("text", "fast,faster")
        self.words = self.argument("words", self.text.split(","))
        self.joined = self.parameter("joined", "-".join(self.words))
        self.factor = self.parameter("factor", 1.5)

        self.keep(self.exact in self.cruise and self.steps[1].low == 2.0)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.cruise.low), throughout=True)

    def float_doubled(self, value: float) -> float:
        return value * 2.0

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(self.cruise.low), duration=1 * s),
            Wait(lambda: self.ego.speed in self.cruise and self.float_doubled(self.factor) == 3.0),
            Wait(
                lambda: self.joined == "fast-faster"
                and "fast" in self.text
                and len(self.text) == 11
            ),
            Wait(
                lambda: self.text[0:4] == "fast"
                and self.text.replace("a", "e").strip() == "fest,fester"
            ),
            self.ego.drive(speed(speed_range=within(30 * kph, 30 * kph)), duration=1 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Values().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Values))
