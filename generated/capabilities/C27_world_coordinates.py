"""Scenario `world_coordinates`.

C27 World coordinates: a barrier stands at x, y, z of the world; a walker starts at others and
stops when the straight distance to a point is short enough.

Made by osc2tx from capabilities/C27_world_coordinates.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Person,
    Point,
    Pose,
    Scenario,
    Serial,
    StationaryObject,
    Until,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import location, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class WorldCoordinates(Scenario):
    name = "world_coordinates"
    source = "capabilities/C27_world_coordinates.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.barrier = self.cast("barrier", StationaryObject())
        self.walker = self.cast("walker", Person())

        self.barrier_pose = self.argument(
            "barrier_pose", Pose(x=130 * m, y=-24 * m, z=0 * m, yaw=90 * deg)
        )
        self.curb = self.argument("curb", Point(x=100 * m, y=-20 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.barrier, location(pose=self.barrier_pose))
        self.place(
            self.walker,
            position(at_point=self.curb, project_on_route=False),
            yaw(0 * deg),
            speed(1.4 * mps),
        )

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            Until(
                self.walker.walk("approach", speed(1.4 * mps)),
                rise(
                    lambda: self.walker.object_distance(
                        reference=self.barrier, direction="euclidean"
                    )
                    < 5 * m
                ),
            ),
            self.walker.remain_stationary(duration=2 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return WorldCoordinates().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(WorldCoordinates))
