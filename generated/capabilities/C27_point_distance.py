"""Scenario `point_distance`.

C27 Distance to a point of the world: the car brakes where its straight distance to the point falls
below a limit.

Made by osc2tx from capabilities/C27_point_distance.osc: edit the scenario, not this module.
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
    fall,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps

require_api(1)


class PointDistance(Scenario):
    name = "point_distance"
    source = "capabilities/C27_point_distance.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.near = Event(
            fall(
                lambda: self.ego.distance_to_xyz_point(
                    point=self.road.create_xyz_point(x=200 * m, y=31.25 * m, z=0 * m),
                    direction="euclidean",
                )
                > 50 * m
            )
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            Until(
                self.ego.drive("approach", speed(20 * mps)),
                self.near,
            ),
            self.ego.change_speed(target=0 * mps, rate_profile="asap"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PointDistance().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PointDistance))
