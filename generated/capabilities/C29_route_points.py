"""Scenario `route_points`.

C29 Points of a route: how far it is along the road to a point given by s and t, and the way back
from points to coordinates.

Made by osc2tx from capabilities/C29_route_points.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Scenario,
    Serial,
    Until,
    Vehicle,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class RoutePoints(Scenario):
    name = "route_points"
    source = "capabilities/C29_route_points.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.half_way = Event(
            rise(
                lambda: self.ego.distance_to_odr_point(
                    point=self.road.create_odr_point(road_id="1", lane_id="-3", s=250 * m, t=0 * m),
                    direction="longitudinal",
                )
                <= 100 * m
            )
        )
        self.s_there = self.sample(lambda: self.ego.get_route_point().s, self.half_way, 0 * m)
        self.t_there = self.sample(lambda: self.ego.get_route_point().t, self.half_way, 0 * m)
        self.across = self.sample(
            lambda: self.ego.distance_to_odr_point(
                point=self.road.create_odr_point(road_id="1", lane_id="-1", s=250 * m, t=0 * m),
                direction="lateral",
            ),
            self.half_way,
            0 * m,
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(16 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            Until(
                self.ego.drive(speed(16 * mps)),
                self.half_way,
            ),
            self.ego.drive(duration=1 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RoutePoints().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RoutePoints))
