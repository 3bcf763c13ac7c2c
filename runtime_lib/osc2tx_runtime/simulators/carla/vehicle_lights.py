"""Lights of vehicles as CARLA's flags."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx_runtime.world.protocol import LightMode

__all__ = ["FLAGS"]

POSITION, LOW_BEAM, HIGH_BEAM = 1, 2, 4

FLAGS: Mapping[LightMode, int] = {
    "off": 0,
    "daytime": POSITION,  # CARLA has no daytime running lights
    "position": POSITION,
    "low_beam": POSITION | LOW_BEAM,
    "high_beam": POSITION | LOW_BEAM | HIGH_BEAM,
}
"""Flags of `carla.VehicleLightState` by what shines."""
