"""Scenario `relative_coordinates`.

C28 Relative coordinates: distances in the frame of the actor that asks. The walker looks across
the road, so a car that passes along the road moves from its left to its right.

Made by osc2tx from capabilities/C28_relative_coordinates.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Parallel,
    Person,
    Point,
    Scenario,
    Serial,
    Until,
    Vehicle,
    fall,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class RelativeCoordinates(Scenario):
    name = "relative_coordinates"
    source = "capabilities/C28_relative_coordinates.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.walker = self.cast("walker", Person())
        self.car = self.cast("car", Vehicle())

        self.spot = self.argument("spot", Point(x=150 * m, y=-25 * m, z=0 * m))
        self.abreast = Event(
            fall(
                lambda: self.walker.object_distance(reference=self.car, direction="lateral") > 0 * m
            )
        )
        self.ahead = self.sample(
            lambda: self.walker.object_distance(reference=self.car, direction="longitudinal"),
            self.abreast,
            0 * m,
        )
        self.left_of_car = self.sample(
            lambda: self.car.object_distance(reference=self.walker, direction="lateral"),
            self.abreast,
            0 * m,
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.walker, position(at_point=self.spot, project_on_route=False), yaw(90 * deg))
        self.place(self.car, lane(1), position(51.5 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.walker.remain_stationary(),
            self._car_approach_then_drive(),
        )

    def _car_approach_then_drive(self) -> Behaviour:
        return Serial(
            "car: serial",
            Until(
                self.car.drive("approach", speed(20 * mps)),
                self.abreast,
            ),
            self.car.drive(duration=1 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RelativeCoordinates().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RelativeCoordinates))
