"""Scenario `careful_following`.

C13 Time gap: a driver that avoids collisions comes up behind slower ones. It follows each at the
gap of the intelligent-driver model: 2 m and 1.5 s. Without the modifier it would run into them.

Made by osc2tx from capabilities/C13_careful_following.osc: edit the scenario, not this module.
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
from osc2tx_runtime.modifiers import avoid_collisions, lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class CarefulFollowing(Scenario):
    name = "careful_following"
    source = "capabilities/C13_careful_following.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.slower = self.cast("slower", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(25 * mps))
        self.place(self.slower, lane(2), position(150 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(25 * mps), avoid_collisions(True)),
            self._slower_drive_then_change_speed(),
            duration=60 * s,
        )

    def _slower_drive_then_change_speed(self) -> Behaviour:
        return Serial(
            "slower: serial",
            self.slower.drive(speed(12 * mps), duration=30 * s),
            self.slower.change_speed(target=6 * mps, rate_profile="smooth"),
            self.slower.drive(),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return CarefulFollowing().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(CarefulFollowing))
