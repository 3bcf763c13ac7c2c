"""Entities: vehicles, pedestrians and other objects with the attributes that the XML asks for."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.backends.xosc.cast import MISC, PEDESTRIAN, VEHICLE, CastMember, Choice
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.towing import couplings, towing
from osc2tx.backends.xosc.tree import Element, element

# `vehicle_category` (§8.7.16) -> literal; all ten literals exist in every version.
VEHICLE_CATEGORIES: Mapping[str, Choice] = {
    "car": Choice("car"),
    "van": Choice("van"),
    "bus": Choice("bus"),
    "truck": Choice("truck"),
    "heavy_truck": Choice("truck"),
    "semi_tractor": Choice("truck", "there is no literal for a semi-tractor"),
    "trailer": Choice("trailer"),
    "semi_trailer": Choice("semitrailer"),
    "motorcycle": Choice("motorbike"),
    "bicycle": Choice("bicycle"),
    "stand_up_scooter": Choice("bicycle", "there is no literal for a scooter"),
    "micro_mobility_device": Choice("bicycle", "there is no literal for such a device"),
    "vru_vehicle": Choice("bicycle", "there is no literal for such a vehicle"),
    "wheelchair": Choice("bicycle", "there is no literal for a wheelchair among vehicles"),
    "train": Choice("train"),
    "tram": Choice("tram"),
    "work_machine": Choice("car", "there is no literal for a work machine"),
    "land_vehicle": Choice("car"),
    "other": Choice("car"),
}

MASS = {VEHICLE: 1500.0, PEDESTRIAN: 80.0, MISC: 100.0}
"""Kilograms; the DSL knows no mass."""

TOP_SPEED = 69.0
"""m/s; the DSL knows no top speed, and tools clip at it."""

WHEEL_DIAMETER = 0.6
MAX_STEERING = 0.5
"""Metres and radians of axles that the scenario says nothing about."""


def scenario_objects(ctx: Context) -> list[Element]:
    """Return the entities in source order, those that are towed first."""
    objects = []
    for scope in ctx.scope.all():
        with ctx.within(scope):
            for member in scope.own:
                with ctx.report_as(f"actor {member.actor.type}", member.actor.span):
                    objects.append(_scenario_object(ctx, member))
    towed = towing(ctx)  # tools want to know a trailer before the vehicle that tows it
    return sorted(objects, key=lambda each: each.get("name") not in towed)


def _scenario_object(ctx: Context, member: CastMember) -> Element:
    return element(
        "ScenarioObject",
        _BODIES[member.kind](ctx, member),
        name=member.name,
        comment=ctx.comment(member.actor.span, f"{member.name}: {member.actor.type}"),
    )


def _vehicle(ctx: Context, member: CastMember) -> Element:
    choice = VEHICLE_CATEGORIES.get(member.category)
    if choice is None:
        raise Inexpressible(f"there is no category for `{member.category}`", member.actor.span)
    if choice.loss:
        bound = f"it is called a {choice.literal}; size and limits are kept"
        ctx.report.approximate("vehicle_category", member.actor.span, choice.loss, bound)
    limits = member.limits
    jerk = limits.jerk if ctx.version >= "1.2" else None
    return element(
        "Vehicle",
        _bounding_box(member),
        element(
            "Performance",
            maxSpeed=TOP_SPEED,
            maxAcceleration=limits.acceleration,
            maxDeceleration=limits.deceleration,
            maxAccelerationRate=jerk,
            maxDecelerationRate=jerk,
        ),
        element(
            "Axles",
            _axle("FrontAxle", member, MAX_STEERING, member.shape.wheelbase),
            _axle("RearAxle", member, 0.0, 0.0),
        ),
        _properties(ctx, member),
        *couplings(ctx, member),
        name=member.model or member.category,
        vehicleCategory=choice.literal,
        mass=MASS[VEHICLE] if ctx.version >= "1.1" else None,
    )


def _axle(tag: str, member: CastMember, steering: float, position: float) -> Element:
    return element(
        tag,
        maxSteering=steering,
        wheelDiameter=WHEEL_DIAMETER,
        trackWidth=round(0.9 * member.shape.width, 3),
        positionX=position,
        positionZ=WHEEL_DIAMETER / 2,
    )


def _pedestrian(ctx: Context, member: CastMember) -> Element:
    is_animal = "animal" in member.actor.lineage
    return element(
        "Pedestrian",
        _bounding_box(member),
        _properties(ctx, member),
        name=member.model or member.name,
        mass=MASS[PEDESTRIAN],
        model=member.model or member.name if ctx.version == "1.0" else None,
        pedestrianCategory="animal" if is_animal else "pedestrian",
    )


def _misc(ctx: Context, member: CastMember) -> Element:
    return element(
        "MiscObject",
        _bounding_box(member),
        _properties(ctx, member),
        name=member.model or member.name,
        mass=MASS[MISC],
        miscObjectCategory="obstacle",
    )


def _bounding_box(member: CastMember) -> Element:
    shape = member.shape
    return element(
        "BoundingBox",
        element("Center", x=round(shape.centre, 6), y=0.0, z=shape.height / 2),
        element("Dimensions", width=shape.width, length=shape.length, height=shape.height),
    )


def _properties(ctx: Context, member: CastMember) -> Element:
    color = ctx.values.field(member.actor.name, ("color",))
    properties = []
    if isinstance(color, str):
        properties.append(element("Property", name="color", value=color))
    return element("Properties", *properties)


_BODIES = {VEHICLE: _vehicle, PEDESTRIAN: _pedestrian, MISC: _misc}
