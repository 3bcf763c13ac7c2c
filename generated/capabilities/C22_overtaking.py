"""Scenario `overtaking`.

C22 Overtaking: on a road of one lane each way a car lets another one come by, overtakes a slow
one in the lane of oncoming traffic and goes back to its own.

Made by osc2tx from capabilities/C22_overtaking.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Point,
    Scenario,
    Serial,
    Until,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpsps, s

require_api(1)


class Overtaking(Scenario):
    name = "overtaking"
    source = "capabilities/C22_overtaking.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="crossing.xodr"))
        self.slow = self.cast("slow", Vehicle())
        self.ego = self.cast("ego", Vehicle())
        self.oncoming = self.cast("oncoming", Vehicle())
        self.far = self.argument("far", Point(x=260 * m, y=1.75 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.slow, lane(1), position(120 * m), speed(8 * mps))
        self.place(self.oncoming, position(at_point=self.far), speed(12 * mps))
        self.place(
            self.ego, lane(same_as=self.slow), position(20 * m, behind=self.slow), speed(8 * mps)
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.slow.drive(speed(8 * mps)),
            self.oncoming.drive(speed(12 * mps)),
            self._ego_behind_then_out(),
            overlap="start",
        )

    def _ego_behind_then_out(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive("behind", speed(8 * mps)),
                lambda: self.ego.object_distance(reference=self.oncoming, direction="longitudinal")
                < 0 * m,
            ),
            self.out(),
            Until(
                self.ego.drive("past"),
                lambda: self.ego.space_gap(reference=self.slow, direction="longitudinal") > 12 * m,
            ),
            self.ego.change_lane("back", num_of_lanes=1, side="outside"),
            self.ego.drive(duration=2 * s),
        )

    def out(self) -> Behaviour:
        return Parallel(
            "out",
            self.ego.change_lane(num_of_lanes=1, side="inside"),
            self.ego.change_speed(target=15 * mps, rate_profile="constant", rate_peak=2.5 * mpsps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Overtaking().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Overtaking))
