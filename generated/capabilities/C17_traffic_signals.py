"""Scenario `traffic_signals`.

C17 Traffic signals: a light is red and turns green; the car stops before the line and drives on.
The lights across change as a group.

Made by osc2tx from capabilities/C17_traffic_signals.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    TrafficLight,
    TrafficLightController,
    TrafficLightGroup,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import avoid_collisions, lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class TrafficSignals(Scenario):
    name = "traffic_signals"
    source = "capabilities/C17_traffic_signals.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="urban_crossing.xodr"))
        self.lights = self.cast("lights", TrafficLightController())
        self.ego = self.cast("ego", Vehicle())
        self.ahead = self.argument("ahead", TrafficLight(map_id="101"))
        self.across = self.argument("across", TrafficLightGroup(map_id="2"))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(10 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._lights_set_semantic_state_then_set_group_semantic_state(),
            self.ego.drive(speed(12 * mps), avoid_collisions(True), duration=20 * s),
        )

    def _lights_set_semantic_state_then_set_group_semantic_state(self) -> Behaviour:
        return Serial(
            "lights: serial",
            self.lights.set_semantic_state(traffic_light=self.ahead, state="stop"),
            self.lights.set_group_semantic_state(traffic_light_group=self.across, state="go"),
            Wait(elapsed(14 * s)),
            self.lights.set_group_semantic_state(traffic_light_group=self.across, state="stop"),
            self.lights.set_semantic_state(traffic_light=self.ahead, state="go"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return TrafficSignals().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(TrafficSignals))
