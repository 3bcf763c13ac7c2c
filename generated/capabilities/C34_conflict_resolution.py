"""Scenario `conflict_resolution`.

C34 Conflict resolution: who controls a car. A later step takes over from an earlier one in the
same instant, and speed and lane are controlled apart, so that two branches may share a car.

Made by osc2tx from capabilities/C34_conflict_resolution.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class ConflictResolution(Scenario):
    name = "conflict_resolution"
    source = "capabilities/C34_conflict_resolution.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            # Controls the speed, until `evade` wants it
            Until(
                self.ego.drive("cruise", speed(20 * mps)),
                elapsed(2 * s),
            ),
            self.share(),
            self.ego.change_speed(
                "recover", target=16 * mps, rate_profile="constant", rate_peak=2 * mpss
            ),
        )

    def share(self) -> Behaviour:
        return Parallel(
            "share",
            self.ego.change_speed(
                "evade", target=10 * mps, rate_profile="constant", rate_peak=4 * mpss
            ),
            self.ego.change_lane("swerve", side="left", duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ConflictResolution().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ConflictResolution))
