"""Scenario `signal_conditions`.

C17 Signal conditions: what a light shows starts something else: the lamps it has to show, and what
they mean.

Made by osc2tx from capabilities/C17_signal_conditions.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    TrafficLight,
    TrafficLightController,
    TrafficLightGroup,
    Wait,
    elapsed,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.units import s

require_api(1)


class SignalConditions(Scenario):
    name = "signal_conditions"
    source = "capabilities/C17_signal_conditions.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="urban_crossing.xodr"))
        self.lights = self.cast("lights", TrafficLightController())
        self.east = self.argument("east", TrafficLight(map_id="101"))
        self.main_road = self.argument("main_road", TrafficLightGroup(map_id="1"))

        self.green = Event(
            rise(lambda: self.east.state_equal(bulbs=self.east.semantic_state_to_state("go")))
        )
        self.all_red = Event(
            rise(
                lambda: self.main_road.state_equal(bulbs=self.east.semantic_state_to_state("stop"))
            )
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._lights_set_semantic_state_then_set_group_bulb_state(),
            self._wait_serial(),
        )

    def _lights_set_semantic_state_then_set_group_bulb_state(self) -> Behaviour:
        return Serial(
            "lights: serial",
            self.lights.set_semantic_state(traffic_light=self.east, state="stop"),
            Wait(elapsed(2 * s)),
            self.lights.set_semantic_state(traffic_light=self.east, state="go"),
            Wait(elapsed(1 * s)),
            self.lights.set_group_bulb_state(
                traffic_light=self.east, bulb_color="green", bulb_kind="circle", bulb_state="is_off"
            ),
            self.lights.set_group_bulb_state(
                traffic_light=self.east, bulb_color="red", bulb_kind="circle", bulb_state="is_on"
            ),
        )

    def _wait_serial(self) -> Behaviour:
        return Serial(
            "serial",
            Wait(self.green),
            Wait(self.all_red),
            Wait(elapsed(1 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SignalConditions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SignalConditions))
