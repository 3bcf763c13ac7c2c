"""Scenario `road_path`.

C11 Path along a road: points in road coordinates, joined on the road network, so that the car takes
the bend between them.

Made by osc2tx from capabilities/C11_road_path.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
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


class RoadPathScenario(Scenario):
    name = "road_path"
    source = "capabilities/C11_road_path.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="curve.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(60 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(12 * mps), duration=1 * s),
            self.ego.follow_path(
                "bend",
                absolute=self.road.create_path_odr_points(
                    points=[
                        self.road.create_odr_point(road_id="1", lane_id="-1", s=80 * m, t=0 * m),
                        self.road.create_odr_point(road_id="1", lane_id="-1", s=260 * m, t=0 * m),
                    ],
                    interpolation="smooth",
                    on_road_network=True,
                ),
            ),
            self.ego.drive(duration=1 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RoadPathScenario().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RoadPathScenario))
