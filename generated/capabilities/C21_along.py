"""Scenario `along_a_path`.

C21 Along a path: a drive that follows a path through the world and ends ten metres before its end.

Made by osc2tx from capabilities/C21_along.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Path,
    Pose,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import along, lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class AlongAPath(Scenario):
    name = "along_a_path"
    source = "capabilities/C21_along.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.begin = self.argument("begin", Pose(x=70 * m, y=-8.75 * m, z=0 * m))
        self.end_point = self.argument("end_point", Pose(x=190 * m, y=-8.75 * m, z=0 * m))
        self.way = self.argument(
            "way", Path(points=[self.begin, self.end_point], interpolation="straight_line")
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(20 * mps), duration=1 * s),
            self.ego.drive("ride", along(self.way, end_offset=10 * m)),
            self.ego.drive(duration=1 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AlongAPath().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AlongAPath))
