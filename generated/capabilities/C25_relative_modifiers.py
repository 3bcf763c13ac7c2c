"""Scenario `relative_modifiers`.

C25 Relative modifiers: lane, place and speed of the second car are all given by the first one,
at the start and while the first one changes.

Made by osc2tx from capabilities/C25_relative_modifiers.osc: edit the scenario, not this module.
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


class RelativeModifiers(Scenario):
    name = "relative_modifiers"
    source = "capabilities/C25_relative_modifiers.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.lead = self.cast("lead", Vehicle())
        self.wing = self.cast("wing", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.lead, lane(2), position(150 * m), speed(15 * mps))
        self.place(
            self.wing,
            lane(side_of=self.lead, side="left"),
            position(25 * m, behind=self.lead),
            speed(same_as=self.lead),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._lead_drive_then_lead_changes(),
            self.wing.drive(speed(same_as=self.lead)),
        )

    def _lead_drive_then_lead_changes(self) -> Behaviour:
        return Serial(
            "lead: serial",
            self.lead.drive(speed(15 * mps), duration=2 * s),
            self.lead.change_speed(
                "lead_changes", target=21 * mps, rate_profile="smooth", duration=6 * s
            ),
            self.lead.drive(duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RelativeModifiers().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RelativeModifiers))
