"""Scenario `headway`.

C15 Headway: fronts count, not ends. One car takes a place 25 m behind the leader's front and
holds it, another one a place 3 s behind it, which is a distance by its own speed.

Made by osc2tx from capabilities/C15_headway.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class Headway(Scenario):
    name = "headway"
    source = "capabilities/C15_headway.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.leader = self.cast("leader", Vehicle())
        self.near = self.cast("near", Vehicle())
        self.far = self.cast("far", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.leader, lane(2), position(200 * m), speed(18 * mps))
        self.place(
            self.near,
            lane(same_as=self.leader),
            position(40 * m, behind=self.leader),
            speed(18 * mps),
        )
        self.place(
            self.far,
            lane(same_as=self.leader),
            position(70 * m, behind=self.leader),
            speed(18 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.leader.drive(speed(18 * mps)),
            self._near_closes_then_near_stays(),
            self._far_closes_then_far_stays(),
        )

    def _near_closes_then_near_stays(self) -> Behaviour:
        return Serial(
            "near: serial",
            self.near.change_space_headway(
                "near_closes", target=25 * m, direction="behind", reference=self.leader
            ),
            self.near.keep_space_headway("near_stays", reference=self.leader, duration=4 * s),
        )

    def _far_closes_then_far_stays(self) -> Behaviour:
        return Serial(
            "far: serial",
            self.far.change_time_headway(
                "far_closes", target=3 * s, direction="behind", reference=self.leader
            ),
            self.far.keep_time_headway("far_stays", reference=self.leader, duration=4 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Headway().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Headway))
