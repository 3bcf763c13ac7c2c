"""The traffic light controller actor (DSL 8.15.8)."""

from __future__ import annotations

from .base import Actor

__all__ = ["TrafficLightController"]


class TrafficLightController(Actor):
    """Switches traffic lights."""

    kinds = ("traffic_light_controller", *Actor.kinds)
