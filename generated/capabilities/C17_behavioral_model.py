"""Scenario `behavioral_models`.

C17 Drivers that obey: while no action controls it, a car that is left to a careful driver stops at
the red light and waits; another model takes it through.

Made by osc2tx from capabilities/C17_behavioral_model.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    BehavioralModel,
    Behaviour,
    BmEngine,
    Call,
    Map,
    Scenario,
    Serial,
    TrafficLight,
    TrafficLightController,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class BehavioralModels(Scenario):
    name = "behavioral_models"
    source = "capabilities/C17_behavioral_model.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="urban_crossing.xodr"))
        self.lights = self.cast("lights", TrafficLightController())
        self.careful = self.argument(
            "careful", BehavioralModel(bm_engine=BmEngine(name="careful_driver"))
        )
        self.steady = self.argument(
            "steady", BehavioralModel(bm_engine=BmEngine(name="steady_driver"))
        )
        self.ego = self.cast("ego", Vehicle(initial_bm=self.careful))
        self.ahead = self.argument("ahead", TrafficLight(map_id="101"))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(10 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.lights.set_semantic_state(traffic_light=self.ahead, state="stop"),
            # The action ends, and the driver goes on by itself.
            self.ego.drive(speed(12 * mps), duration=1 * s),
            Wait(lambda: self.ego.speed == 0 * mps),
            Wait(elapsed(2 * s)),
            Call(lambda: self.ego.set_bm(self.steady)),
            self.ego.change_speed(target=6 * mps),
            Wait(elapsed(5 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return BehavioralModels().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(BehavioralModels))
