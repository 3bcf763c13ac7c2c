"""The environment actor (DSL 8.10.2)."""

from __future__ import annotations

from datetime import datetime as calendar
from datetime import timedelta, timezone
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.domain.measuring.weather import (
    CelestialLightSource,
    CelestialPosition,
    GeodeticPosition,
    Weather,
    celestial_position,
    weather_of,
)
from osc2tx_runtime.domain.methods import EnvironmentMethods
from osc2tx_runtime.domain.objects.base import Actor
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.surroundings.sun_and_moon import Sky

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext


class Environment(Actor, EnvironmentMethods):
    """Weather and light.

    Args:
        name: Role name.
        geodetic_position: The origin of the world on the globe.
        datetime: Unix time (s) when the scenario starts.

    Attributes:
        sun: The sun; its position, and the argument of `assign_celestial_position`.
        moon: The moon, likewise.
    """

    kinds = ("environment", *Actor.kinds)
    one_per_run = True

    def __init__(
        self,
        *,
        name: str | None = None,
        geodetic_position: GeodeticPosition | None = None,
        datetime: float | None = None,
    ) -> None:
        super().__init__(name=name)
        self._geodetic_position = geodetic_position
        self._datetime = datetime
        self.sun = CelestialLightSource(lambda: self._place_of("sun"), "sun")
        self.moon = CelestialLightSource(lambda: self._place_of("moon"), "moon")

    def bind(self, context: ExecutionContext) -> None:
        """Joins a run; place and time determine sun and moon until an action sets them."""
        super().bind(context)
        if self._geodetic_position is not None and self._datetime is not None:
            place = self._geodetic_position
            context.world.begin_under(Sky(place.latitude, place.longitude, self._datetime))

    @property
    def geodetic_position(self) -> GeodeticPosition:
        """The origin of the world on the globe.

        Raises:
            ScenarioError: The scenario does not state it.
        """
        if self._geodetic_position is None:
            raise ScenarioError(f"the geodetic_position of {self.id} is not stated", self.source)
        return self._geodetic_position

    @property
    def datetime(self) -> float:
        """Unix time (s) when the scenario starts.

        Raises:
            ScenarioError: The scenario does not state it.
        """
        if self._datetime is None:
            raise ScenarioError(f"the datetime of {self.id} is not stated", self.source)
        return self._datetime

    @property
    def weather(self) -> Weather:
        """The weather at the present step."""
        return weather_of(self.context.world.environment())

    def _place_of(self, source: Literal["sun", "moon"]) -> CelestialPosition:
        return celestial_position(source, self.context.world.environment())

    @staticmethod
    def local_to_unix_time(
        year: int,
        month: int,
        day: int,
        hour: int,
        minute: int,
        second: int,
        time_zone: float,
    ) -> float:
        """Unix time (s) of a local date and time (DSL 8.10.2.1.1); time zone in hours east of UTC.

        Raises:
            ScenarioError: The date, time or zone is invalid.
        """
        try:
            zone = timezone(timedelta(hours=time_zone))
            local = calendar(year, month, day, hour, minute, second, tzinfo=zone)
            return local.timestamp()
        except ValueError as error:
            raise ScenarioError(f"local_to_unix_time: {error}") from None
