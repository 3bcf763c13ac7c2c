"""Scenario `weather_readings`.

C16 Weather readings: rain, fog and wind are conditions, and are noted when they trigger; date and
place say how high the sun stands, until an action puts it elsewhere.

Made by osc2tx from capabilities/C16_weather_readings.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Environment,
    Event,
    GeodeticPosition,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    Wind,
    elapsed,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import deg, kph, m, mmph, mps, mpsps, s

require_api(1)


class WeatherReadings(Scenario):
    name = "weather_readings"
    source = "capabilities/C16_weather_readings.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.env = self.cast(
            "env",
            Environment(
                # A summer evening in Munich, 20 June 2024 at 19:00 UTC
                datetime=1718910000 * s,
                geodetic_position=GeodeticPosition(latitude=48.137 * deg, longitude=11.575 * deg),
            ),
        )
        self.ego = self.cast("ego", Vehicle())

        # A wind to beware of
        self.storm = self.argument("storm", Wind(speed=15 * mps, direction=270 * deg))

        self.wet = Event(rise(lambda: self.env.weather.rain.intensity > 2 * mmph))
        self.hidden = Event(rise(lambda: self.env.weather.fog.visual_range < 100 * m))
        self.stormy = Event(rise(lambda: self.env.weather.wind.speed >= self.storm.speed))
        self.rain = self.sample(lambda: self.env.weather.rain.intensity, self.wet, 0 * mmph)
        self.sight = self.sample(lambda: self.env.weather.fog.visual_range, self.hidden, 1000 * m)
        self.from_west = self.sample(
            lambda: self.env.weather.wind.direction - self.storm.direction, self.stormy, 0 * deg
        )
        self.sun = self.sample(lambda: self.env.sun.position.elevation, self.wet, 0 * deg)
        self.low_sun = self.sample(lambda: self.env.sun.position.elevation, self.hidden, 0 * deg)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_drive_then_change_speed(),
            self._env_rain_then_assign_celestial_position(),
        )

    def _ego_drive_then_change_speed(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive(speed(20 * mps)),
                self.wet,
            ),
            self.ego.change_speed(target=15 * mps, rate_profile="constant", rate_peak=2.5 * mpsps),
            Until(
                self.ego.drive(),
                self.hidden,
            ),
            self.ego.change_speed(target=10 * mps, rate_profile="constant", rate_peak=2.5 * mpsps),
            Until(
                self.ego.drive(),
                self.stormy,
            ),
            self.ego.change_speed(target=5 * mps, rate_profile="constant", rate_peak=2.5 * mpsps),
        )

    def _env_rain_then_assign_celestial_position(self) -> Behaviour:
        return Serial(
            "env: serial",
            Wait(elapsed(1 * s)),
            self.env.rain(intensity=1 * mmph),
            Wait(elapsed(1 * s)),
            self.env.rain(intensity=5 * mmph),
            Wait(elapsed(3 * s)),
            self.env.assign_celestial_position(light_source=self.env.sun, elevation=3 * deg),
            Wait(lambda: self.env.sun.position.elevation < 4 * deg),
            self.env.fog(visual_range=60 * m),
            Wait(elapsed(3 * s)),
            self.env.wind(speed=54 * kph, direction=280 * deg),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return WeatherReadings().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(WeatherReadings))
