"""Scenario `custom_action`.

C33 Custom actions: two actions that the library does not have. Python classes for them come from
an installed package (docs/extending.md); the scenario only declares what it uses.

Made by osc2tx from capabilities/C33_custom_action.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from typing import Protocol

from osc2tx_runtime import (
    Behaviour,
    Duration,
    Late,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
    user_action,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import Speed, m, mps, s

require_api(1)


class Creep(Protocol):
    """Action `vehicle.creep`.

    Drives at walking speed, until something ends it.
    """

    def __call__(
        self,
        actor: Vehicle,
        label: str | None = None,
        /,
        *,
        v: Late[Speed] = 1.5 * mps,
        duration: Duration | None = None,
    ) -> Behaviour: ...


creep: Creep = user_action("creep", Creep)


class RollOut(Protocol):
    """Action `vehicle.roll_out`.

    Rolls to standstill.
    """

    def __call__(
        self,
        actor: Vehicle,
        label: str | None = None,
        /,
        *,
        duration: Duration | None = None,
    ) -> Behaviour: ...


roll_out: RollOut = user_action("roll_out", RollOut)


class CustomAction(Scenario):
    name = "custom_action"
    source = "capabilities/C33_custom_action.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(3 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(3 * mps), duration=1 * s),
            creep(self.ego, v=2 * mps, duration=3 * s),
            roll_out(self.ego),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return CustomAction().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(CustomAction))
