"""What vehicles are and whom they serve, as literals of the XML."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, cast

from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc.literals import Role, VehicleCategory
from osc2tx.xosc.schema import literals

HARMONIZED = "1.4"
"""First version whose literals are those of the DSL; it deprecates the older ones."""


class _Category(NamedTuple):
    """A literal.

    Attributes:
        literal: From 1.4 on.
        older: Before; `None` if vehicles of this kind could not be said.
        is_lossy: The older one is about other vehicles, too.
        instead: What is exact with the older ones, too.
    """

    literal: VehicleCategory
    older: VehicleCategory | None
    is_lossy: bool = False
    instead: str = ""


_BICYCLE = "`bicycle` of DSL 2.2 (`--std 2.2`) is exact"

# `vehicle_category` (§8.7.16); the older literals exist in every version.
_CATEGORIES: Mapping[str, _Category] = {
    "aircraft": _Category("aircraft", None),
    "bicycle": _Category("bicycle", "bicycle"),
    "bus": _Category("bus", "bus"),
    "car": _Category("car", "car"),
    "heavy_truck": _Category("heavyTruck", "truck"),
    "land_vehicle": _Category("landVehicle", "car", True),
    "micro_mobility_device": _Category("micromobilityDevice", "bicycle", True, _BICYCLE),
    "motorcycle": _Category("motorcycle", "motorbike"),
    "other": _Category("other", "car", True),
    "semi_tractor": _Category("semitractor", "truck", True),
    "semi_trailer": _Category("semitrailer", "semitrailer"),
    "stand_up_scooter": _Category("standupScooter", "bicycle", True),
    "trailer": _Category("trailer", "trailer"),
    "train": _Category("train", "train"),
    "tram": _Category("tram", "tram"),
    "truck": _Category("heavyTruck", "truck"),
    "van": _Category("van", "van"),
    "vru_vehicle": _Category("micromobilityDevice", "bicycle", True, _BICYCLE),
    "watercraft": _Category("watercraft", None),
    "wheelchair": _Category("wheelchair", "bicycle", True),
    "work_machine": _Category("workMachine", "car", True),
}

# `trailer_category` (§8.7.17) -> literal.
TRAILERS: Mapping[str, VehicleCategory] = {
    "semi_trailer": "semitrailer",
    "full_trailer": "trailer",
    "central_axle_trailer": "trailer",
}

NO_ROLE: Role = "none"

_RENAMED_ROLES = {
    "fire": "fireBrigade",
    "road_assistance": "roadsideAssistance",
    "road_construction": "construction",
}
"""`traffic_participant_role` (§8.7.20) -> literal from 1.4 on, where that is another word."""

_OLDER_ROLES = {"fireBrigade": "fire", "roadsideAssistance": "roadAssistance"}
"""Literal from 1.4 on -> that of 1.2 and 1.3."""


def vehicle_literal(ctx: Context, member: CastMember) -> VehicleCategory:
    """Return what kind of vehicle an actor is; what gets lost is reported.

    Raises:
        Inexpressible: The version has no literal that comes near.
    """
    category, span = _CATEGORIES.get(member.category), member.actor.span
    if category is None:
        raise Inexpressible(f"there is no category for `{member.category}`", span)
    if ctx.version >= HARMONIZED:
        return category.literal
    better = Remedy(version=HARMONIZED, instead=category.instead)
    if category.older is None:
        raise Inexpressible(f"there is no category for `{member.category}`", span, better)
    if category.is_lossy:
        loss = f"there is no literal for `{member.category}`"
        bound = f"it is called a {category.older}; size and limits are kept"
        ctx.report.approximate("vehicle_category", span, loss, bound, better)
    return category.older


def role_literal(ctx: Context, role: str) -> Role:
    """Return a role, in versions that have roles; `NO_ROLE` where they have no literal for it."""
    first, *others = role.split("_")
    literal = _RENAMED_ROLES.get(role, "".join((first, *map(str.capitalize, others))))
    if ctx.version < HARMONIZED:
        literal = _OLDER_ROLES.get(literal, literal)
    known = literals("Role", ctx.version) or ()
    return cast("Role", literal) if literal in known else NO_ROLE
