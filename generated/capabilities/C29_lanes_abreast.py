"""Scenario `lanes_abreast`.

C29 Lanes abreast: the map finds two lanes side by side and one of the other carriageway; cars start
on them, where their s says.

Made by osc2tx from capabilities/C29_lanes_abreast.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Lane,
    Map,
    Parallel,
    Scenario,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import along, lane_side, routes_are_opposite, set_map_file, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class LanesAbreast(Scenario):
    name = "lanes_abreast"
    source = "capabilities/C29_lanes_abreast.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map())
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())
        self.oncoming = self.cast("oncoming", Vehicle())

        self.inner = self.argument("inner", Lane())

        self.outer = self.argument("outer", Lane())

        self.opposite = self.argument("opposite", Lane())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.require(self.road, set_map_file("highway.xodr"))
        self.require(self.road, lane_side(lane1=self.inner, side="left", lane2=self.outer, count=2))
        self.require(self.road, routes_are_opposite(route1=self.outer, route2=self.opposite))
        self.place(self.ego, along(self.outer, start_offset=200 * m), speed(15 * mps))
        self.place(self.other, along(self.inner, start_offset=200 * m), speed(15 * mps))
        self.place(self.oncoming, along(self.opposite, start_offset=200 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(15 * mps)),
            self.other.drive(speed(15 * mps)),
            self.oncoming.drive(speed(15 * mps)),
            duration=3 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return LanesAbreast().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(LanesAbreast))
