"""Scenario `route_values`.

C29 Route values: fields of the chosen roads of the map, and a route composed of two of them.

Made by osc2tx from capabilities/C29_route_values.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Junction,
    Map,
    Road,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import along, roads_follow_in_junction, speed
from osc2tx_runtime.units import m, mps

require_api(1)


class RouteValues(Scenario):
    name = "route_values"
    source = "capabilities/C29_route_values.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="urban_crossing.xodr"))
        self.ego = self.cast("ego", Vehicle())

        # from the east to the south
        self.arm = self.argument("arm", Road(anchors=["east"]))

        self.onward = self.argument("onward", Road())
        self.middle = self.argument("middle", Junction())
        self.way = self.argument("way", self.road.create_route([self.arm, self.onward]))

        self.away = Event(rise(lambda: self.ego.pose.position.x <= 120 * m))
        self.arm_length = self.sample(lambda: self.arm.length, self.away, 0 * m)
        self.way_length = self.sample(lambda: self.way.length, self.away, 0 * m)
        self.covered = self.sample(
            lambda: self.ego.distance_along_route(self.way), self.away, 0 * m
        )
        self.end_of_arm = self.sample(lambda: self.arm.end_point().s, self.away, 0 * m)
        self.lanes_of_arm = self.sample(lambda: self.arm.max_lanes, self.away, 0)
        self.lanes_in = self.sample(lambda: len(self.arm.s_positive[0].lanes), self.away, 0)
        self.lane_width = self.sample(
            lambda: self.arm.s_positive[0].lanes[1].width, self.away, 0 * m
        )
        self.is_split = self.sample(lambda: self.arm.directionality == "split", self.away, False)
        self.is_normal = self.sample(
            lambda: self.arm.s_negative[0].s_axis.lane_use == "normal", self.away, False
        )
        self.arms = self.sample(lambda: len(self.middle.roads), self.away, 0)
        self.roads = self.sample(lambda: len(self.road.routes), self.away, 0)
        self.junctions = self.sample(lambda: len(self.road.junctions), self.away, 0)
        self.groups = self.sample(lambda: len(self.road.traffic_light_groups), self.away, 0)
        self.elements = self.sample(lambda: len(self.way.route_elements), self.away, 0)
        self.is_this_map = self.sample(
            lambda: self.road.map_file == "urban_crossing.xodr", self.away, False
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.require(
            self.road,
            roads_follow_in_junction(
                junction=self.middle, in_road=self.arm, out_road=self.onward, direction="left"
            ),
        )
        self.place(
            self.ego,
            along(self.way, start_offset=20 * m, end_offset=20 * m),
            speed(10 * mps),
            throughout=True,
        )

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(
                along(self.way, start_offset=20 * m, end_offset=20 * m), speed(10 * mps)
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RouteValues().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RouteValues))
