"""Scenario `stationary`.

C08 Stationary: one car stays in its position; the other one brakes to standstill first.

Made by osc2tx from capabilities/C08_stationary.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class Stationary(Scenario):
    name = "stationary"
    source = "capabilities/C08_stationary.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.parked = self.cast("parked", Vehicle())
        self.arriving = self.cast("arriving", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.parked, lane(1), position(100 * m), speed(0 * mps))
        self.place(self.arriving, lane(2), position(50 * m), speed(16 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.parked.remain_stationary(),
            self._arriving_drive_then_hold(),
        )

    def _arriving_drive_then_hold(self) -> Behaviour:
        return Serial(
            "arriving: serial",
            self.arriving.drive(speed(16 * mps), duration=2 * s),
            self.arriving.remain_stationary("hold", duration=6 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Stationary().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Stationary))
