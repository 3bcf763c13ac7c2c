"""Properties of members of a tree: instant, timed, the domains they control."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.registry import TAKES
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL
from osc2tx.catalogue import ActionEntry, catalogue

DIRECTIONS_ALONG = ("ahead", "behind", "longitudinal")
"""Directions of an action that is about the speed; in others it is about the place in the lane."""


def entry_of(node: ir.Invoke) -> ActionEntry | None:
    """Return the catalogue entry of an action; `None` for one that the scenario declares."""
    return catalogue().actions.get(node.qualified_name)


def is_instant(node: ir.Behavior) -> bool:
    """Whether a member takes no time."""
    match node:
        case ir.Serial(members=members) | ir.Parallel(members=members):
            return node.duration is None and all(is_instant(member) for member in members)
        case ir.OneOf(members=members):
            return all(is_instant(member) for member in members)
        case ir.Invoke():
            entry = entry_of(node)
            return entry is not None and entry.ends == "instant" and node.duration is None
        case ir.Emit() | ir.Finish() | ir.Call() | ir.On():
            return True
        case ir.InvokeScenario() | ir.Wait():
            return False


def claims(node: ir.Behavior) -> frozenset[tuple[str, str]]:
    """Return the actors and domains that a member takes over as soon as it starts."""
    match node:
        case ir.Serial(members=members):
            return claims(members[0])
        case ir.Parallel(members=members) | ir.OneOf(members=members):
            return frozenset[tuple[str, str]]().union(*(claims(member) for member in members))
        case ir.Invoke(actor=ir.FieldRef(name=actor)):
            return frozenset((actor, domain) for domain in _domains(node))
        case _:
            return frozenset()


def _domains(node: ir.Invoke) -> frozenset[str]:
    entry, modifiers = entry_of(node), catalogue().modifiers
    slots = () if entry is None else entry.slots
    if LONGITUDINAL in slots and _is_sideways(node):
        return frozenset((LATERAL,))
    domains = {*TAKES.get(node.action, slots)}
    for call in node.modifiers:
        known = modifiers.get(call.name)  # none if only a dialect has it
        domains |= {*TAKES.get(f"modifier {call.name}", () if known is None else known.slots)}
    return frozenset(domains)


def _is_sideways(node: ir.Invoke) -> bool:
    """Whether an action is about the place across the road by its direction."""
    return any(
        argument.parameter == "direction"
        and isinstance(argument.value, ir.EnumValue)
        and argument.value.member not in DIRECTIONS_ALONG
        for argument in node.arguments
    )


def follows_route(node: ir.Behavior) -> bool:
    """Whether an action is over at the end of a route of the map, if nothing ends it before."""
    if not isinstance(node, ir.Invoke) or node.action != "drive":
        return False
    if node.duration is not None or node.until:
        return False
    ways = [modifier for modifier in node.modifiers if modifier.name == "along"]
    routes = (a.value for way in ways for a in way.arguments if a.parameter == "route")
    return any(route.type.name not in ("crossing", "path") for route in routes)


def starts_at_once(node: ir.Behavior) -> bool:
    """Whether all actions in a member start when it does: nothing in it is left to be stopped."""
    match node:
        case ir.Parallel(overlap=None, start_to_start=None, end_to_end=None, members=members):
            return all(map(starts_at_once, members))
        case ir.Invoke():
            return True
        case _:
            return False


def is_single(node: ir.Behavior) -> bool:
    """Whether nothing has to be stopped but one action: a leaf, or waits before and after it."""
    return _leaves(node) <= 1


def _leaves(node: ir.Behavior) -> int:
    match node:
        case ir.Parallel(members=members) if len(members) > 1:
            return 2
        case ir.Serial(members=members) | ir.Parallel(members=members) | ir.OneOf(members=members):
            return sum(_leaves(member) for member in members)
        case ir.Wait():
            return 0
        case ir.Invoke():
            return 1
        case ir.Emit() | ir.Finish() | ir.Call() | ir.On() | ir.InvokeScenario():
            return 2
