"""Defaults for parts of actors that a scenario does not state, by category, kind and model.

Axles and hitches have typical values, as none are published per category: as wide as the box
allows, at the positions given by the shape of the vehicle.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from osc2tx_runtime.domain.objects.parts import Axle, HitchCoupler, HitchReceiver
from osc2tx_runtime.enums import (
    HitchType,
    IntendedInfrastructure,
    TrafficParticipantRole,
    TrailerCategory,
)
from osc2tx_runtime.world.actor_dimensions import MAX_STEERING, Shape
from osc2tx_runtime.world.motion.towing import DRAWBAR

_TRACK = 0.9
"""Share of the width of a vehicle between its outer wheels."""


class _Wheels(NamedTuple):
    """Wheels of a category: diameter (m), number on the front axle and on the rear axle."""

    diameter: float
    front: int = 2
    rear: int = 2


_WHEELS: Mapping[str, _Wheels] = {
    "car": _Wheels(0.6),
    "van": _Wheels(0.7),
    "bus": _Wheels(1.0, 2, 4),
    "heavy_truck": _Wheels(1.0, 2, 4),
    "truck": _Wheels(1.0, 2, 4),
    "semi_tractor": _Wheels(1.0, 2, 4),
    "semi_trailer": _Wheels(1.0),
    "trailer": _Wheels(0.8),
    "motorcycle": _Wheels(0.6, 1, 1),
    "bicycle": _Wheels(0.7, 1, 1),
    "micro_mobility_device": _Wheels(0.2, 1, 1),
    "vru_vehicle": _Wheels(0.7, 1, 1),
    "stand_up_scooter": _Wheels(0.2, 1, 1),
    "wheelchair": _Wheels(0.6),
    "work_machine": _Wheels(1.2),
    "train": _Wheels(0.9),
    "tram": _Wheels(0.6),
}

_HITCH_HEIGHT = {"ball": 0.4, "pintle": 0.8, "fifth_wheel": 1.2}
"""Metres of a hitch above the ground, by its type."""

# `intended_infrastructure` (8.7.19), the usual one first.
_INFRASTRUCTURE: Mapping[str, tuple[IntendedInfrastructure, ...]] = {
    "person": ("sidewalk",),
    "animal": ("sidewalk",),
    "wheelchair": ("sidewalk",),
    "bicycle": ("biking", "driving"),
    "micro_mobility_device": ("biking", "driving"),
    "stand_up_scooter": ("biking", "driving"),
    "vru_vehicle": ("biking", "driving"),
    "bus": ("driving", "bus"),
    "train": ("rail",),
    "tram": ("tram",),
}

_ROLES: Mapping[str, TrafficParticipantRole] = {
    "vehicle.carlamotors.firetruck": "fire",
    "vehicle.dodge.charger_police": "police",
    "vehicle.ford.ambulance": "ambulance",
}


def default_axles(category: str, shape: Shape) -> tuple[Axle, ...]:
    """Return the axles of a vehicle from front to rear; a trailer only has the rear axle."""
    wheels = _WHEELS.get(category, _WHEELS["car"])
    track = 0.0 if wheels.rear == 1 else round(_TRACK * shape.width, 3)
    height = 0.5 * wheels.diameter
    rear = Axle(0.0, wheels.diameter, track, 0.0, height, wheels.rear)
    if category in ("trailer", "semi_trailer"):
        return (rear,)
    front = Axle(MAX_STEERING, wheels.diameter, track, shape.wheelbase, height, wheels.front)
    return front, rear


def default_receiver(shape: Shape, said: HitchType) -> HitchReceiver:
    """Return the hitch of a vehicle: at its rear end, of the declared type."""
    return HitchReceiver(said, -shape.rear, _HITCH_HEIGHT.get(said, _HITCH_HEIGHT["ball"]))


def default_coupler(category: str, shape: Shape, said: HitchType | None) -> HitchCoupler:
    """Return the coupler of a trailer: before the box, of the declared type."""
    kind: HitchType = said or ("fifth_wheel" if category == "semi_trailer" else "ball")
    height = _HITCH_HEIGHT.get(kind, _HITCH_HEIGHT["ball"])
    return HitchCoupler(kind, shape.front + DRAWBAR, height)


def misfit(receiver: HitchReceiver, coupler: HitchCoupler) -> str | None:
    """Return why the halves of a hitch cannot be coupled (8.7.13); None if they can be coupled.

    Args:
        receiver: As stated in the scenario; an open type fits.
        coupler: Likewise.
    """
    types = receiver.hitch_type, coupler.hitch_type
    if types[0] == types[1] or types[0] == "none" or types[1] is None:
        return None
    return f"a {types[1]} coupler does not fit a {types[0]} receiver"


def default_infrastructure(category: str) -> tuple[IntendedInfrastructure, ...]:
    """Return the infrastructure of a category of vehicles or a kind of actors."""
    return _INFRASTRUCTURE.get(category, ("driving",))


def default_role(model: str | None) -> TrafficParticipantRole | None:
    """Return the role of a model that has only one."""
    return None if model is None else _ROLES.get(model)


def default_trailer_category(category: str) -> TrailerCategory | None:
    """Return the category of a trailer that follows from the category of a vehicle."""
    return "semi_trailer" if category == "semi_trailer" else None
