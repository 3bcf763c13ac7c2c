"""Scenario `signal_cycles`.

C17 Signal cycles: the lights of a group run through their phases by themselves.

Made by osc2tx from capabilities/C17_signal_cycles.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    TrafficLight,
    TrafficLightController,
    TrafficLightCycle,
    TrafficLightGroup,
    TrafficLightPhase,
    main,
    require_api,
)
from osc2tx_runtime.units import s

require_api(1)


class SignalCycles(Scenario):
    name = "signal_cycles"
    source = "capabilities/C17_signal_cycles.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="urban_crossing.xodr"))
        self.lights = self.cast("lights", TrafficLightController())
        self.east = self.argument("east", TrafficLight(map_id="101"))
        self.main_road = self.argument("main_road", TrafficLightGroup(map_id="1"))

        self.free = self.argument(
            "free",
            TrafficLightPhase(
                group=self.main_road,
                bulbs_state=self.east.semantic_state_to_state("go"),
                duration=3 * s,
            ),
        )
        self.closed = self.argument(
            "closed",
            TrafficLightPhase(
                group=self.main_road,
                bulbs_state=self.east.semantic_state_to_state("stop"),
                duration=5 * s,
            ),
        )
        self.cycle = self.argument("cycle", TrafficLightCycle(phases=[self.free, self.closed]))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.lights.play_cycles("run_by_itself", cycles=[self.cycle], duration=12 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SignalCycles().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SignalCycles))
