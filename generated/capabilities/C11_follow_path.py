"""Scenario `path_following`.

C11 Follow path: a smooth path through points of the world, at the vehicle's own speed; then the
same car replays a straight one exactly.

Made by osc2tx from capabilities/C11_follow_path.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Pose,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class PathFollowing(Scenario):
    name = "path_following"
    source = "capabilities/C11_follow_path.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.begin = self.argument("begin", Pose(x=60 * m, y=-8.75 * m, z=0 * m))
        self.middle = self.argument("middle", Pose(x=100 * m, y=-4 * m, z=0 * m))
        self.end_point = self.argument("end_point", Pose(x=140 * m, y=-8.75 * m, z=0 * m))
        self.far = self.argument("far", Pose(x=240 * m, y=-12.25 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(10 * mps), duration=1 * s),
            self.ego.follow_path(
                "curve",
                absolute=self.road.create_path(
                    points=[self.begin, self.middle, self.end_point], interpolation="smooth"
                ),
            ),
            self.ego.replay_path(
                "line",
                absolute=self.road.create_path(
                    points=[self.end_point, self.far], interpolation="straight_line"
                ),
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PathFollowing().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PathFollowing))
