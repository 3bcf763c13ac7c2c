"""The classes of the runtime library that generated modules name, and their constructors.

The compiler does not import the runtime; a test compares these tables with the runtime.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

API_LEVEL = 1

# Class of an actor -> the type of its keywords, in `osc2tx_runtime.fields`.
ACTOR_FIELDS = {
    "Actor": "ActorFields",
    "Animal": "ParticipantFields",
    "Environment": "EnvironmentFields",
    "Map": "MapFields",
    "MovableObject": "ObjectFields",
    "Person": "ParticipantFields",
    "PhysicalObject": "ObjectFields",
    "StationaryObject": "ObjectFields",
    "TrafficLightController": "ActorFields",
    "Trailer": "TrailerFields",
    "Vehicle": "VehicleFields",
}

# Type of the standard library that no object is of alone -> the next one above it with a class.
ABSTRACT_TYPES = {"route_element": "route", "traffic_participant": "movable_object"}

# Members that are texts in a dialect and enums elsewhere, with the class of such texts.
TEXTS: Mapping[tuple[str, str], str] = {("physical_object", "color"): "Rgb"}

# Python types of simple values, by their kind.
ANNOTATIONS = {"bool": "bool", "int": "int", "float": "float", "quantity": "float"} | {
    "string": "str"
}


# Physical types of the library to their names in `osc2tx_runtime.units`.
PHYSICAL_TYPES = {
    "length": "Length",
    "time": "Time",
    "speed": "Speed",
    "acceleration": "Acceleration",
    "jerk": "Jerk",
    "angle": "Angle",
    "angular_rate": "AngularRate",
    "angular_acceleration": "AngularAcceleration",
    "mass": "Mass",
    "temperature": "Temperature",
    "pressure": "Pressure",
    "luminous_intensity": "LuminousIntensity",
    "luminous_flux": "LuminousFlux",
    "illuminance": "Illuminance",
    "electrical_current": "ElectricalCurrent",
    "amount_of_substance": "AmountOfSubstance",
}


def text_class(lineage: Sequence[str], member: str) -> str | None:
    """Return the class of the runtime for a text where the library has an enum."""
    found = (TEXTS.get((type_, member)) for type_ in lineage)
    return next((name for name in found if name is not None), None)
