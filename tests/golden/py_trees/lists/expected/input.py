"""Scenario `lists`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from typing import Literal, TypeAlias

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, m, s

require_api(1)

# Enums that the scenario declares
KindOfRoad: TypeAlias = Literal["city", "rural", "highway"]


class Lists(Scenario):
    name = "lists"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.npc = self.cast("npc", Vehicle())
        self.fleet = self.argument("fleet", [self.ego, self.npc])
        self.speeds = self.argument("speeds", [10 * kph, 20 * kph, 30 * kph])
        self.where: KindOfRoad = self.parameter("where", "rural")
        self.number = self.parameter("number", {"city": 3, "rural": 4, "highway": 5}[self.where])
        self.back: KindOfRoad = self.parameter("back", "highway")
        self.half = self.parameter("half", float(self.number) / 2.0)
        self.cruise = self.parameter("cruise", self.speeds[1], unit="mps")
        # operators of lists within operators of lists
        self.slow = self.argument("slow", [it / 2.0 for it in self.speeds if it < 25 * kph])

        self.keep(len(self.speeds) == 3 and any(it == 20 * kph for it in self.speeds))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.cruise), throughout=True)

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(self.cruise), duration=2 * s),
            Wait(lambda: sum(it.speed > 1 * kph for it in self.fleet) > 0),
            Wait(
                lambda: next((index for index, it in enumerate(self.speeds) if it == 20 * kph), -1)
                == 1
                and self.half > 1.0
                and self.back == "highway"
            ),
            Wait(
                lambda: any(
                    it.object_distance(reference=self.npc, direction="euclidean") > 1 * m
                    for it in self.fleet
                )
                or len(self.slow) > 1
            ),
            Wait(lambda: self.ego.speed >= 0 * kph and 20 * kph in self.speeds),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Lists().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Lists))
