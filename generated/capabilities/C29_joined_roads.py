"""Scenario `joined_roads`.

C29 Joined roads: the map finds the motorway after a ramp, the lane of the motorway that ends, the
part of it before that, and its right lane from end to end.

Made by osc2tx from capabilities/C29_joined_roads.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    CompoundLane,
    Event,
    Lane,
    LaneSection,
    Map,
    Road,
    Scenario,
    Serial,
    Vehicle,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import (
    along,
    compound_lane_side,
    end_lane,
    routes_are_in_sequence,
    routes_overlap,
    speed,
    start_lane,
)
from osc2tx_runtime.units import m, mps, s

require_api(1)


class JoinedRoads(Scenario):
    name = "joined_roads"
    source = "capabilities/C29_joined_roads.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="merge.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.ramp = self.argument("ramp", Road(anchors=["ramp"]))

        self.motorway = self.argument("motorway", Road())

        self.on_ramp = self.argument("on_ramp", Lane())

        self.joining = self.argument("joining", Lane())

        self.joined = self.argument("joined", LaneSection())

        self.left_way = self.argument("left_way", CompoundLane())

        self.right_way = self.argument("right_way", CompoundLane())

        self.away = Event(elapsed(1 * s))
        self.motorway_length = self.sample(lambda: self.motorway.length, self.away, 0 * m)
        self.lane_length = self.sample(lambda: self.joining.length, self.away, 0 * m)
        self.way_length = self.sample(lambda: self.right_way.length, self.away, 0 * m)
        self.lanes_joined = self.sample(lambda: self.joined.max_lanes, self.away, 0)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.require(
            self.road, routes_are_in_sequence(preceding=self.ramp, succeeding=self.motorway)
        )
        self.require(self.road, start_lane(self.on_ramp))
        self.require(
            self.road, routes_overlap(route1=self.ramp, route2=self.on_ramp, overlap_kind="equal")
        )
        self.require(self.road, end_lane(self.joining))
        self.require(
            self.road,
            routes_overlap(route1=self.motorway, route2=self.joined, overlap_kind="start"),
        )
        self.require(
            self.road,
            compound_lane_side(
                lane1=self.right_way, side="right", lane2=self.left_way, route=self.motorway
            ),
        )
        self.place(self.ego, along(self.on_ramp, start_offset=20 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(15 * mps), duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return JoinedRoads().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(JoinedRoads))
