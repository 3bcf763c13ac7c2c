"""Scenario `relative_path`.

C11 Relative path: the same shape for two cars, resolved where each of them is when it begins.

Made by osc2tx from capabilities/C11_relative_path.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Pose,
    RelativePathPose3d,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class RelativePath(Scenario):
    name = "relative_path"
    source = "capabilities/C11_relative_path.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.one = self.cast("one", Vehicle())
        self.other = self.cast("other", Vehicle())

        self.here = self.argument("here", Pose(x=0 * m, y=0 * m))
        self.ahead = self.argument("ahead", Pose(x=30 * m, y=0 * m))
        self.aside = self.argument("aside", Pose(x=60 * m, y=-3.5 * m))
        self.beyond = self.argument("beyond", Pose(x=70 * m, y=-3.5 * m))
        self.swerve = self.argument(
            "swerve",
            RelativePathPose3d(
                points=[self.here, self.ahead, self.aside, self.beyond],
                interpolation="straight_line",
            ),
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.one, lane(2), position(50 * m), speed(10 * mps))
        self.place(self.other, lane(4), position(80 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.begin(),
            self.both(),
        )

    def begin(self) -> Behaviour:
        return Parallel(
            "begin",
            self.one.drive(speed(10 * mps), duration=1 * s),
            self.other.drive(speed(10 * mps), duration=1 * s),
        )

    def both(self) -> Behaviour:
        return Parallel(
            "both",
            self.one.replay_path(
                relative=self.swerve, reference=self.one, transform="object_relative"
            ),
            self.other.replay_path(
                absolute=lambda: self.road.resolve_relative_path(
                    relative_path=self.swerve, reference=self.other, transform="object_relative"
                )
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RelativePath().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RelativePath))
