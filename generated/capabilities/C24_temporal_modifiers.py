"""Scenario `temporal_modifiers`.

C24 Temporal modifiers: a delay before, a limit during, and an end in time that the phase is
planned for: the target speed is there when the time is over.

Made by osc2tx from capabilities/C24_temporal_modifiers.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class TemporalModifiers(Scenario):
    name = "temporal_modifiers"
    source = "capabilities/C24_temporal_modifiers.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.delay = self.parameter("delay", 1.5 * s, unit="s")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(10 * mps), duration=1 * s),
            Wait("pause", elapsed(self.delay)),
            Until(
                self.ego.drive("limited", speed(12 * mps)),
                elapsed(2 * s),
            ),
            self.ego.drive("planned", speed(18 * mps, at="end"), duration=4 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return TemporalModifiers().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(TemporalModifiers))
