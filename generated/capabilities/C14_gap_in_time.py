"""Scenario `gap_in_time`.

C14 Gaps in a given time: a car comes to 20 m behind another one in exactly 8 s, and then, in an
order that leaves the time open, to 30 m.

Made by osc2tx from capabilities/C14_gap_in_time.osc: edit the scenario, not this module.
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


class GapInTime(Scenario):
    name = "gap_in_time"
    source = "capabilities/C14_gap_in_time.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.lead = self.cast("lead", Vehicle())
        self.follower = self.cast("follower", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.lead, lane(2), position(90 * m), speed(12 * mps))
        self.place(
            self.follower,
            lane(same_as=self.lead),
            position(40 * m, behind=self.lead),
            speed(10 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.lead.drive(duration=30 * s),
            self._follower_change_space_gap_serial(),
            overlap="any",
        )

    def _follower_change_space_gap_serial(self) -> Behaviour:
        return Serial(
            "follower: serial",
            self.follower.change_space_gap(
                target=20 * m, direction="behind", reference=self.lead, duration=8 * s
            ),
            self.follower.change_space_gap(
                target=30 * m, direction="behind", reference=self.lead, duration=(4 * s, 12 * s)
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return GapInTime().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(GapInTime))
