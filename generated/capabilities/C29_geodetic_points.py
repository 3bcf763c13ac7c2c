"""Scenario `geodetic_points`.

C29 Geodetic points: a drive to a place that is given by its latitude and longitude.

Made by osc2tx from capabilities/C29_geodetic_points.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    GeodeticPoint,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import along, speed
from osc2tx_runtime.units import deg, mps

require_api(1)


class GeodeticPoints(Scenario):
    name = "geodetic_points"
    source = "capabilities/C29_geodetic_points.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.begin = self.argument(
            "begin", GeodeticPoint(latitude=-0.0000475 * deg, longitude=0.001 * deg)
        )
        self.goal = self.argument(
            "goal", GeodeticPoint(latitude=-0.0000475 * deg, longitude=0.003 * deg)
        )
        self.way = self.argument("way", self.road.create_route([self.begin, self.goal]))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, along(self.way), speed(20 * mps), throughout=True)

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(along(self.way), speed(20 * mps)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return GeodeticPoints().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(GeodeticPoints))
