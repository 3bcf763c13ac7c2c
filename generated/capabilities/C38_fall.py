"""Scenario `falling_edge`.

C38 fall: true in the instant in which the condition turns from true to false.

Made by osc2tx from capabilities/C38_fall.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    fall,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class FallingEdge(Scenario):
    name = "falling_edge"
    source = "capabilities/C38_fall.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.slow = self.cast("slow", Vehicle())

        self.caught_up = Event(
            fall(lambda: self.slow.space_gap(reference=self.ego, direction="longitudinal") > 10 * m)
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.slow, lane(1), position(100 * m), speed(10 * mps))
        self.place(self.ego, lane(1), position(50 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.slow.drive(speed(10 * mps)),
            self._ego_drive_then_evade(),
        )

    def _ego_drive_then_evade(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive(speed(15 * mps)),
                self.caught_up,
            ),
            self.ego.change_lane("evade", side="left", duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return FallingEdge().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(FallingEdge))
