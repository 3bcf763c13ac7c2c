"""Scenario `conditional_triggers`.

C32 Conditional triggers: a declared event with a condition, one that is emitted, and a reaction
beside the story.

Made by osc2tx from capabilities/C32_conditional_triggers.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    On,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class ConditionalTriggers(Scenario):
    name = "conditional_triggers"
    source = "capabilities/C32_conditional_triggers.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

        self.near = Event(
            rise(
                lambda: self.ego.space_gap(reference=self.other, direction="longitudinal") > -20 * m
            )
        )
        self.ready = Event()
        self.noticed = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))
        self.place(self.other, lane(2), position(150 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_part_and_other_part(),
            On(
                self.ready,
                Emit(self.noticed),
            ),
        )

    def _ego_part_and_other_part(self) -> Behaviour:
        return Parallel(
            "do parallel",
            self.ego_part(),
            self.other_part(),
            self.answer(),
        )

    def ego_part(self) -> Behaviour:
        return Serial(
            "ego_part",
            Until(
                self.ego.drive("approach", speed(20 * mps)),
                self.near,
            ),
            self.ego.change_lane("swerve", side="left", duration=3 * s),
            Emit(self.ready),
        )

    def other_part(self) -> Behaviour:
        return Serial(
            "other_part",
            Until(
                self.other.drive(speed(10 * mps)),
                self.ready,
            ),
            self.other.change_speed(
                "go", target=15 * mps, rate_profile="constant", rate_peak=2.5 * mpss
            ),
        )

    def answer(self) -> Behaviour:
        return Serial(
            "answer",
            Wait(self.noticed),
            self.ego.change_speed(target=16 * mps, rate_profile="constant", rate_peak=2 * mpss),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ConditionalTriggers().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ConditionalTriggers))
