"""Starts of later actions: a range at the start admits whatever value the actor then has.

The value is not drawn: what came before decides it (§8.9.1.4). One that is also used elsewhere is
drawn as any other.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass

from osc2tx import ir
from osc2tx.catalogue import catalogue
from osc2tx.lowering.context import LoweringContext
from osc2tx_shared.classes import replace


def with_any_start(
    ctx: LoweringContext, body: ir.Behavior, later: frozenset[str], others: object
) -> ir.Behavior:
    """Return a body in which ranges `at: start` of later actions are conditions.

    Args:
        ctx: The scenario; values that nothing reads any more are no longer drawn.
        body: The body.
        later: Names of the values that starts of later actions read.
        others: All else of the scenario that may read them.
    """
    if not later:
        return body
    read = Counter(_names(body)) + Counter(_names(others)) + Counter(_names(ctx.state.drawn))
    starts = Counter(name for node in ir.invocations(body) for name in drawn_starts(ctx, node))
    alone = {name for name in later if read[name] == starts[name]}
    found = {
        each.name: each.domain
        for each in ctx.state.drawn
        if isinstance(each, ir.Parameter) and each.name in alone and each.domain is not None
    }
    ctx.state.drawn[:] = [each for each in ctx.state.drawn if each.name not in found]
    return _rewritten(body, found)


def drawn_starts(ctx: LoweringContext, node: ir.Invoke) -> Iterator[str]:
    """Yield the drawn values of ranges that an action has to meet at its start."""
    drawn = {each.name: each for each in ctx.state.drawn if isinstance(each, ir.Parameter)}
    for modifier in node.modifiers:
        for argument in modifier.arguments if modifier.at == "start" else ():
            value = argument.value
            source = drawn.get(value.name) if isinstance(value, ir.FieldRef) else None
            is_range = source is not None and isinstance(source.domain, ir.RangeValue)
            if source is not None and is_range and _range_of(modifier, argument) is not None:
                yield source.name


def _range_of(modifier: ir.ModifierCall, argument: ir.Argument) -> str | None:
    """Return the parameter for the range of an argument, if there is one."""
    entry = catalogue().modifiers.get(modifier.name)
    name = f"{argument.parameter}_range"
    return name if entry is not None and name in entry.parameters else None


def _rewritten(node: ir.Behavior, found: Mapping[str, ir.Domain]) -> ir.Behavior:
    match node:
        case ir.Serial() | ir.Parallel() | ir.OneOf():
            return replace(node, members=tuple(_rewritten(each, found) for each in node.members))
        case ir.Invoke():
            return replace(node, modifiers=tuple(_condition(m, found) for m in node.modifiers))
        case _:
            return node


def _condition(modifier: ir.ModifierCall, found: Mapping[str, ir.Domain]) -> ir.ModifierCall:
    arguments = []
    for argument in modifier.arguments:
        value, parameter = argument.value, _range_of(modifier, argument)
        if isinstance(value, ir.FieldRef) and value.name in found and parameter is not None:
            argument = replace(
                argument, parameter=parameter, value=found[value.name], is_positional=False
            )
        arguments.append(argument)
    return replace(modifier, arguments=tuple(arguments))


def _names(part: object) -> Iterator[str]:
    """Yield the names of all fields that a part of a scenario reads."""
    if isinstance(part, ir.FieldRef):
        yield part.name
    if isinstance(part, tuple | list):
        for each in part:
            yield from _names(each)
    elif is_dataclass(part):
        for field in fields(part):
            yield from _names(getattr(part, field.name))
