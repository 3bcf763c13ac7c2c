"""Scenario `speed_modifier`.

C19 Speed modifier: a speed of its own, and speeds relative to it: faster, slower, by a factor.

Made by osc2tx from capabilities/C19_speed_modifier.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import kph, m, mps, s

require_api(1)


class SpeedModifier(Scenario):
    name = "speed_modifier"
    source = "capabilities/C19_speed_modifier.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.pace = self.cast("pace", Vehicle())
        self.faster = self.cast("faster", Vehicle())
        self.slower = self.cast("slower", Vehicle())
        self.scaled = self.cast("scaled", Vehicle())

        self.v_pace = self.parameter("v_pace", 54 * kph, unit="kph")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.pace, lane(1), position(100 * m), speed(10 * mps))
        self.place(self.faster, lane(2), position(100 * m), speed(10 * mps))
        self.place(self.slower, lane(3), position(100 * m), speed(10 * mps))
        self.place(self.scaled, lane(4), position(100 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.pace.drive(speed(self.v_pace)),
            self.faster.drive(speed(3 * mps, faster_than=self.pace)),
            self.slower.drive(speed(3 * mps, slower_than=self.pace)),
            self.scaled.drive(speed(same_as=self.pace, factor=1.2)),
            duration=8 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SpeedModifier().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SpeedModifier))
