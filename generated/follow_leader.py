"""Scenario `follow_leader`.

A car follows its leader at a constant gap while the leader slows down and speeds up again.

Made by osc2tx from follow_leader.osc: edit the scenario, not this module.
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
from osc2tx_runtime.units import kph, m, s

require_api(1)


class FollowLeader(Scenario):
    name = "follow_leader"
    source = "follow_leader.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.leader = self.cast("leader", Vehicle())
        self.follower = self.cast("follower", Vehicle())

        self.v_start = self.parameter("v_start", 60 * kph, unit="kph")
        self.v_low = self.parameter("v_low", 30 * kph, unit="kph")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.leader, lane(1), position(150 * m), speed(self.v_start))
        self.place(
            self.follower,
            lane(same_as=self.leader),
            position(25 * m, behind=self.leader),
            speed(self.v_start),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.lead(),
            self.follower.keep_space_gap("follow", reference=self.leader, direction="longitudinal"),
        )

    def lead(self) -> Behaviour:
        return Serial(
            "lead",
            self.leader.drive(speed(self.v_start), duration=4 * s),
            self.leader.change_speed("slow_down", target=self.v_low, rate_profile="smooth"),
            self.leader.drive(duration=4 * s),
            self.leader.change_speed("speed_up", target=self.v_start, rate_profile="smooth"),
            self.leader.drive(duration=6 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return FollowLeader().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(FollowLeader))
