"""Scenario `lateral_modifiers`.

C22 Lateral modifiers: an offset in the lane, a number of lanes to the side, the lane of another
car, a distance to its side.

Made by osc2tx from capabilities/C22_lateral_modifier.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import change_lane, keep_lane, lane, lateral, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class LateralModifiers(Scenario):
    name = "lateral_modifiers"
    source = "capabilities/C22_lateral_modifier.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.shifted = self.cast("shifted", Vehicle())
        self.changing = self.cast("changing", Vehicle())
        self.joining = self.cast("joining", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(200 * m), speed(15 * mps))
        self.place(
            self.shifted,
            lane(1),
            position(50 * m, behind=self.ego),
            speed(15 * mps),
            lateral(0.6 * m),
        )
        self.place(self.changing, lane(4), position(200 * m, ahead_of=self.ego), speed(15 * mps))
        self.place(self.joining, lane(3), position(60 * m, ahead_of=self.ego), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(15 * mps), keep_lane()),
            self.shifted.drive(speed(15 * mps), lateral(0.6 * m)),
            self.changing.drive(speed(15 * mps), change_lane(2, side="right")),
            self.joining.drive(speed(15 * mps), lane(same_as=self.ego)),
            duration=6 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return LateralModifiers().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(LateralModifiers))
