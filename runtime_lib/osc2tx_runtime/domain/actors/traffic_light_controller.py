"""The traffic light controller actor (DSL 8.15.8)."""

from __future__ import annotations

from osc2tx_runtime.domain.methods import TrafficLightControllerMethods
from osc2tx_runtime.domain.objects.base import Actor


class TrafficLightController(Actor, TrafficLightControllerMethods):
    """Switches traffic lights."""

    kinds = ("traffic_light_controller", *Actor.kinds)
