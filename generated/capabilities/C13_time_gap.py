"""Scenario `time_gap`.

C13 Time gap: the follower closes up to 1.5 s behind its leader and stays there while the leader
slows down.

Made by osc2tx from capabilities/C13_time_gap.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class TimeGap(Scenario):
    name = "time_gap"
    source = "capabilities/C13_time_gap.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.leader = self.cast("leader", Vehicle())
        self.follower = self.cast("follower", Vehicle())

        self.closed_up = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.leader, lane(2), position(120 * m), speed(20 * mps))
        self.place(
            self.follower,
            lane(same_as=self.leader),
            position(60 * m, behind=self.leader),
            speed(20 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._leader_drive_then_slow_down(),
            self._follower_close_up_then_stay(),
        )

    def _leader_drive_then_slow_down(self) -> Behaviour:
        return Serial(
            "leader: serial",
            Until(
                self.leader.drive(speed(20 * mps)),
                self.closed_up,
            ),
            self.leader.drive(duration=2 * s),
            self.leader.change_speed(
                "slow_down", target=15 * mps, rate_profile="smooth", duration=6 * s
            ),
            self.leader.drive(duration=15 * s),
        )

    def _follower_close_up_then_stay(self) -> Behaviour:
        return Serial(
            "follower: serial",
            self.follower.change_time_gap(
                "close_up", target=1.5 * s, direction="behind", reference=self.leader
            ),
            Emit(self.closed_up),
            self.follower.keep_time_gap("stay", reference=self.leader, direction="longitudinal"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return TimeGap().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(TimeGap))
