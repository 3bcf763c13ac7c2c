"""Fields and methods of actors as conditions of the XML.

One entry of `MEASURES` for each field or method of the library. A measure is called with what is
measured and compared, and returns the condition on entities, or raises `Inexpressible`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from osc2tx.backends.xosc.conditions.comparisons import Comparison, Groups, Measure, of_entity
from osc2tx.backends.xosc.conditions.distances import (
    ahead_of,
    behind,
    object_distance,
    road_distance,
    space_gap,
    space_headway,
)
from osc2tx.backends.xosc.conditions.headways import time_gap, time_headway, time_to_collision
from osc2tx.backends.xosc.conditions.point_distances import (
    distance_to_road_point,
    distance_to_xyz,
    s_coordinate,
    t_coordinate,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DirectionalDimension

Motion: TypeAlias = xml.SpeedCondition | xml.AccelerationCondition


def _speed(ctx: Context, c: Comparison) -> Groups:
    return _motion(ctx, c, xml.SpeedCondition, "longitudinal")


def _acceleration(ctx: Context, c: Comparison) -> Groups:
    return _motion(ctx, c, xml.AccelerationCondition, "longitudinal")


def _part_of(condition: type[Motion], direction: DirectionalDimension | None) -> Measure:
    """Return the measure of a part of a speed or an acceleration, or of its amount (1.2)."""

    def measure(ctx: Context, c: Comparison) -> Groups:
        ctx.require("a condition on a part of a motion", "1.2", c.source.span)
        return _motion(ctx, c, condition, direction)

    return measure


def _motion(
    ctx: Context, c: Comparison, condition: type[Motion], direction: DirectionalDimension | None
) -> Groups:
    """Return the condition on a speed or an acceleration along an axis of the actor."""
    made = condition(
        rule=c.rule,
        value=c.value,
        direction=direction if ctx.version >= "1.2" else None,
    )
    return ((of_entity(c.actor, made),),)


MEASURES: Mapping[str, Measure] = {
    "speed": _speed,
    "velocity.translational.x": _speed,
    "velocity.translational.y": _part_of(xml.SpeedCondition, "lateral"),
    "velocity.translational.z": _part_of(xml.SpeedCondition, "vertical"),
    "velocity.translational.norm": _part_of(xml.SpeedCondition, None),
    "acceleration.translational.x": _acceleration,
    "acceleration.translational.y": _part_of(xml.AccelerationCondition, "lateral"),
    "acceleration.translational.z": _part_of(xml.AccelerationCondition, "vertical"),
    "acceleration.translational.norm": _part_of(xml.AccelerationCondition, None),
    "object_distance": object_distance,
    "road_distance": road_distance,
    "space_gap": space_gap,
    "ahead_of": ahead_of,
    "behind": behind,
    "space_headway": space_headway,
    "time_gap": time_gap,
    "time_headway": time_headway,
    "time_to_collision": time_to_collision,
    "get_s_coord": s_coordinate,
    "get_t_coord": t_coordinate,
    "distance_to_xyz_point": distance_to_xyz,
    "distance_to_odr_point": distance_to_road_point,
    "distance_to_route_point": distance_to_road_point,
}
"""Field or method of an actor (§8.7.3, §8.7.6) -> its condition."""

FINITE = frozenset({"time_gap", "time_headway", "time_to_collision"})
"""Measures that are infinite where the XML has no value: a fall of them is the rise of `less`."""
