"""Scenario `assign_orientation`.

C10 Assign orientation: a person turns to a heading of the world and walks on that way.

Made by osc2tx from capabilities/C10_assign_orientation.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Orientation,
    Person,
    Point,
    Scenario,
    Serial,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class AssignOrientation(Scenario):
    name = "assign_orientation"
    source = "capabilities/C10_assign_orientation.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.walker = self.cast("walker", Person())

        self.start_point = self.argument("start_point", Point(x=100 * m, y=-40 * m, z=0 * m))
        self.north_east = self.argument(
            "north_east", Orientation(yaw=60 * deg, pitch=0 * deg, roll=0 * deg)
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(
            self.walker,
            position(at_point=self.start_point, project_on_route=False),
            yaw(0 * deg),
            speed(1 * mps),
        )

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.walker.walk("east", speed(1 * mps), duration=5 * s),
            self.walker.assign_orientation("turn", orientation=self.north_east),
            self.walker.walk("onward", speed(1 * mps), duration=5 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AssignOrientation().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AssignOrientation))
