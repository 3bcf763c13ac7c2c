"""Scenario `conversions`.

C29 Conversions: points of the road to points of the world and back, and what is inside and outside
of a road.

Made by osc2tx from capabilities/C29_conversions.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
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


class Conversions(Scenario):
    name = "conversions"
    source = "capabilities/C29_conversions.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.later = Event()
        self.s_of_point = self.sample(
            lambda: self.road.xyz_to_route_point(x=300 * m, y=-5 * m, z=0 * m).s, self.later, 0 * m
        )
        self.t_of_point = self.sample(
            lambda: self.road.xyz_to_route_point(x=300 * m, y=-5 * m, z=0 * m).t, self.later, 0 * m
        )
        self.x_of_place = self.sample(
            lambda: self.road.route_point_to_xyz(
                route_point=self.road.odr_to_route_point(
                    road_id="1", lane_id="-2", s=400 * m, t=0 * m
                )
            ).position.x,
            self.later,
            0 * m,
        )
        self.y_of_place = self.sample(
            lambda: self.road.route_point_to_xyz(
                route_point=self.road.odr_to_route_point(
                    road_id="1", lane_id="-2", s=400 * m, t=0 * m
                )
            ).position.y,
            self.later,
            0 * m,
        )
        self.way = self.sample(
            lambda: self.ego.distance_to_route_point(
                point=self.road.odr_to_route_point(road_id="1", lane_id="-2", s=400 * m, t=0 * m),
                direction="longitudinal",
            ),
            self.later,
            0 * m,
        )
        self.is_right = self.sample(lambda: self.road.outer_side() == "right", self.later, False)
        self.is_left = self.sample(lambda: self.road.inner_side() == "left", self.later, False)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(10 * mps), duration=1 * s),
            Emit(self.later),
            self.ego.drive(duration=1 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Conversions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Conversions))
