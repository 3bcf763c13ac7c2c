"""Actors of the domain model: what a scenario declares, reads and calls.

Constructor keywords are the fields a scenario may fix. Live fields and methods read the snapshot
of the present step. Everything else one calls on an actor is an action: `Actor.__getattr__` finds
it in the registry.
"""

from __future__ import annotations

from osc2tx_runtime.domain.measuring.weather import CelestialLightSource
from osc2tx_runtime.domain.routes.route_position import RoutePosition
from osc2tx_runtime.domain.values import OdrPoint, Orientation, Point, Pose

from .base import Actor
from .controllers import TrafficLightController
from .environment import Environment
from .map import Map
from .objects import (
    Animal,
    MovableObject,
    Person,
    PhysicalObject,
    StationaryObject,
    TrafficParticipant,
)
from .vehicles import Trailer, Vehicle

__all__ = [
    "Actor",
    "Animal",
    "CelestialLightSource",
    "Environment",
    "Map",
    "MovableObject",
    "OdrPoint",
    "Orientation",
    "Person",
    "PhysicalObject",
    "Point",
    "Pose",
    "RoutePosition",
    "StationaryObject",
    "TrafficLightController",
    "TrafficParticipant",
    "Trailer",
    "Vehicle",
]
