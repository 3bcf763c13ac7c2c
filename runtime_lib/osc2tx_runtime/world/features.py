"""What a world may have beside moving actors."""

from __future__ import annotations

from typing import Literal, get_args

__all__ = ["FEATURES", "Feature"]

Feature = Literal["lanes", "lights", "map", "towing", "traffic_lights", "weather"]
"""What an action or modifier may need of a world."""

FEATURES: frozenset[Feature] = frozenset(get_args(Feature))
