"""Scenario `acceleration_modifier`.

C20 Acceleration modifier: a drive with a constant acceleration, then one with a deceleration that
ends at standstill.

Made by osc2tx from capabilities/C20_acceleration_modifier.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import acceleration, lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class AccelerationModifier(Scenario):
    name = "acceleration_modifier"
    source = "capabilities/C20_acceleration_modifier.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(8 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(8 * mps), duration=1 * s),
            self.ego.drive("gain", acceleration(1.25 * mpss), duration=4 * s),
            self.ego.drive("lose", acceleration(-2 * mpss), duration=8 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AccelerationModifier().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AccelerationModifier))
