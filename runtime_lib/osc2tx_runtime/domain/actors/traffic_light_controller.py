"""Who switches traffic lights (DSL 8.15.8)."""

from __future__ import annotations

from .base import Actor
from .methods import TrafficLightControllerMethods

__all__ = ["TrafficLightController"]


class TrafficLightController(Actor, TrafficLightControllerMethods):
    """Switches traffic lights."""

    kinds = ("traffic_light_controller", *Actor.kinds)
