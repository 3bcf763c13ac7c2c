"""Scenario `conflict_reported`.

C34 Conflict reported: two branches want the speed of one car at the same time, and nothing says
who goes first. The run ends with an error that names both.

Made by osc2tx from capabilities/C34_conflict_reported.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class ConflictReported(Scenario):
    name = "conflict_reported"
    source = "capabilities/C34_conflict_reported.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(20 * mps)),
            self._ego_change_speed_serial(),
        )

    def _ego_change_speed_serial(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Wait(elapsed(2 * s)),
            self.ego.change_speed(target=10 * mps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ConflictReported().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ConflictReported))
