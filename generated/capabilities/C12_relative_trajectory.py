"""Scenario `relative_trajectory`.

C12 Relative trajectory: points with times in the frame of the car, as it is when it begins.

Made by osc2tx from capabilities/C12_relative_trajectory.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Pose,
    RelativeTrajectoryPose3d,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class RelativeTrajectory(Scenario):
    name = "relative_trajectory"
    source = "capabilities/C12_relative_trajectory.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.here = self.argument("here", Pose(x=0 * m, y=0 * m))
        self.ahead = self.argument("ahead", Pose(x=40 * m, y=0 * m))
        self.aside = self.argument("aside", Pose(x=80 * m, y=3.5 * m))
        self.shape = self.argument(
            "shape",
            RelativeTrajectoryPose3d(
                points=[self.here, self.ahead, self.aside],
                time_stamps=[0 * s, 4 * s, 8 * s],
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
            self.ego.replay_trajectory(
                "pass_by", relative=self.shape, reference=self.ego, transform="object_relative"
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RelativeTrajectory().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RelativeTrajectory))
