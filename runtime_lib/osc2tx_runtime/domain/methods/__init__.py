"""The actions of the library as methods of actors, for editors and type checkers.

A class for each kind of actors that has actions; `modifiers` names groups of modifiers. All of it
is made by tools/make_actor_methods.py from the classes that carry the actions out. These are not
imported here: a method asks the registry.
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
