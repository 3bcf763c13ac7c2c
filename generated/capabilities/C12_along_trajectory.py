"""Scenario `along_trajectory`.

C12 Along a trajectory: a drive that is where a trajectory along the lane says, when it says so.

Made by osc2tx from capabilities/C12_along_trajectory.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Pose,
    Scenario,
    Serial,
    Trajectory,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import along_trajectory, lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class AlongTrajectory(Scenario):
    name = "along_trajectory"
    source = "capabilities/C12_along_trajectory.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.begin = self.argument("begin", Pose(x=60 * m, y=-8.75 * m, z=0 * m))
        self.middle = self.argument("middle", Pose(x=100 * m, y=-8.75 * m, z=0 * m))
        self.end_point = self.argument("end_point", Pose(x=160 * m, y=-8.75 * m, z=0 * m))
        self.plan = self.argument(
            "plan",
            Trajectory(
                points=[self.begin, self.middle, self.end_point],
                time_stamps=[0 * s, 4 * s, 9 * s],
                interpolation="straight_line",
            ),
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(10 * mps), duration=1 * s),
            self.ego.drive("timed", along_trajectory(self.plan)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AlongTrajectory().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AlongTrajectory))
