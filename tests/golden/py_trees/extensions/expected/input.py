"""Scenarios `vehicle.commute`, `extensions`.

Names of several namespaces, and what is added to types after they are declared.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Unit,
    Vehicle,
    Wait,
    main,
    require_api,
    within,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Speed, mps, s

require_api(1)

# Units that the scenario declares
kWh_100km = 36.0
newton = 1.0

# Enums that the scenario declares
Mood: TypeAlias = Literal["calm", "brisk", "hurried", "reckless"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Habits:
    """Struct `habits`."""

    pace: Speed = 10 * mps
    spends: float = 15 * kWh_100km
    reserve: float = 0.5

    def is_thrifty(self) -> bool:
        return self.spends < 600 * newton and self.reserve > 0.1


class Commute(Scenario):
    name = "vehicle.commute"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.actor = self.cast("actor", Vehicle())
        self.habit = self.argument("habit", Habits())
        self.mood: Mood = self.parameter("mood", "calm")
        # A default that a user may not want
        self.top = self.parameter("top", 20 * mps, unit="mps")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.actor, speed(self.habit.pace), throughout=True)

    def behavior(self) -> Behaviour:
        return self.actor.drive(speed(self.habit.pace), duration=1 * s)


class Extensions(Scenario):
    name = "extensions"
    source = "input.osc"
    is_main = True

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.state: Mood = self.parameter("state", "reckless")
        self.economical_spends = self.parameter(
            "economical.spends", within(100 * newton, 550 * newton), unit=Unit("newton", newton)
        )
        self.economical = self.argument(
            "economical", Habits(pace=8 * mps, spends=self.economical_spends)
        )
        self.fast_pace = self.parameter("fast.pace", within(14 * mps, 15 * mps), unit="mps")
        self.fast = self.argument("fast", Habits(pace=self.fast_pace))
        self.ego_commute_top = self.parameter(
            "ego.commute.top", within(8 * mps, 15 * mps), unit="mps"
        )

        self.keep(self.fast.pace > 14 * mps)
        self.keep(self.fast.pace < 15 * mps)
        self.keep(self.ego_commute_top > self.economical.pace)
        self.keep(self.ego_commute_top < self.fast.pace)

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.invoke(Commute, actor=self.ego, habit=self.economical, top=self.ego_commute_top),
            self.invoke(Commute, actor=self.ego, habit=self.fast, known_as="commute_2"),
            Wait(
                lambda: self.economical.is_thrifty()
                and {"calm": 0, "brisk": 1, "hurried": 7, "reckless": 8}[self.state] == 8
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Extensions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Commute, Extensions))
