"""The actions of the library as methods of actors, for editors and type checkers.

One class per actor type with actions; `modifiers` names groups of modifiers.
tools/make_actor_methods.py writes them from the classes that execute the actions. These classes are
not imported here: a method calls the registry.
"""

from __future__ import annotations

from .animal import AnimalMethods
from .environment import EnvironmentMethods
from .movable_object import MovableObjectMethods
from .person import PersonMethods
from .traffic_light_controller import TrafficLightControllerMethods
from .vehicle import VehicleMethods

__all__ = [
    "AnimalMethods",
    "EnvironmentMethods",
    "MovableObjectMethods",
    "PersonMethods",
    "TrafficLightControllerMethods",
    "VehicleMethods",
]
