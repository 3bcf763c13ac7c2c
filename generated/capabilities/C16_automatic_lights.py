"""Scenario `automatic_lights`.

C16 Weather control: automatic lights. They are low beams while the sun stands lower than 15 degrees
or fog leaves less than 100 m to see, and out otherwise. A car with its lights switched off stays
dark.

Made by osc2tx from capabilities/C16_automatic_lights.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Environment,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import deg, km, m, mps, s

require_api(1)


class AutomaticLights(Scenario):
    name = "automatic_lights"
    source = "capabilities/C16_automatic_lights.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.env = self.cast("env", Environment())
        self.ego = self.cast("ego", Vehicle())
        self.dark = self.cast("dark", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))
        self.place(self.dark, lane(1), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(20 * mps)),
            self.dark.drive(speed(20 * mps)),
            self._env_then_ego(),
            duration=9 * s,
        )

    def _env_then_ego(self) -> Behaviour:
        return Serial(
            "serial",
            self.env.assign_celestial_position(light_source=self.env.sun, elevation=40 * deg),
            self.ego.set_lights(mode="auto"),
            self.dark.set_lights(mode="off"),
            Wait(elapsed(1 * s)),
            self.env.assign_celestial_position(light_source=self.env.sun, elevation=15.1 * deg),
            Wait(elapsed(1 * s)),
            self.env.assign_celestial_position(
                "dusk", light_source=self.env.sun, elevation=14.9 * deg
            ),
            Wait(elapsed(1 * s)),
            self.env.assign_celestial_position(
                "night", light_source=self.env.sun, elevation=-20 * deg
            ),
            Wait(elapsed(1 * s)),
            self.env.assign_celestial_position(
                "morning", light_source=self.env.sun, elevation=20 * deg
            ),
            Wait(elapsed(1 * s)),
            self.env.fog("haze", visual_range=100 * m),
            Wait(elapsed(1 * s)),
            self.env.fog("fog", visual_range=99 * m),
            Wait(elapsed(1 * s)),
            self.env.fog("clear", visual_range=2 * km),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AutomaticLights().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AutomaticLights))
