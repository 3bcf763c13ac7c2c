"""Scenario `one_of_race`.

C36 one_of: all members start; the first one to succeed ends the others. Here the car reaches its
speed before the time is over.

Made by osc2tx from capabilities/C36_one_of.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    OneOf,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class OneOfRace(Scenario):
    name = "one_of_race"
    source = "capabilities/C36_one_of.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.race(),
            self.ego.drive(duration=1 * s),
        )

    def race(self) -> Behaviour:
        return OneOf(
            "race",
            self.ego.change_speed(
                "reached", target=15 * mps, rate_profile="constant", rate_peak=2 * mpss
            ),
            Wait(elapsed(4 * s)),
            self.ego.change_lane("stand", side="left", duration=8 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OneOfRace().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OneOfRace))
