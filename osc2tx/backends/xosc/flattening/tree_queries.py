"""What members of a tree take over: the domains that their elements control, and routes."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.registry import TAKES
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL
from osc2tx.catalogue import catalogue

DIRECTIONS_ALONG = ("ahead", "behind", "longitudinal")
"""Directions of an action that is about the speed; in others it is about the place in the lane."""


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
    entry, modifiers = ir.entry_of(node), catalogue().modifiers
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


def may_go_on(node: ir.Behavior, policy: str) -> bool:
    """Whether a member never ends by itself if certain alternatives of it are taken."""
    match node:
        case ir.Serial() | ir.Parallel() | ir.OneOf() if node.until or node.duration is not None:
            return False
        case ir.Serial(members=members):
            return may_go_on(members[-1], policy)
        case ir.Parallel(members=members):
            timed = [member for member in members if not ir.is_instant(member)]
            return bool(timed) and all(may_go_on(member, policy) for member in timed)
        case ir.OneOf(members=members) if ir.is_drawn(node, policy):
            return any(may_go_on(member, policy) for member in members)
        case ir.OneOf(members=(first, *_)) if policy == "first":
            return may_go_on(first, policy)
    return ir.is_open(node)


def follows_route(node: ir.Behavior) -> bool:
    """Whether an action is over at the end of a route of the map, if nothing ends it before."""
    if not isinstance(node, ir.Invoke) or node.action != "drive":
        return False
    if node.duration is not None or node.until:
        return False
    ways = [modifier for modifier in node.modifiers if modifier.name == "along"]
    routes = (a.value for way in ways for a in way.arguments if a.parameter == "route")
    return any(route.type.name not in ("crossing", "path") for route in routes)
