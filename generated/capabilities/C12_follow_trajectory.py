"""Scenario `trajectory_following`.

C12 Follow trajectory: points with times. The car is at each point when its time has come; then
it replays a second trajectory exactly, which slows it down.

Made by osc2tx from capabilities/C12_follow_trajectory.osc: edit the scenario, not this module.
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


class TrajectoryFollowing(Scenario):
    name = "trajectory_following"
    source = "capabilities/C12_follow_trajectory.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.p0 = self.argument("p0", Pose(x=60 * m, y=-8.75 * m, z=0 * m))
        self.p1 = self.argument("p1", Pose(x=90 * m, y=-8.75 * m, z=0 * m))
        self.p2 = self.argument("p2", Pose(x=130 * m, y=-8.75 * m, z=0 * m))
        self.p3 = self.argument("p3", Pose(x=150 * m, y=-8.75 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(10 * mps), duration=1 * s),
            self.ego.follow_trajectory(
                "timed",
                absolute=self.road.create_trajectory(
                    points=[self.p0, self.p1, self.p2],
                    time_stamps=[0 * s, 3 * s, 7 * s],
                    interpolation="straight_line",
                ),
            ),
            self.ego.replay_trajectory(
                "exact",
                absolute=self.road.create_trajectory(
                    points=[self.p2, self.p3],
                    time_stamps=[0 * s, 4 * s],
                    interpolation="straight_line",
                ),
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return TrajectoryFollowing().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(TrajectoryFollowing))
