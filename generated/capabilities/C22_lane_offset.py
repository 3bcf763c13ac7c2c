"""Scenario `lane_offset`.

C22 Lane offset: a car drives left of the middle of its lane, then takes another lane with a peak
of its lateral speed.

Made by osc2tx from capabilities/C22_lane_offset.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import lane, lateral, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class LaneOffset(Scenario):
    name = "lane_offset"
    source = "capabilities/C22_lane_offset.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(15 * mps), lateral(distance=0.4 * m))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.follow_lane("aside", offset=0.4 * m, duration=5 * s),
            self.ego.change_lane(
                "across", num_of_lanes=1, side="right", rate_profile="constant", rate_peak=1 * mps
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return LaneOffset().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(LaneOffset))
