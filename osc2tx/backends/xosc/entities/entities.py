"""Entities: vehicles, pedestrians and other objects with the attributes the XML requires."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

from osc2tx.backends.xosc.actions.trailers import couplings, towing
from osc2tx.backends.xosc.actions.user_actions import check_model
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import MISC, PEDESTRIAN, VEHICLE, CastMember
from osc2tx.backends.xosc.entities.categories import (
    NO_ROLE,
    TRAILERS,
    role_literal,
    vehicle_literal,
)
from osc2tx.backends.xosc.facts.actors import RGB, TOP_SPEED
from osc2tx.backends.xosc.values.constants import Member, Named
from osc2tx.losses.bounds import Metres
from osc2tx.losses.entries import GENERIC
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import Role, VehicleCategory
from osc2tx.xosc.schema import has_attribute
from osc2tx_shared.classes import replace

WHEEL_DIAMETER = 0.6
MAX_STEERING = 0.5
"""Metres and radians of axles that the scenario says nothing about."""


class Axle(NamedTuple):
    """What the XML asks for about an axle, in its units: metres and radians."""

    max_steering: float
    wheel_diameter: float
    track_width: float
    position_x: float
    position_z: float


def axles(ctx: Context, member: CastMember) -> list[xml.AxlesPart]:
    """Return the axles, those of the scenario if it has some, from front to rear."""
    shape = member.shape
    track = round(0.9 * shape.width, 3)
    usual = [
        Axle(steering, WHEEL_DIAMETER, track, position, WHEEL_DIAMETER / 2)
        for steering, position in ((MAX_STEERING, shape.wheelbase), (0.0, 0.0))
    ]
    name = member.actor.name
    listed = ctx.values.field(name, "axles")
    found = [_constrained_axle(ctx, name, ("axles", str(i)), axle) for i, axle in enumerate(usual)]
    if isinstance(listed, tuple) and listed:
        front, rear = usual
        default = [front, *[rear] * (len(listed) - 1)] if len(listed) > 1 else [rear]
        made = [
            _constrained_axle(ctx, each.name if isinstance(each, Named) else "", (), like)
            for each, like in zip(listed, default, strict=True)
        ]
        found = sorted(made, key=lambda axle: -axle.position_x)
    if len(found) == 1 and ctx.version < "1.3":  # a front axle cannot be left out yet
        found = [found[0], *found]
    if len(found) == 1:
        return [_axle(xml.RearAxle, found[0])]
    front_most, *others, rear_most = found
    return [
        _axle(xml.FrontAxle, front_most),
        _axle(xml.RearAxle, rear_most),
        *(_axle(xml.AdditionalAxle, axle) for axle in others),
    ]


def _constrained_axle(ctx: Context, name: str, path: tuple[str, ...], usual: Axle) -> Axle:
    """Return an axle with the constraints on it below a path of an object, else as usual."""
    said = {part: ctx.values.number_in(name, *path, part) for part in Axle._fields}
    return usual._replace(**{part: v for part, v in said.items() if v is not None})


def _axle(
    kind: type[xml.FrontAxle | xml.RearAxle | xml.AdditionalAxle], axle: Axle
) -> xml.AxlesPart:
    return kind(
        maxSteering=axle.max_steering,
        wheelDiameter=axle.wheel_diameter,
        trackWidth=axle.track_width,
        positionX=axle.position_x,
        positionZ=axle.position_z,
    )


MASS = {VEHICLE: 1500.0, PEDESTRIAN: 80.0, MISC: 100.0}
"""Kilograms; the DSL knows no mass."""


def scenario_objects(ctx: Context) -> list[xml.ScenarioObject]:
    """Return the entities in source order, those that are towed first."""
    objects = []
    for scope in ctx.scope.all():
        with ctx.within(scope):
            for member in scope.own:
                with ctx.report_as(f"actor {member.actor.type}", member.actor.span):
                    check_model(ctx, member)
                    body = _BODIES[member.kind](ctx, member)
                    objects.append(xml.ScenarioObject(body, name=member.name))
    towed = towing(ctx)  # tools want to know a trailer before the vehicle that tows it
    return sorted(objects, key=lambda each: each.get("name") not in towed)


def _vehicle(ctx: Context, member: CastMember) -> xml.Vehicle:
    _note_origin(ctx, member)
    limits = member.limits
    demand = ctx.whole_demand(member.name)
    jerk = limits.jerk if ctx.version >= "1.2" else None
    return xml.Vehicle(
        _bounding_box(ctx, member),
        xml.Performance(
            maxSpeed=max(TOP_SPEED, round(demand.speed, 6)),
            maxAcceleration=max(limits.acceleration, demand.acceleration),
            maxDeceleration=max(limits.deceleration, demand.deceleration),
            maxAccelerationRate=jerk,
            maxDecelerationRate=jerk,
        ),
        xml.Axles(*axles(ctx, member)),
        _properties(ctx, member),
        *couplings(ctx, member),
        name=member.model or member.category,
        vehicleCategory=_category(ctx, member),
        mass=MASS[VEHICLE] if ctx.version >= "1.1" else None,
        model3d=_looks(ctx, member, VEHICLE),
        role=_role(ctx, member, VEHICLE),
    )


IN_THE_MIDDLE = "`keep(it.bounding_box.center.x == 0m)` gives it this origin in the world, too"


def _note_origin(ctx: Context, member: CastMember) -> None:
    """Report where the models of a tool have their origin; in the standard it is the rear axle."""
    if ctx.profile.has_middle_origins and member.shape.centre:
        ctx.report.approximate(
            f"actor {member.actor.type}",
            member.actor.span,
            f"{ctx.profile.name} uses a vehicle model of its own, with its middle as the rear axle",
            Metres(abs(member.shape.centre), "behind its position, and the size of its own model"),
            replace(GENERIC, instead=IN_THE_MIDDLE),
        )


def _category(ctx: Context, member: CastMember) -> VehicleCategory:
    trailer = ctx.values.field(member.actor.name, "trailer_category")
    if isinstance(trailer, Member):
        return TRAILERS[trailer.name]
    return vehicle_literal(ctx, member)


def _pedestrian(ctx: Context, member: CastMember) -> xml.Pedestrian:
    is_animal = "animal" in member.actor.lineage
    if is_animal and ctx.profile.person_model:
        ctx.report.approximate(
            f"actor {member.actor.type}",
            member.actor.span,
            f"{ctx.profile.name} has no animals",
            "it looks like a person",
            GENERIC,
        )
    model = member.model or ctx.profile.person_model or member.name
    return xml.Pedestrian(
        _bounding_box(ctx, member),
        _properties(ctx, member),
        name=model,
        mass=MASS[PEDESTRIAN],
        model=model if ctx.version == "1.0" else None,
        model3d=_looks(ctx, member, PEDESTRIAN),
        role=_role(ctx, member, PEDESTRIAN),
        pedestrianCategory="animal" if is_animal else "pedestrian",
    )


def _misc(ctx: Context, member: CastMember) -> xml.MiscObject:
    return xml.MiscObject(
        _bounding_box(ctx, member),
        _properties(ctx, member),
        name=member.model or member.name,
        mass=MASS[MISC],
        miscObjectCategory="obstacle",
        model3d=_looks(ctx, member, MISC),
    )


# --- looks and size -----------------------------------------------------------------------------


def _looks(ctx: Context, member: CastMember, kind: str) -> str | None:
    """Return the model of its looks, where the version has an attribute for it."""
    model = ctx.values.field(member.actor.name, "geometry_reference")
    is_known = has_attribute(kind, "model3d", ctx.version)
    return model if is_known and isinstance(model, str) else None


def _role(ctx: Context, member: CastMember, kind: str) -> Role | None:
    role = ctx.values.field(member.actor.name, "role")
    if not isinstance(role, Member) or not has_attribute(kind, "role", ctx.version):
        return None
    return role_literal(ctx, role.name)


def _bounding_box(ctx: Context, member: CastMember) -> xml.BoundingBox:
    shape = member.shape
    center = {"x": round(shape.centre, 6), "y": 0.0, "z": shape.height / 2}
    for axis in center:
        given = ctx.values.number_in(member.actor.name, "bounding_box", "center", axis)
        center[axis] = center[axis] if given is None else given
    return xml.BoundingBox(
        xml.Center(x=center["x"], y=center["y"], z=center["z"]),
        xml.Dimensions(width=shape.width, length=shape.length, height=shape.height),
    )


def _properties(ctx: Context, member: CastMember) -> xml.Properties:
    name = member.actor.name
    found: dict[str, str | float] = dict(ctx.values.own_fields(name))
    color, role = ctx.values.field(name, "color"), ctx.values.field(name, "role")
    model = ctx.values.field(name, "geometry_reference")
    if isinstance(color, str):
        found["color"] = color
    elif isinstance(color, Member) and color.name in RGB:  # tools read them from a property
        found["color"] = ",".join(map(str, RGB[color.name]))
    if isinstance(role, Member) and _role(ctx, member, member.kind) in (None, NO_ROLE):
        found["role"] = role.name
    if isinstance(model, str) and _looks(ctx, member, member.kind) is None:
        found["model3d"] = model
    if ctx.profile.ego_property and member is _ego(ctx):
        found["type"] = ctx.profile.ego_property
    properties = (xml.Property(name=key, value=value) for key, value in found.items())
    return xml.Properties(*properties)


def _ego(ctx: Context) -> CastMember | None:
    """Return the vehicle that tools care for: the one called so, else the first one."""
    vehicles = [member for member in ctx.entities if member.kind == VEHICLE]
    called = (member for member in vehicles if member.name in ("ego", "hero"))
    return next(called, next(iter(vehicles), None))


_BODIES: Mapping[str, Callable[[Context, CastMember], xml.ScenarioObjectPart]] = {
    VEHICLE: _vehicle,
    PEDESTRIAN: _pedestrian,
    MISC: _misc,
}
