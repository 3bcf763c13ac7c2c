"""Scenario `durations`.

C04 Duration handling: `duration` ends what has no end, sets the length of what has a goal, and
makes what does not get there in time fail.

Made by osc2tx from capabilities/C04_duration.osc: edit the scenario, not this module.
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


class Durations(Scenario):
    name = "durations"
    source = "capabilities/C04_duration.osc"

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
            # Open-ended: ends after 3 s
            self.ego.drive("cruise", speed(10 * mps), duration=3 * s),
            # With a goal: reaches it after exactly 4 s
            self.ego.change_speed("faster", target=20 * mps, rate_profile="smooth", duration=4 * s),
            self._ego_hurried_one_of(),
        )

    # A whole block has 2 s; its content is longer, so it fails and the other member goes on
    def _ego_hurried_one_of(self) -> Behaviour:
        return OneOf(
            "ego: one_of",
            self.hurried(),
            Wait(elapsed(6 * s)),
        )

    def hurried(self) -> Behaviour:
        return Serial(
            "hurried",
            Wait(elapsed(1 * s)),
            self.ego.change_speed(
                "slower", target=10 * mps, rate_profile="constant", rate_peak=2 * mpss
            ),
            duration=2 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Durations().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Durations))
