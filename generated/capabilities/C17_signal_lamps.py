"""Scenario `signal_lamps`.

C17 Signal lamps: a whole box, one lamp of it, and all boxes of a group.

Made by osc2tx from capabilities/C17_signal_lamps.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    TrafficLight,
    TrafficLightController,
    TrafficLightGroup,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.units import s

require_api(1)


class SignalLamps(Scenario):
    name = "signal_lamps"
    source = "capabilities/C17_signal_lamps.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="urban_crossing.xodr"))
        self.lights = self.cast("lights", TrafficLightController())
        self.east = self.argument("east", TrafficLight(map_id="101"))
        self.main_road = self.argument("main_road", TrafficLightGroup(map_id="1"))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.lights.set_state(traffic_light=self.east, state=["is_on", "is_off", "is_off"]),
            Wait(elapsed(1 * s)),
            self.lights.set_bulb_state(
                traffic_light=self.east, bulb_color="yellow", bulb_kind="circle", bulb_state="is_on"
            ),
            Wait(elapsed(1 * s)),
            self.lights.set_group_state(group=self.main_road, state=["is_off", "is_off", "is_on"]),
            Wait(elapsed(1 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SignalLamps().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SignalLamps))
