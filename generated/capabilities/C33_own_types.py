"""Scenario `own_types`.

C33 Own types: a unit, an enum, and a struct whose constraints say what belongs together. The
scenario names the mood; how fast and how hard follows from it.

Made by osc2tx from capabilities/C33_own_types.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import Acceleration, Speed, m, mps, mpss, s

require_api(1)

# Units that the scenario declares
# Knots
knot = 0.514444

# Enums that the scenario declares
Mood: TypeAlias = Literal["calm", "hasty"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """Struct `plan`."""

    mood: Mood
    cruise: Speed = 20 * knot
    peak: Acceleration

    # keep(mood == mood!calm => peak == 1mpss)
    # keep(mood == mood!hasty => peak == 3mpss)


class OwnTypes(Scenario):
    name = "own_types"
    source = "capabilities/C33_own_types.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.quiet = self.argument("quiet", Plan(mood="calm", peak=1 * mpss))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(5 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(5 * mps), duration=1 * s),
            self.ego.change_speed(
                "gain", target=self.quiet.cruise, rate_profile="constant", rate_peak=self.quiet.peak
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OwnTypes().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OwnTypes))
