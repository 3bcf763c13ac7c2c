"""Scenario `physical_movements`.

C23 Physical movement: the same command with physics and without. The one who must move by physics
takes its time, the one who need not is there at the next step.

Made by osc2tx from capabilities/C23_physical_movement.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, physical_movement, position, speed
from osc2tx_runtime.units import m, mps

require_api(1)


class PhysicalMovements(Scenario):
    name = "physical_movements"
    source = "capabilities/C23_physical_movement.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.bound = self.cast("bound", Vehicle())
        self.free = self.cast("free", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.bound, lane(2), position(50 * m), speed(10 * mps))
        self.place(self.free, lane(3), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.bound.change_speed(physical_movement("must_be_physical"), target=20 * mps),
            self.free.change_speed(physical_movement("prefer_non_physical"), target=20 * mps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PhysicalMovements().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PhysicalMovements))
