"""Scenario `position_modifier`.

C21 Position modifier: where a phase starts (along the road, ahead of and behind another car, in
metres and in seconds) and where it ends.

Made by osc2tx from capabilities/C21_position_modifier.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class PositionModifier(Scenario):
    name = "position_modifier"
    source = "capabilities/C21_position_modifier.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.front = self.cast("front", Vehicle())
        self.rear = self.cast("rear", Vehicle())
        self.late = self.cast("late", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(200 * m), speed(15 * mps))
        self.place(
            self.front, lane(same_as=self.ego), position(30 * m, ahead_of=self.ego), speed(15 * mps)
        )
        self.place(
            self.late,
            lane(side_of=self.ego, side="left"),
            position(time=2 * s, behind=self.ego),
            speed(15 * mps),
        )
        self.place(
            self.rear,
            lane(side_of=self.ego, side="right"),
            position(20 * m, behind=self.ego),
            speed(15 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(15 * mps)),
            self.front.drive(speed(15 * mps)),
            # Counts at the speed of the one behind: 2 s at 15 m/s
            self.late.drive(speed(15 * mps)),
            # Starts behind and is ahead at the end
            self.rear.drive(position(10 * m, ahead_of=self.ego, at="end"), duration=6 * s),
            duration=6 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PositionModifier().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PositionModifier))
