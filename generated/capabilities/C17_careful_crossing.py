"""Scenario `careful_crossing`.

C17 Traffic signals and rules: a driver that avoids collisions stops for a person on the road, waits
until its way is free and drives on.

Made by osc2tx from capabilities/C17_careful_crossing.osc: edit the scenario, not this module.
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
    Until,
    Vehicle,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import avoid_collisions, lane, position, speed, yaw
from osc2tx_runtime.units import deg, kph, m, mps, s

require_api(1)


class CarefulCrossing(Scenario):
    name = "careful_crossing"
    source = "capabilities/C17_careful_crossing.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="crossing.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.walker = self.cast("walker", Person())
        # On the right sidewalk, in the middle of the road
        self.curb = self.argument("curb", Point(x=250 * m, y=-5 * m, z=0 * m))

        self.v_ego = self.parameter("v_ego", 40 * kph, unit="kph")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(120 * m), speed(self.v_ego))
        self.place(self.walker, position(at_point=self.curb, project_on_route=False), yaw(90 * deg))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(self.v_ego), avoid_collisions(True)),
            self._walker_remain_stationary_then_walk(),
            duration=40 * s,
        )

    def _walker_remain_stationary_then_walk(self) -> Behaviour:
        return Serial(
            "walker: serial",
            Until(
                self.walker.remain_stationary(),
                rise(
                    lambda: self.walker.object_distance(reference=self.ego, direction="euclidean")
                    < 60 * m
                ),
            ),
            self.walker.walk(speed(1.4 * mps), duration=2.5 * s),
            self.walker.remain_stationary("hesitates", duration=10 * s),
            self.walker.walk("onward", speed(1.4 * mps), duration=4 * s),
            self.walker.remain_stationary(),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return CarefulCrossing().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(CarefulCrossing))
