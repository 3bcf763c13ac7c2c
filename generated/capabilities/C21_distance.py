"""Scenario `ways`.

C21 Ways: so far and no further, and a place in the world that is kept.

Made by osc2tx from capabilities/C21_distance.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import distance, keep_position, lane, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps

require_api(1)


class Ways(Scenario):
    name = "ways"
    source = "capabilities/C21_distance.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.walker = self.cast("walker", Person())

        self.corner = self.argument("corner", Point(x=80 * m, y=-30 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(15 * mps))
        self.place(
            self.walker, position(at_point=self.corner, project_on_route=False), yaw(90 * deg)
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_first_leg_then_second_leg(),
            self.walker.walk(keep_position()),
        )

    def _ego_first_leg_then_second_leg(self) -> Behaviour:
        return Serial(
            "ego: serial",
            self.ego.drive("first_leg", speed(15 * mps), distance(60 * m)),
            self.ego.drive("second_leg", distance(36 * m)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Ways().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Ways))
