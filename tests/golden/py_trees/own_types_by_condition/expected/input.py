"""Scenarios `top`, `haul`.

What an object is because of what a field of it is.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from typing import Literal, TypeAlias, Unpack

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    any_of,
    as_type,
    main,
    require_api,
)
from osc2tx_runtime.fields import VehicleFields
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Speed, mps, s

require_api(1)

# Enums that the scenario declares
Load: TypeAlias = Literal["empty", "full"]


class Lorry(Vehicle):
    """Actor `lorry`."""

    kinds = ("lorry", *Vehicle.kinds)

    def __init__(self, *, load: Load, crew: int = 1, **fields: Unpack[VehicleFields]) -> None:
        super().__init__(**fields)
        self.load = load
        self.crew = crew

    def pace(self) -> Speed:
        return 20 * mps


class LoadedLorry(Lorry):
    """Actor `loaded_lorry`.

    Slower, and somebody helps to unload
    """

    kinds = ("loaded_lorry", *Lorry.kinds)

    class Inherited(VehicleFields, total=False):
        """Keywords of the bases."""

        load: Load
        crew: int

    def __init__(self, *, weight: float = 7.5, **fields: Unpack[Inherited]) -> None:
        super().__init__(**fields)
        self.weight = weight

    # keep(crew == 2)

    def pace(self) -> Speed:
        return 12 * mps


class Top(Scenario):
    name = "top"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", LoadedLorry(crew=2, load="full"))
        self.other = self.cast("other", Lorry(load="empty"))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.invoke(Haul, who=self.ego, hands=2),
            self.invoke(Haul, who=self.other, hands=1, known_as="haul_2"),
            Wait(lambda: as_type(self.ego, LoadedLorry).weight > 7.0 and self.other.load != "full"),
        )


class Haul(Scenario):
    name = "haul"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.who_load: Load = self.parameter("who.load", any_of("empty", "full"))
        self.who = self.cast("who", Lorry(load=self.who_load))
        self.hands = self.required("hands", int)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.who, speed(self.who.pace()), throughout=True)

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.who.drive(speed(self.who.pace()), duration=1 * s),
            Wait(lambda: self.who.crew == self.hands),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Top().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Top, Haul))
