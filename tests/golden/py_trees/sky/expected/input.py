"""Scenario `sky`.

Sun, rain and places as values of structs.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    CelestialPosition,
    Environment,
    GeodeticPosition,
    Map,
    Precipitation,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    main,
    require_api,
)
from osc2tx_runtime.units import deg, mmph, s

require_api(1)


class Sky(Scenario):
    name = "sky"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.home = self.argument("home", GeodeticPosition(latitude=48 * deg, longitude=11 * deg))
        self.env = self.cast("env", Environment(geodetic_position=self.home))
        self.s = self.argument("s", self.env.sun)
        self.drizzle = self.argument("drizzle", Precipitation(intensity=1 * mmph))
        self.dusk = self.argument("dusk", CelestialPosition(elevation=2 * deg, azimuth=270 * deg))
        self.ego = self.cast("ego", Vehicle())

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(duration=1 * s),
            self.env.assign_celestial_position(
                light_source=self.s, azimuth=self.dusk.azimuth, elevation=self.dusk.elevation
            ),
            self.env.rain(intensity=self.drizzle.intensity),
            Wait(
                lambda: self.env.sun.position == self.dusk and self.env.weather.rain == self.drizzle
            ),
            Wait(lambda: self.s.position.elevation <= self.env.geodetic_position.latitude),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Sky().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Sky))
