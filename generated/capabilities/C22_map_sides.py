"""Scenario `map_sides`.

C22 Inner and outer side: the car goes to the side away from oncoming traffic, wherever one drives.

Made by osc2tx from capabilities/C22_map_sides.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class MapSides(Scenario):
    name = "map_sides"
    source = "capabilities/C22_map_sides.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="left_hand.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1, from_="right"), position(10 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(10 * mps), duration=1 * s),
            self.ego.change_lane("outwards", num_of_lanes=1, side="outside", duration=3 * s),
            self.ego.change_lane("inwards", num_of_lanes=1, side="inside", duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return MapSides().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(MapSides))
