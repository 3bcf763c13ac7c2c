"""Scenario `assign_position`.

C09 Assign position: a car is teleported: to a point of the world, of a road and of a
route, and beside another car.

Made by osc2tx from capabilities/C09_assign_position.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Point,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class AssignPosition(Scenario):
    name = "assign_position"
    source = "capabilities/C09_assign_position.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

        self.target = self.argument("target", Point(x=400 * m, y=-5.25 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.other, lane(1), position(100 * m), speed(10 * mps))
        self.place(self.ego, lane(4), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.other.drive(speed(10 * mps)),
            self._ego_drive_then_to_point(),
        )

    def _ego_drive_then_to_point(self) -> Behaviour:
        return Serial(
            "ego: serial",
            self.ego.drive(speed(10 * mps), duration=1 * s),
            self.ego.assign_position("to_point", position=self.target),
            self.ego.drive(duration=1 * s),
            self.ego.assign_position(
                "to_road",
                odr_point=self.road.create_odr_point(road_id="1", lane_id="-3", s=700 * m, t=0 * m),
            ),
            self.ego.drive(duration=1 * s),
            self.ego.assign_position(
                "to_route",
                route_point=lambda: self.road.odr_to_route_point(
                    road_id="1", lane_id="-4", s=800 * m, t=0 * m
                ),
            ),
            self.ego.drive(duration=1 * s),
            self.ego.assign_position(
                "beside",
                lane(side_of=self.other, side="left"),
                position(20 * m, ahead_of=self.other),
            ),
            self.ego.drive(duration=1 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AssignPosition().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AssignPosition))
