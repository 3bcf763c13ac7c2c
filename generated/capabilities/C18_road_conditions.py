"""Scenario `road_conditions`.

C18 Road conditions: snow on the road takes grip away. The same full braking takes 2.7 s on a dry
road and three times as long on snow.

Made by osc2tx from capabilities/C18_road_conditions.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Environment,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mmph, mps, mpss, s

require_api(1)


class RoadConditions(Scenario):
    name = "road_conditions"
    source = "capabilities/C18_road_conditions.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.env = self.cast("env", Environment())
        self.ego = self.cast("ego", Vehicle())

        self.v_full = self.parameter("v_full", 15 * mps, unit="mps")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(self.v_full))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(self.v_full), duration=1 * s),
            self.ego.change_speed("dry", target=0 * mps, rate_profile="asap"),
            self.ego.change_speed(
                "gain", target=self.v_full, rate_profile="constant", rate_peak=3 * mpss
            ),
            self.env.snow(intensity=2 * mmph),
            self.ego.change_speed("slippery", target=0 * mps, rate_profile="asap"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RoadConditions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RoadConditions))
