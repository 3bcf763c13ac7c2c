"""Scenario `parameters`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Vehicle,
    main,
    require_api,
    within,
)
from osc2tx_runtime.modifiers import lane, speed
from osc2tx_runtime.units import kph, m, s

require_api(1)


class Parameters(Scenario):
    name = "parameters"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast(
            "ego",
            Vehicle(
                # a long one
                vehicle_category="truck",
                length=12 * m,
            ),
        )
        # constant
        self.fixed = 50 * kph
        # default, may be set
        self.cruise = self.parameter("cruise", 60 * kph, unit="kph")
        # drawn from the seed
        self.slow = self.parameter("slow", within(20 * kph, 30 * kph), unit="kph")
        # the range replaces the default
        self.gap = self.parameter("gap", within(5 * m, 15 * m), unit="m")
        self.lanes = self.parameter("lanes", 2)
        self.limit = self.cruise + 2 * self.slow

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(self.lanes), speed(self.limit))

    def behavior(self) -> Behaviour:
        return self.ego.drive(speed(self.limit), duration=2 * s)


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Parameters().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Parameters))
