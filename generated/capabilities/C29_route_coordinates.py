"""Scenario `route_coordinates`.

C29 Route coordinates: s along the road and t across it, on a road that bends. The car starts at a
point given in them, is asked for its own, and passes a point given in them.

Made by osc2tx from capabilities/C29_route_coordinates.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class RouteCoordinates(Scenario):
    name = "route_coordinates"
    source = "capabilities/C29_route_coordinates.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="curve.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.passed = Event(rise(lambda: self.ego.get_s_coord() >= 250 * m))
        self.t_there = self.sample(lambda: self.ego.get_t_coord(), self.passed, 0 * m)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(15 * mps), throughout=True)

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.assign_position(
                odr_point=self.road.create_odr_point(road_id="1", lane_id="-1", s=120 * m, t=0 * m)
            ),
            self.ego.assign_speed(speed=15 * mps),
            Until(
                self.ego.drive("bend", speed(15 * mps)),
                self.passed,
            ),
            self.ego.drive(duration=2 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RouteCoordinates().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RouteCoordinates))
