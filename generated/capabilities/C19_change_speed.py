"""Scenario `relative_speed`.

C19 Speed changes: a speed relative to the present one, then the present speed itself.

Made by osc2tx from capabilities/C19_change_speed.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import change_speed, keep_speed, lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class RelativeSpeed(Scenario):
    name = "relative_speed"
    source = "capabilities/C19_change_speed.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(12 * mps), duration=1 * s),
            self.ego.drive("gain", change_speed(4 * mps), duration=5 * s),
            self.ego.drive("hold", keep_speed(), duration=2 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RelativeSpeed().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RelativeSpeed))
