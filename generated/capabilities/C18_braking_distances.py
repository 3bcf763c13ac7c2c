"""Scenario `braking_distances`.

C18 Road conditions: the way a car needs to stop from 15 m/s with all its force: on a dry road, in
rain, on snow, and on the ice that rain makes below zero.

Made by osc2tx from capabilities/C18_braking_distances.osc: edit the scenario, not this module.
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
from osc2tx_runtime.units import celsius, m, mmph, mps, s

require_api(1)


class BrakingDistances(Scenario):
    name = "braking_distances"
    source = "capabilities/C18_braking_distances.osc"

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
            self.ego.assign_speed(speed=self.v_full),
            self.env.rain(intensity=5 * mmph),
            self.ego.drive(duration=1 * s),
            self.ego.change_speed("wet", target=0 * mps, rate_profile="asap"),
            self.ego.assign_speed(speed=self.v_full),
            self.env.rain(intensity=0 * mmph),
            self.env.snow(intensity=2 * mmph),
            self.ego.drive(duration=1 * s),
            self.ego.change_speed("snowy", target=0 * mps, rate_profile="asap"),
            self.ego.assign_speed(speed=self.v_full),
            self.env.snow(intensity=0 * mmph),
            self.env.air(temperature=celsius(-3)),
            self.env.rain(intensity=1 * mmph),
            self.ego.drive(duration=1 * s),
            self.ego.change_speed("icy", target=0 * mps, rate_profile="asap"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return BrakingDistances().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(BrakingDistances))
