"""Scenario `coverage`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Scenario,
    Vehicle,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, m, s

require_api(1)


class Coverage(Scenario):
    name = "coverage"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.npc = self.cast("npc", Vehicle())
        self.fast = Event(rise(lambda: self.ego.speed > 50 * kph))
        self.gear = self.parameter("gear", 2)
        self.target = self.parameter("target", 60 * kph, unit="kph")

        # an item of a field: `it` is the field
        self.cover("target", lambda: self.target, unit="kph", within=(40, 80), every=10)

        # How fast it is when it is fast, in slices of the unit
        self.cover(
            "speed_then", lambda: self.ego.speed, unit="kph", buckets=(0, 40, 55, 80), at=self.fast
        )

        # One hit is enough; what lies below the range is no hit
        self.cover(
            "gap",
            lambda: self.npc.object_distance(reference=self.ego, direction="euclidean"),
            unit="m",
            within=(0, 500),
            every=50,
            ignore=lambda it: it < 1 * m,
            target=1,
            text="distance at the end",
        )
        self.record("gear", lambda: self.gear, at="start")
        self.record("odd", lambda: self.gear % 2 == 1, illegal=lambda it: it)
        self.cover("both", items=("gap", "target"))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(10 * kph))

    def behavior(self) -> Behaviour:
        return self.ego.drive(speed(self.target, at="end"), duration=3 * s)


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Coverage().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Coverage))
