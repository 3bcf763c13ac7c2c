"""Scenario `constraints`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from typing import Literal, TypeAlias

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    any_of,
    at_least,
    elapsed,
    inf,
    main,
    require_api,
    within,
)
from osc2tx_runtime.modifiers import lane, speed
from osc2tx_runtime.units import Length, kph, m, s

require_api(1)

# Enums that the scenario declares
WeatherKind: TypeAlias = Literal["dry", "wet", "icy"]


class Constraints(Scenario):
    name = "constraints"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego_bounding_box_length = self.parameter(
            "ego.bounding_box.length", within(4 * m, 5 * m), unit="m"
        )
        self.ego = self.cast(
            "ego",
            Vehicle(
                vehicle_category="car",
                # set as `ego.bounding_box.length`
                length=self.ego_bounding_box_length,
                color="red",
            ),
        )
        self.npc_bounding_box_length = self.parameter(
            "npc.bounding_box.length", within(4 * m, 5 * m), unit="m"
        )
        self.npc = self.cast(
            "npc", Vehicle(vehicle_category="car", length=self.npc_bounding_box_length)
        )

        # one bound and a default: the bound holds for settings
        self.gap = self.parameter("gap", 10 * m, at_least(3 * m), unit="m")
        # an open end: a value must be given
        self.reach = self.required("reach", Length, at_least(2 * m), unit="m")
        # both bounds, in two constraints
        self.slow = self.parameter("slow", within(20 * kph, 40 * kph), unit="kph")
        self.fast = self.parameter("fast", within(30 * kph, 60 * kph), unit="kph")
        # solved for the one that is declared last
        self.first = self.parameter("first", within(1 * s, 2 * s), unit="s")
        self.second = 3 * s - self.first
        # a set of values
        self.lanes = self.parameter("lanes", any_of(1, 2))
        self.road_state: WeatherKind = self.parameter("road_state", any_of("dry", "wet"))
        # later constraints replace defaults
        self.pause = 1 * s
        self.number = self.parameter("number", within(2, 4))
        self.change_target = self.parameter("change.target", within(5 * kph, 10 * kph), unit="kph")

        self.keep(self.reach > 2 * m)

        # checked, and drawn again until it holds
        self.keep(self.slow + 10 * kph < self.fast)

        # an implication
        self.keep(self.road_state != "wet" or self.fast <= 50 * kph)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.slow), lane(self.lanes))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            Until(
                self.ego.drive("drive", speed(self.slow), duration=(self.first, inf)),
                elapsed(self.second + self.pause),
            ),
            self._npc_change_serial(),
        )

    def _npc_change_serial(self) -> Behaviour:
        return Serial(
            "npc: serial",
            Wait(elapsed(1 * s)),
            self.npc.change_speed("change", target=self.change_target),
            duration=(1 * s, 30 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Constraints().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Constraints))
