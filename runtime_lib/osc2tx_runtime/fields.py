"""The keywords of the constructors of actors, for the types of actors that derive from them.

A generated class takes `**fields: Unpack[VehicleFields]`, so that a type checker knows them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypedDict

from osc2tx_runtime.domain.actors.movable_objects import ParticipantFields
from osc2tx_runtime.domain.actors.vehicles import TrailerFields, VehicleFields
from osc2tx_runtime.domain.measuring.weather import GeodeticPosition
from osc2tx_runtime.domain.objects.physical_objects import ObjectFields
from osc2tx_runtime.domain.signals.traffic_lights import TrafficLightCycle
from osc2tx_runtime.enums import DrivingRule

__all__ = [
    "ActorFields",
    "EnvironmentFields",
    "MapFields",
    "ObjectFields",
    "ParticipantFields",
    "TrailerFields",
    "VehicleFields",
]


class ActorFields(TypedDict, total=False):
    """Keywords of `Actor`."""

    name: str | None


class EnvironmentFields(ActorFields, total=False):
    """Keywords of `Environment`."""

    geodetic_position: GeodeticPosition | None
    datetime: float | None


class MapFields(ActorFields, total=False):
    """Keywords of `Map`."""

    map_file: str | None
    driving_rule: DrivingRule | None
    traffic_light_control: Sequence[TrafficLightCycle]
