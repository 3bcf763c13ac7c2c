"""Actions of the actor type `environment`; made by tools/make_actor_methods.py."""

# The registry executes these declarations.
# mypy: disable-error-code="empty-body"

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.language.actions.registry import carried_out

if TYPE_CHECKING:
    from osc2tx_runtime.domain.measuring.weather import CelestialLightSource
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.language.tree.duration_limits import Duration


@carried_out
class EnvironmentMethods:
    """Actions of the actor type `environment`."""

    def air(
        self,
        label: str | None = None,
        /,
        *,
        temperature: float | None = None,
        pressure: float | None = None,
        relative_humidity: float | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Set temperature (K), pressure (Pa) and relative humidity (0 to 1) (§8.11.2)."""

    def assign_celestial_position(
        self,
        label: str | None = None,
        /,
        *,
        light_source: CelestialLightSource | None = None,
        azimuth: float | None = None,
        elevation: float | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Set azimuth (rad from +y, clockwise) and elevation (rad) of the sun or the moon.

        Section §8.11.8.

        Args:
            *modifiers: None are taken.
            light_source: `env.sun` (default) or `env.moon`.
            azimuth: rad from +y, clockwise.
            elevation: rad above the horizon.
        """

    def clouds(
        self, label: str | None = None, /, *, cloudiness: float, duration: Duration | None = None
    ) -> Behaviour:
        """Set the cloud cover (okta); 9 is an obscured sky (§8.11.7)."""

    def fog(
        self, label: str | None = None, /, *, visual_range: float, duration: Duration | None = None
    ) -> Behaviour:
        """Set the visual range (m) (§8.11.6)."""

    def rain(
        self, label: str | None = None, /, *, intensity: float, duration: Duration | None = None
    ) -> Behaviour:
        """Set the intensity of rain (m/s of water column) (§8.11.3)."""

    def snow(
        self, label: str | None = None, /, *, intensity: float, duration: Duration | None = None
    ) -> Behaviour:
        """Set the intensity of snow (m/s of water column) (§8.11.4)."""

    def wind(
        self,
        label: str | None = None,
        /,
        *,
        speed: float | None = None,
        direction: float | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Set speed (m/s) and direction (rad) of the wind (§8.11.5)."""
