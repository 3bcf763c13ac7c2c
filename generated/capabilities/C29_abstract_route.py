"""Scenario `abstract_route`.

C29 Abstract route: the map finds a lane section of three lanes; the car starts on it, where its s
says.

Made by osc2tx from capabilities/C29_abstract_route.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    LaneSection,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import along, number_of_lanes, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class AbstractRoute(Scenario):
    name = "abstract_route"
    source = "capabilities/C29_abstract_route.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.way = self.argument("way", LaneSection())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.require(
            self.road, number_of_lanes(route=self.way, num_of_lanes=3, lane_type="driving")
        )
        self.place(self.ego, along(self.way, start_offset=200 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(15 * mps), duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AbstractRoute().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AbstractRoute))
