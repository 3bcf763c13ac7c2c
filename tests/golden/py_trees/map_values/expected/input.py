"""Scenario `map_values`.

What a map fills in, and what is read of it.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Crossing,
    CrossingType,
    Event,
    GeodeticPoint,
    Lane,
    LaneSection,
    Map,
    Parallel,
    Person,
    Scenario,
    TrafficLight,
    TrafficLightController,
    TrafficLightCycle,
    TrafficLightGroup,
    TrafficLightPhase,
    TrafficLightStopLine,
    Vehicle,
    at_least,
    main,
    require_api,
    rise,
    within,
)
from osc2tx_runtime.modifiers import along, crossing_connects, speed
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class MapValues(Scenario):
    name = "map_values"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.red = self.argument(
            "red",
            TrafficLightPhase(
                group=TrafficLightGroup(map_id="1"),
                bulbs_state=["is_on", "is_off", "is_off"],
                duration=5 * s,
            ),
        )
        self.cycle = self.argument("cycle", TrafficLightCycle(phases=[self.red]))
        self.road = self.cast(
            "road", Map(map_file="urban_crossing.xodr", traffic_light_control=[self.cycle])
        )
        self.ego = self.cast("ego", Vehicle())
        self.walker = self.cast("walker", Person())
        self.lights = self.cast("lights", TrafficLightController())

        # bounds are for the map to fill in
        self.section = self.argument(
            "section",
            LaneSection(
                length=at_least(100 * m),
                min_lanes=at_least(2),
                max_lanes=within(2, 4),
                directionality="uni_direction",
            ),
        )
        self.first = self.argument(
            "first", Lane(lane_section=self.section, lane_use="normal", width=within(3 * m, 4 * m))
        )
        self.near_side = self.argument("near_side", Lane(lane_type="pedestrian"))
        self.far_side = self.argument("far_side", Lane(lane_type="pedestrian"))

        self.over = self.argument("over", Crossing(width=3 * m))
        self.striped = self.argument(
            "striped", Crossing(crossing_type=CrossingType(marking="zebra", use="pedestrian"))
        )

        # a route made of all sorts of things
        self.place_ = self.argument(
            "place", GeodeticPoint(latitude=1 * deg, longitude=2 * deg, altitude=3 * m)
        )
        self.way = self.argument(
            "way", self.road.create_route([self.near_side, self.over, self.far_side])
        )
        self.to_place = self.argument(
            "to_place", self.road.create_route([self.first, self.place_], connect_points_by="lane")
        )

        self.light = self.argument("light", TrafficLight(map_id="101"))
        self.line = self.argument(
            "line",
            TrafficLightStopLine(
                traffic_light_group=self.light.group,
                route=self.section,
                rightmost_lane=1,
                offset=100 * m,
                primary_stop_line_marking="solid",
            ),
        )

        self.stopped = Event(rise(lambda: self.light.bulbs[0].state == "is_on"))
        self.at_end = Event(
            rise(lambda: self.ego.distance_along_route(self.section) > self.section.length - 10 * m)
        )
        self.begins_at = self.sample(lambda: self.first.start_point().s, self.stopped, 0 * m)
        self.ends_at = self.sample(lambda: self.section.lanes[0].end_point().s, self.stopped, 0 * m)
        self.width = self.sample(lambda: self.over.width, self.stopped, 0 * m)
        self.is_zebra = self.sample(
            lambda: self.striped.crossing_type.marking == "zebra", self.stopped, False
        )
        self.roads = self.sample(
            lambda: sum(it.length > 100 * m for it in self.road.junctions[0].roads), self.stopped, 0
        )
        self.elements = self.sample(lambda: len(self.to_place.route_elements), self.stopped, 0)
        self.has_lights = self.sample(
            lambda: len(self.road.traffic_light_groups) > 0, self.stopped, False
        )
        self.drawn = self.sample(
            lambda: self.line.primary_stop_line_marking == "solid", self.stopped, False
        )
        self.above = self.sample(
            lambda: self.light.pose.position.z + self.light.height, self.stopped, 0 * m
        )
        self.phases = self.sample(lambda: len(self.light.group.cycle.phases), self.stopped, 0)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.require(
            self.road,
            crossing_connects(
                self.over,
                start_lane=self.near_side,
                end_lane=self.far_side,
                start_s_coord=5 * m,
                start_angle=80 * deg,
            ),
        )
        self.place(self.walker, along(self.way), speed(1.5 * mps), throughout=True)
        self.place(
            self.ego,
            along(self.section, start_offset=lambda: self.section.length - 80 * m),
            speed(10 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.walker.walk(along(self.way), speed(1.5 * mps)),
            self.ego.drive(
                along(self.section, end_offset=lambda: self.over.length), speed(10 * mps)
            ),
            self.lights.play_cycles(cycles=self.road.traffic_light_control),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return MapValues().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(MapValues))
