"""Scenario `weather_control`.

C16 Weather control: rain, fog, wind, snow, clouds and air change while a car drives; what an
action does not name stays as it was.

Made by osc2tx from capabilities/C16_weather.osc: edit the scenario, not this module.
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
from osc2tx_runtime.units import celsius, deg, hPa, kph, m, mmph, mps, s

require_api(1)


class WeatherControl(Scenario):
    name = "weather_control"
    source = "capabilities/C16_weather.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.env = self.cast("env", Environment())
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(speed(20 * mps), duration=6 * s),
            self._env_air_then_clouds(),
        )

    def _env_air_then_clouds(self) -> Behaviour:
        return Serial(
            "env: serial",
            self.env.air(temperature=celsius(12), pressure=1010 * hPa, relative_humidity=0.9),
            self.env.clouds(cloudiness=7),
            Wait(elapsed(2 * s)),
            self.env.rain(intensity=5 * mmph),
            self.env.wind(speed=36 * kph, direction=270 * deg),
            Wait(elapsed(2 * s)),
            self.env.rain(intensity=0 * mmph),
            self.env.snow(intensity=1 * mmph),
            self.env.fog(visual_range=150 * m),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return WeatherControl().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(WeatherControl))
