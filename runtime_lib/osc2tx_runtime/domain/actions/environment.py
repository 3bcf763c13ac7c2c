"""Environment actions: weather and light that last until changed again (DSL 8.11).

The standard lets them end "when the same type is invoked again", which would block a serial
forever; here they take no time, and their effect persists.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.planning.motion_action import note_lights
from osc2tx_runtime.language.actions.action import Action, ActionOptions
from osc2tx_runtime.language.actions.registry import action
from osc2tx_runtime.language.tree.base import Status
from osc2tx_shared.rules import at_least_one

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import Environment
    from osc2tx_runtime.domain.measuring.weather import CelestialLightSource

BOUNDS: Mapping[str, tuple[float, float, str]] = {
    "temperature": (0.0, math.inf, " K"),
    "pressure": (0.0, math.inf, " Pa"),
    "relative_humidity": (0.0, 1.0, ""),
    "rain_intensity": (0.0, math.inf, " m/s"),
    "snow_intensity": (0.0, math.inf, " m/s"),
    "wind_speed": (0.0, math.inf, " m/s"),
    "visual_range": (0.0, math.inf, " m"),
    "cloudiness": (0.0, 9.0, " okta"),  # 9: sky obscured
}
"""Least and greatest value of the environment, and its unit; angles are unlimited."""


class _Weather(Action):
    """Sets values of the environment; None leaves a value unchanged."""

    def __init__(
        self,
        actor: Environment,
        modifiers: tuple[Modifier, ...],
        values: dict[str, float | None],
        options: ActionOptions,
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.values = {name: value for name, value in values.items() if value is not None}
        self._refused: str | None = None

    def on_start(self) -> None:
        """Sets the values, if they are possible; values that depend on the world are known now."""
        values = {n: value() if callable(value) else value for n, value in self.values.items()}
        problems = (_impossible(name, value) for name, value in values.items())
        self._refused = next(filter(None, problems), None)
        if self._refused is not None:
            return
        for name, value in values.items():
            self.effect(f"environment {name}", value, partial(self._set, name, value))

    def on_update(self) -> Status:
        """Ends in the same step."""
        return Status.SUCCESS if self._refused is None else self.fail(self._refused)

    def _set(self, name: str, value: float) -> None:
        context = self.context
        switched = context.world.set_environment({name: value})
        context.trace.environment(**{name: value})
        for actor_id, lights in switched.items():
            note_lights(context, actor_id, lights)


def _impossible(name: str, value: float) -> str | None:
    """Why a value is impossible; None if it is possible."""
    least, most, unit = BOUNDS.get(name, (-math.inf, math.inf, ""))
    if least <= value <= most:
        return None
    bound = f"below {least:g}" if value < least else f"above {most:g}"
    return f"{name.replace('_', ' ')} {value:g}{unit} is {bound}{unit}"


@action("environment", "air", ends="instant", needs=("weather",))
class Air(_Weather):
    """Set temperature (K), pressure (Pa) and relative humidity (0 to 1)."""

    rules = (at_least_one("temperature", "pressure", "relative_humidity"),)

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        temperature: float | None = None,
        pressure: float | None = None,
        relative_humidity: float | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        values = {
            "temperature": temperature,
            "pressure": pressure,
            "relative_humidity": relative_humidity,
        }
        super().__init__(actor, modifiers, values, options)


@action("environment", "rain", ends="instant", needs=("weather",))
class Rain(_Weather):
    """Set the intensity of rain (m/s of water column)."""

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        intensity: float,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, {"rain_intensity": intensity}, options)


@action("environment", "snow", ends="instant", needs=("weather",))
class Snow(_Weather):
    """Set the intensity of snow (m/s of water column)."""

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        intensity: float,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, {"snow_intensity": intensity}, options)


@action("environment", "wind", ends="instant", needs=("weather",))
class Wind(_Weather):
    """Set speed (m/s) and direction (rad) of the wind."""

    rules = (at_least_one("speed", "direction"),)

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        speed: float | None = None,
        direction: float | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        values = {"wind_speed": speed, "wind_direction": direction}
        super().__init__(actor, modifiers, values, options)


@action("environment", "fog", ends="instant", needs=("weather",))
class Fog(_Weather):
    """Set the visual range (m)."""

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        visual_range: float,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, {"visual_range": visual_range}, options)


@action("environment", "clouds", ends="instant", needs=("weather",))
class Clouds(_Weather):
    """Set the cloud cover (okta)."""

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        cloudiness: float,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, {"cloudiness": cloudiness}, options)


@action("environment", "assign_celestial_position", ends="instant", needs=("weather",))
class AssignCelestialPosition(_Weather):
    """Set azimuth (rad from +y, clockwise) and elevation (rad) of the sun or the moon.

    Args:
        actor: The environment.
        *modifiers: None are taken.
        light_source: `env.sun` (default) or `env.moon`.
        azimuth: rad from +y, clockwise.
        elevation: rad above the horizon.
        **options: Duration and label.
    """

    rules = (at_least_one("azimuth", "elevation"),)

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        light_source: CelestialLightSource | None = None,
        azimuth: float | None = None,
        elevation: float | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        name = "sun" if light_source is None else light_source.name
        values = {f"{name}_azimuth": azimuth, f"{name}_elevation": elevation}
        super().__init__(actor, modifiers, values, options)
