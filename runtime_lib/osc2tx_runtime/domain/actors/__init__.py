"""Actors of the domain model: their fields, methods and actions.

Constructor keywords are the fields that a scenario may state. Live fields and methods read the
snapshot of the present step. All other calls on an actor are actions: `methods` declares those of
the library, the registry executes them.
"""

from __future__ import annotations

from osc2tx_runtime.domain.measuring.object_position import RoutePosition
from osc2tx_runtime.domain.measuring.weather import CelestialLightSource
from osc2tx_runtime.domain.objects.base import Actor
from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject, StationaryObject
from osc2tx_runtime.domain.points_and_poses import OdrPoint, Orientation, Point, Pose

from .environment import Environment
from .map import Map, TrafficLightController
from .movable_objects import Animal, MovableObject, Person, TrafficParticipant
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
