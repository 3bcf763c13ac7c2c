"""Scenario `overriding`.

C34 Override: a warning brake ends the cruise as soon as it starts; a comfort action does not even
start while the brake is on.

Made by osc2tx from capabilities/C34_override.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
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


class Overriding(Scenario):
    name = "overriding"
    source = "capabilities/C34_override.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        self.override("cruise", "brake")
        self.override("hurry", "brake", mode="when_active")
        return Parallel(
            self.name,
            self.ego.drive("cruise", speed(20 * mps)),
            self.warning(),
            self.comfort(),
        )

    def warning(self) -> Behaviour:
        return Serial(
            "warning",
            Wait(elapsed(2 * s)),
            self.ego.change_speed(
                "brake", target=10 * mps, rate_profile="constant", rate_peak=4 * mpss
            ),
        )

    def comfort(self) -> Behaviour:
        return Serial(
            "comfort",
            Wait(elapsed(3 * s)),
            self.ego.change_speed("hurry", target=25 * mps),
            Wait(elapsed(2 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Overriding().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Overriding))
