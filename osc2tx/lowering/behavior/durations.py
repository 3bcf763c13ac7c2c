"""Durations of open-ended members: a range is a parameter like any other (§7.3.5.1.3).

A member that ends by itself, or with an `until`, has its own duration, which a range only bounds.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeGuard, TypeVar

from osc2tx import ir
from osc2tx.analysis import single_value
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.catalogue import catalogue
from osc2tx.lowering.behavior.composed_behaviors import Composed
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.values.range_bounds import with_bounds
from osc2tx.semantics.builtins import DURATION
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

CompositionT = TypeVar("CompositionT", ir.Serial, ir.Parallel, ir.OneOf)
Member = TypeVar("Member", bound=ir.Serial | ir.OneOf | ir.Parallel | ir.Invoke)


def with_open_duration(
    ctx: LoweringContext, node: Member, name: str, written: ast.Node | None = None
) -> Member:
    """Return a member whose duration is drawn from its range, if nothing else ends the member.

    Args:
        ctx: The scenario.
        node: The member.
        name: Of the parameter.
        written: The member in the source, whose constraints may then mention the duration.
    """
    duration = node.duration if node.duration is None else with_bounds(node.duration)
    if duration is not node.duration:
        node = replace(node, duration=duration)
    if node.until or not isinstance(duration, ir.RangeValue):
        return node
    if not ir.is_open(replace(node, duration=None)):
        return node
    drawn = ctx.draw(name, duration, duration.lower.type)
    if written is not None:
        ctx.state.given[written, DURATION] = drawn
    return replace(node, duration=drawn)


def is_free(node: ir.Behavior) -> bool:
    """Return whether a member is an action that takes the duration that it is given.

    It changes a value at an unstated rate.
    """
    return (
        isinstance(node, ir.Invoke)
        and node.action.startswith("change_")
        and not node.modifiers
        and not any(argument.parameter.startswith("rate_") for argument in node.arguments)
    )


UNTIMED = frozenset(
    {
        "avoid_collisions",
        "change_lane",
        "change_speed",
        "keep_lane",
        "keep_speed",
        "lane",
        "lateral",
        "physical_movement",
        "speed",
    }
)
"""Modifiers that together do not state how long an action takes; with a shape they do."""


def with_elastic(
    node: CompositionT, members: Sequence[ir.Behavior], duration: ir.Expression
) -> CompositionT:
    """Return a composition; those of some members that take any duration have the given one."""
    timed = tuple(
        replace(member, duration=duration) if member in members and is_elastic(member) else member
        for member in node.members
    )
    return node if timed == node.members else replace(node, members=timed)


def is_elastic(node: ir.Behavior) -> TypeGuard[ir.Invoke]:
    """Return whether a member is an action that reaches its goal in whatever time it has.

    It has no duration, and nothing in it states how fast the goal is reached.
    """
    if not isinstance(node, ir.Invoke) or node.duration is not None or node.until:
        return False
    return is_free(node) or (
        _ends(node) == "open" and bool(ir.goals_of(node)) and all(map(_leaves_time, node.modifiers))
    )


def _leaves_time(call: ir.ModifierCall) -> bool:
    is_shaped = any(argument.parameter == "shape" for argument in call.arguments)
    return call.at == "start" or (call.name in UNTIMED and not is_shaped)


def _ends(node: ir.Invoke) -> str:
    entry = catalogue().actions.get(node.qualified_name)
    return "" if entry is None else entry.ends


_OWN: Key = (DURATION,)


def own_duration(ctx: LoweringContext, constraints: ConstraintLowering) -> ir.Expression | None:
    """Return the duration of a scenario, or its bounds; others may then compute with it."""
    if _OWN not in constraints.found.by_key:
        return None
    setting = constraints.setting(_OWN, DURATION.type)
    if setting.value is not None:
        ctx.state.given[_OWN] = setting.value
        return setting.value
    match setting.domain:
        case ir.RangeValue() | ir.HalfRange() as bounds:
            return bounds
        case ir.Choices() as listed:
            drawn = ctx.draw("duration", listed, listed.elements[0].type)
            ctx.state.given[_OWN] = drawn
            return drawn
    return None


def leaves_duration_open(ctx: LoweringContext, behavior: Composed) -> bool:
    """Whether constraints in a behavior state its duration as a range."""
    found = ctx.program.analysis.types[behavior]
    if _OWN not in found.by_key:
        return False
    domain = found.domains_to_set().get(_OWN)
    return domain is None or single_value(domain) is None


def lasting(ctx: LoweringContext, body: ir.Behavior, duration: ir.Expression | None) -> ir.Behavior:
    """Return a body that takes so long."""
    if duration is None:
        return body
    made: ir.Serial | ir.Parallel | ir.OneOf
    if isinstance(body, ir.Serial | ir.Parallel | ir.OneOf) and body.duration is None:
        made = replace(body, duration=duration)
    else:
        made = ir.Serial(
            span=body.span, label=None, name=body.name, members=(body,), duration=duration
        )
    return with_open_duration(ctx, made, "duration")
