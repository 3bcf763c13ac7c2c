"""Environment actions: weather and light that last until changed again (DSL 8.11).

The standard lets them end "when the same type is invoked again", which would block a serial
forever; here they take no time, and their effect persists.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.planning.motion_action import note_lights
from osc2tx_runtime.language.actions.action import Action, ActionOptions
from osc2tx_runtime.language.actions.argument_rules import GivenValues
from osc2tx_runtime.language.actions.registry import action
from osc2tx_runtime.language.tree.base import Status
from osc2tx_shared.rules import at_least, at_least_one, at_most, violations

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import Environment
    from osc2tx_runtime.domain.measuring.weather import CelestialLightSource


class _Weather(Action):
    """Sets quantities of the environment.

    Args:
        actor: The environment.
        modifiers: None are taken.
        values: By parameter; None leaves a value unchanged.
        options: Duration and label.
        of: What names of parameters lack to be those of quantities.
    """

    def __init__(
        self,
        actor: Environment,
        modifiers: tuple[Modifier, ...],
        values: dict[str, float | None],
        options: ActionOptions,
        of: str = "",
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.values = {name: value for name, value in values.items() if value is not None}
        self._of = of
        self._refused: str | None = None

    def on_start(self) -> None:
        """Sets the values, if they are possible; values that depend on the world are known now."""
        values = {n: value() if callable(value) else value for n, value in self.values.items()}
        broken = next(violations("it", type(self).rules, GivenValues(values)), None)
        if broken is not None:
            self._refused = broken.text
            return
        for parameter, value in values.items():
            name = f"{self._of}{parameter}"
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


@action("environment", "air", ends="instant", needs=("weather",))
class Air(_Weather):
    """Set temperature (K), pressure (Pa) and relative humidity (0 to 1)."""

    rules = (
        at_least_one("temperature", "pressure", "relative_humidity"),
        at_least(0, "temperature", "pressure", "relative_humidity"),
        at_most(1, "relative_humidity"),
    )

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

    rules = (at_least(0, "intensity"),)

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        intensity: float,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, {"intensity": intensity}, options, of="rain_")


@action("environment", "snow", ends="instant", needs=("weather",))
class Snow(_Weather):
    """Set the intensity of snow (m/s of water column)."""

    rules = (at_least(0, "intensity"),)

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        intensity: float,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, {"intensity": intensity}, options, of="snow_")


@action("environment", "wind", ends="instant", needs=("weather",))
class Wind(_Weather):
    """Set speed (m/s) and direction (rad) of the wind."""

    rules = (at_least_one("speed", "direction"), at_least(0, "speed"))

    def __init__(
        self,
        actor: Environment,
        *modifiers: Modifier,
        speed: float | None = None,
        direction: float | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        values = {"speed": speed, "direction": direction}
        super().__init__(actor, modifiers, values, options, of="wind_")


@action("environment", "fog", ends="instant", needs=("weather",))
class Fog(_Weather):
    """Set the visual range (m)."""

    rules = (at_least(0, "visual_range"),)

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
    """Set the cloud cover (okta); 9 is an obscured sky."""

    rules = (at_most(9, "cloudiness"),)

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
        values = {"azimuth": azimuth, "elevation": elevation}
        super().__init__(actor, modifiers, values, options, of=f"{name}_")
