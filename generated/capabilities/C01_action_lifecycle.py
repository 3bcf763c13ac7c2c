"""Scenario `action_lifecycle`.

C01 Action lifecycle: an action starts, ends at its goal, or fails with a reason. What runs on
without a goal is stopped from outside.

Made by osc2tx from capabilities/C01_action_lifecycle.osc: edit the scenario, not this module.
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


class ActionLifecycle(Scenario):
    name = "action_lifecycle"
    source = "capabilities/C01_action_lifecycle.osc"

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
            # Ends by itself: 4 m/s at 2 m/s^2
            self.ego.change_speed(
                "speed_up", target=14 * mps, rate_profile="constant", rate_peak=2 * mpss
            ),
            # Without a goal; another member has to end it
            self.ego.keep_speed("cruise", duration=3 * s),
            self._ego_impossible_one_of(),
        )

    def _ego_impossible_one_of(self) -> Behaviour:
        """There are not nine lanes to the right: fails at once, and the other member goes on."""
        return OneOf(
            "ego: one_of",
            self.ego.change_lane("impossible", num_of_lanes=9, side="right"),
            Wait(elapsed(1 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ActionLifecycle().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ActionLifecycle))
