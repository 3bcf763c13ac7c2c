"""Scenario `change_position`.

C11 Change position: a car finds its own way to a point: along lanes to one that is given by the
road, a person straight across to one of the world.

Made by osc2tx from capabilities/C11_change_position.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Person,
    Point,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class ChangePosition(Scenario):
    name = "change_position"
    source = "capabilities/C11_change_position.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.car = self.cast("car", Vehicle())
        self.walker = self.cast("walker", Person())

        self.begin = self.argument("begin", Point(x=100 * m, y=-30 * m, z=0 * m))
        self.goal = self.argument("goal", Point(x=106 * m, y=-38 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.car, lane(2), position(50 * m), speed(15 * mps))
        self.place(
            self.walker,
            position(at_point=self.begin, project_on_route=False),
            yaw(0 * deg),
            speed(1 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._car_drive_then_change_position(),
            self._walker_walk_then_change_position(),
        )

    def _car_drive_then_change_position(self) -> Behaviour:
        return Serial(
            "car: serial",
            self.car.drive(speed(15 * mps), duration=1 * s),
            self.car.change_position(
                target_odr=self.road.create_odr_point(road_id="1", lane_id="-3", s=200 * m, t=0 * m)
            ),
        )

    def _walker_walk_then_change_position(self) -> Behaviour:
        return Serial(
            "walker: serial",
            self.walker.walk(speed(1 * mps), duration=1 * s),
            self.walker.change_position(
                target_xyz=self.goal, interpolation="straight_line", on_road_network=False
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ChangePosition().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ChangePosition))
