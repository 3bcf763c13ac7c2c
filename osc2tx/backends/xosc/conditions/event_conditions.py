"""Events as conditions: triggers that begin before their event, and what an event hands over.

Triggers that are evaluated before their event can occur may ask whether it has occurred; the others
have to look for the edge, so that they do not see an occurrence from before they began. In a tool
an edge is lost where both fall into one step, so it is not asked for without need.

Parameters of events are variables, set when the event is emitted.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Literal, TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.tree_queries import is_instant
from osc2tx.backends.xosc.logical.parameters import value_text
from osc2tx.backends.xosc.values.constants import Constant
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import Rule

Path: TypeAlias = tuple[tuple[ir.Behavior, int], ...]
"""Compositions from the outside to a member, with the index of the next one in it."""

Occurring: TypeAlias = tuple[Literal["event", "label"], str]
"""What occurs: an event, or the start or end of a member, by name."""


def early_triggers(body: ir.Behavior) -> frozenset[int]:
    """Return the ids of the triggers that begin before what they wait for."""
    places = dict(_paths(body, ()))
    nodes = ir.walk_behaviors(body)
    sites: dict[Occurring | None, list[Path]] = defaultdict(list)
    for node in nodes:
        for occurring in dict.fromkeys(_occurring(node)):
            sites[occurring].append(places[id(node)])
    found = set()
    for node in nodes:
        for trigger in triggers_of(node):
            # What no member makes comes from outside: at any time from the start on.
            made = sites.get(_awaited(trigger.event)) or [()]
            if all(_is_before(places[id(node)], site) for site in made):
                found.add(id(trigger))
    return frozenset(found)


def triggers_of(node: ir.Behavior) -> tuple[ir.Trigger, ...]:
    """Return the triggers that a member itself looks at."""
    match node:
        case ir.Wait(trigger=trigger) | ir.On(trigger=trigger):
            return (trigger,)
        case ir.Emit() | ir.Call() | ir.Finish():
            return ()
        case _:
            return node.until


def _awaited(event: ir.EventRef | ir.LabelEvent | ir.InnerEvent | None) -> Occurring | None:
    """Return the event, or the label, that a trigger waits for."""
    match event:
        case ir.EventRef(name=name):
            return "event", name
        case ir.LabelEvent(label=label) | ir.InnerEvent(label=label):
            return "label", label
    return None


def emitted_by(node: ir.Behavior) -> list[str]:
    """Return the events that a member emits itself."""
    emissions = node.reactions if isinstance(node, ir.On) else (node,)
    return [each.event.name for each in emissions if isinstance(each, ir.Emit)]


def _occurring(site: ir.Behavior) -> Iterator[Occurring]:
    """Yield the events that a member emits, and its label."""
    if site.label is not None:
        yield "label", site.label
    yield from (("event", name) for name in emitted_by(site))


def _paths(node: ir.Behavior, path: Path) -> Iterator[tuple[int, Path]]:
    yield id(node), path
    if isinstance(node, ir.Serial | ir.Parallel | ir.OneOf):
        for index, member in enumerate(node.members):
            yield from _paths(member, (*path, (node, index)))


def _is_before(watcher: Path, site: Path) -> bool:
    """Whether a member begins with the innermost composition that also holds the other one."""
    shared = 0
    for (a, i), (b, j) in zip(watcher, site, strict=False):
        if a is not b or i != j:
            break
        shared += 1
    return all(begins_at_once(node, index) for node, index in watcher[shared:])


def begins_at_once(node: ir.Behavior, index: int) -> bool:
    """Whether a member of a composition, by its index, begins when the composition does."""
    match node:
        case ir.Serial(members=members):
            return all(is_instant(member) for member in members[:index])
        case ir.Parallel():
            return index == 0 or (node.start_to_start is None and node.overlap in (None, "start"))
        case _:
            return True


# --- what an event hands over ---------------------------------------------------------------------


def set_parameters(ctx: Context, emission: ir.Emit) -> tuple[xml.ActionPart, ...]:
    """Return the actions that set what an emission hands over.

    Raises:
        Inexpressible: It is only known during the run.
    """
    found = []
    for argument in emission.arguments:
        value = ctx.values.of(argument.value)
        variable = _variable(ctx, emission.event.name, argument.parameter, value)
        found.append(ctx.set_variable(variable, value_text(value)))
    return tuple(found)


def parameter_condition(
    ctx: Context, argument: ir.EventArgument, rule: Rule, value: Constant
) -> xml.ByValueCondition:
    """Return the condition on what an event has handed over."""
    if not isinstance(value, (int, float)):
        ctx.require_support("ParameterCondition/text", argument.span)
    variable = _variable(ctx, argument.event, argument.parameter, value)
    return ctx.variable_is(variable, rule, value_text(value))


def _variable(ctx: Context, event: str, parameter: str, value: Constant) -> str:
    """Return the variable for a parameter of an event, declared."""
    variable = ctx.variable_name(f"{ctx.scope.prefix}{event}.{parameter}")
    if isinstance(value, bool):
        ctx.declare(variable, "boolean", "false")
    elif isinstance(value, (int, float)):
        ctx.declare(variable, "double", "0")
    else:
        ctx.declare(variable, "string", "")
    return variable
