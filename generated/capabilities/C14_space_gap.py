"""Scenario `space_gap`.

C14 Space gap: the follower closes up to 12 m behind its leader, from rear end to front end, keeps
this gap, and leads a third car that holds a gap to its side.

Made by osc2tx from capabilities/C14_space_gap.osc: edit the scenario, not this module.
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


class SpaceGap(Scenario):
    name = "space_gap"
    source = "capabilities/C14_space_gap.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.leader = self.cast("leader", Vehicle())
        self.follower = self.cast("follower", Vehicle())
        self.side_car = self.cast("side_car", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.leader, lane(2), position(120 * m), speed(20 * mps))
        self.place(
            self.follower,
            lane(same_as=self.leader),
            position(50 * m, behind=self.leader),
            speed(20 * mps),
        )
        self.place(
            self.side_car,
            lane(side_of=self.leader, side="left"),
            position(10 * m, ahead_of=self.leader),
            speed(20 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.leader.drive(speed(20 * mps)),
            self._follower_close_up_then_stay(),
            self._side_car_drive_then_nearer(),
        )

    def _follower_close_up_then_stay(self) -> Behaviour:
        return Serial(
            "follower: serial",
            self.follower.change_space_gap(
                "close_up", target=12 * m, direction="behind", reference=self.leader
            ),
            self.follower.keep_space_gap(
                "stay", reference=self.leader, direction="longitudinal", duration=5 * s
            ),
        )

    def _side_car_drive_then_nearer(self) -> Behaviour:
        return Serial(
            "side_car: serial",
            self.side_car.drive(speed(20 * mps), duration=1 * s),
            self.side_car.change_space_gap(
                "nearer", target=1.2 * m, direction="left", reference=self.leader
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SpaceGap().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SpaceGap))
