"""Scenario `composition`.

C03 Composition: serials inside a parallel. Steps follow each other without a gap, branches run
side by side, and the whole ends with its last branch.

Made by osc2tx from capabilities/C03_composition.osc: edit the scenario, not this module.
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
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class Composition(Scenario):
    name = "composition"
    source = "capabilities/C03_composition.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(50 * m), speed(10 * mps))
        self.place(self.other, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego_part(),
            self.other_part(),
        )

    def ego_part(self) -> Behaviour:
        return Serial(
            "ego_part",
            self.ego.change_speed(
                "faster", target=14 * mps, rate_profile="constant", rate_peak=2 * mpss
            ),
            self.ego.change_speed(
                "slower", target=8 * mps, rate_profile="constant", rate_peak=3 * mpss
            ),
        )

    def other_part(self) -> Behaviour:
        return Serial(
            "other_part",
            self.other.drive("pause", duration=1 * s),
            self.other.change_lane("swerve", side="left", duration=5 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Composition().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Composition))
