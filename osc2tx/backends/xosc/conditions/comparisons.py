"""Comparison of a measured quantity with a constant."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.values.constants import Constant, Member, Named
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.literals import CoordinateSystem, DirectionalDimension, RelativeDistanceType, Rule


class Comparison(NamedTuple):
    """A measure compared with a constant.

    Attributes:
        actor: Whose measure.
        name: The field or method.
        arguments: By parameter.
        rule: Literal of `Rule`.
        value: The constant, in SI units.
        is_edge: Only the moment at which it changes counts.
        source: The expression.
    """

    actor: str
    name: str
    arguments: Mapping[str, Constant]
    rule: Rule
    value: float
    is_edge: bool
    source: ir.Expression

    def reference(self, parameter: str = "reference") -> str:
        """Return the name of the other actor."""
        value = self.arguments.get(parameter)
        if not isinstance(value, Named):
            raise Inexpressible(f"{self.name} needs `{parameter}`", self.source.span)
        return value.name

    def member(self, parameter: str, default: str) -> str:
        """Return the member of an enum."""
        value = self.arguments.get(parameter)
        return value.name if isinstance(value, Member) else default

    @property
    def is_free(self) -> bool:
        """Whether it counts between bounding boxes, as `mode` says."""
        return self.member("mode", "reference_points") == "bounding_boxes"


Groups: TypeAlias = "tuple[tuple[xml.ConditionPart, ...], ...]"
"""Conditions: an OR of ANDs; an edge belongs to the first one of a group."""

Measure: TypeAlias = Callable[[Context, Comparison], Groups]


def of_entity(actor: str, condition: xml.EntityConditionPart) -> xml.ByEntityCondition:
    """Return the condition on one entity."""
    return xml.ByEntityCondition(
        xml.TriggeringEntities(xml.EntityRef(entityRef=actor), triggeringEntitiesRule="any"),
        xml.EntityCondition(condition),
    )


def relative_speed(
    actor: str,
    other: str,
    rule: Rule,
    value: float,
    direction: DirectionalDimension | None = None,
) -> Groups:
    """Return the condition on the difference (m/s) of the speeds of two actors.

    With a direction (1.2) it is that of their parts along an axis of one of them, which in a bend
    is another one.
    """
    condition = xml.RelativeSpeedCondition(
        entityRef=other, rule=rule, value=value, direction=direction
    )
    return ((of_entity(actor, condition),),)


KINDS: Mapping[str, RelativeDistanceType] = {
    "euclidean": "euclidianDistance",
    "longitudinal": "longitudinal",
    "lateral": "lateral",
}
"""Directions of the library -> literals."""


def relative_distance(
    ctx: Context,
    c: Comparison,
    direction: str,
    system: CoordinateSystem | None,
    *,
    freespace: bool,
) -> xml.ByEntityCondition:
    """Return the condition on the distance of two actors, which has no sign."""
    newer = ctx.version >= "1.1"
    kind = KINDS[direction]
    condition = xml.RelativeDistanceCondition(
        entityRef=c.reference(),
        relativeDistanceType="cartesianDistance" if not newer and system is None else kind,
        coordinateSystem=system if newer else None,
        value=c.value,
        freespace=freespace,
        rule=c.rule,
    )
    return of_entity(c.actor, condition)


def distance_to(
    ctx: Context,
    place: xml.PositionPart,
    value: float,
    rule: Rule,
    system: CoordinateSystem | None = None,
    direction: str | None = None,
    *,
    freespace: bool = False,
) -> xml.DistanceCondition:
    """Return the condition on the distance (m) to a place; without a direction it is straight."""
    newer = ctx.version >= "1.1"
    return xml.DistanceCondition(
        xml.Position(place),
        value=value,
        freespace=freespace,
        rule=rule,
        alongRoute=None if newer else system is not None,
        coordinateSystem=system if newer else None,
        relativeDistanceType=None if direction is None or not newer else KINDS[direction],
    )


MIRRORED: Mapping[Rule, Rule] = {
    "greaterThan": "lessThan",
    "greaterOrEqual": "lessOrEqual",
    "lessThan": "greaterThan",
    "lessOrEqual": "greaterOrEqual",
    "equalTo": "equalTo",
    "notEqualTo": "notEqualTo",
}
"""Rule for `-a ? -b` instead of `a ? b`."""

READ_SPEEDS = frozenset(
    {
        "AccelerationCondition",
        "RelativeSpeedCondition",
        "SpeedCondition",
        "TimeHeadwayCondition",
        "TimeToCollisionCondition",
    }
)
"""Conditions that look at the speed of the triggering entities and of the one that they name."""


def speeds_read(part: Element) -> frozenset[str]:
    """Return the actors at whose speed a condition below an element looks."""
    names = (
        node.get("entityRef")
        for condition in part.below(xml.ByEntityCondition)
        if condition.children[1].children[0].tag in READ_SPEEDS
        for node in condition.walk()
    )
    return frozenset(name for name in names if name is not None)
