"""Scenario `crossing_the_street`.

C29 Crossing: a person walks along a sidewalk, over the zebra crossing of the map and on along the
other sidewalk; another one takes a crossing of its own, which leads over the street at an angle.

Made by osc2tx from capabilities/C29_crossing.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Crossing,
    CrossingType,
    Event,
    Lane,
    Map,
    Parallel,
    Person,
    RoutePoint,
    Scenario,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import along, crossing_connects, speed
from osc2tx_runtime.units import deg, m, mps

require_api(1)


class CrossingTheStreet(Scenario):
    name = "crossing_the_street"
    source = "capabilities/C29_crossing.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="crossing.xodr"))
        self.walker = self.cast("walker", Person())
        self.other = self.cast("other", Person())

        self.near_side = self.argument("near_side", Lane(lane_type="pedestrian"))

        self.far_side = self.argument("far_side", Lane(lane_type="pedestrian"))

        # where the map has a crosswalk
        self.zebra = self.argument("zebra", Crossing(crossing_type=CrossingType(marking="zebra")))

        # where the scenario says
        self.shortcut = self.argument("shortcut", Crossing(width=2 * m))

        # 20 m before the zebra crossing, and 10 m behind it on the other side
        self.begin = self.argument("begin", RoutePoint(route=self.near_side, s=230 * m, t=0 * m))
        self.goal = self.argument("goal", RoutePoint(route=self.far_side, s=260 * m, t=0 * m))
        self.way = self.argument("way", self.road.create_route([self.begin, self.zebra, self.goal]))

        self.on_zebra = Event(rise(lambda: self.walker.pose.position.y > 0 * m))
        self.width = self.sample(lambda: self.zebra.width, self.on_zebra, 0 * m)
        self.starts_at = self.sample(lambda: self.zebra.start_s_coord, self.on_zebra, 0 * m)
        self.ends_at = self.sample(lambda: self.zebra.end_s_coord, self.on_zebra, 0 * m)
        self.zebra_length = self.sample(lambda: self.zebra.length, self.on_zebra, 0 * m)
        self.half_way = self.sample(
            lambda: self.walker.distance_along_route(self.zebra), self.on_zebra, 0 * m
        )
        self.is_for_walkers = self.sample(
            lambda: self.zebra.crossing_type.use == "pedestrian", self.on_zebra, False
        )
        self.shortcut_length = self.sample(lambda: self.shortcut.length, self.on_zebra, 0 * m)
        self.shortcut_ends_at = self.sample(lambda: self.shortcut.end_s_coord, self.on_zebra, 0 * m)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.require(
            self.road,
            crossing_connects(self.zebra, start_lane=self.near_side, end_lane=self.far_side),
        )
        self.require(
            self.road,
            crossing_connects(
                self.shortcut,
                start_lane=self.near_side,
                end_lane=self.far_side,
                start_s_coord=100 * m,
                start_angle=60 * deg,
            ),
        )
        self.place(self.walker, along(self.way), speed(1.5 * mps), throughout=True)
        self.place(self.other, along(self.shortcut), speed(1 * mps), throughout=True)

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.walker.walk(along(self.way), speed(1.5 * mps)),
            self.other.walk(along(self.shortcut), speed(1 * mps)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return CrossingTheStreet().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(CrossingTheStreet))
