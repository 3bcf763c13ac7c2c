"""Properties of members of a tree: instant, timed, the domains they control."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.backends.xosc.actions.registry import TAKES
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL
from osc2tx.catalogue import ActionEntry, catalogue
from osc2tx_shared.classes import replace


def predecessor(body: ir.Behavior, node: ir.Invoke) -> ir.Invoke | None:
    """Return the invocation that ends where another one starts; emissions take no time."""
    return _beside(body, node, -1)


def follower(body: ir.Behavior, node: ir.Invoke) -> ir.Invoke | None:
    """Return the invocation that starts where another one ends; emissions take no time."""
    return _beside(body, node, 1)


def _beside(body: ir.Behavior, node: ir.Invoke, way: int) -> ir.Invoke | None:
    for serial in ir.walk_behaviors(body):
        if not isinstance(serial, ir.Serial):
            continue
        members = [each for each in serial.members if not isinstance(each, ir.Emit)]
        for index, each in enumerate(members):
            if each is node:
                found = index + way
                other = members[found] if 0 <= found < len(members) else None
                return other if isinstance(other, ir.Invoke) else None
    return None


def is_first(body: ir.Behavior, node: ir.Invoke) -> bool:
    """Whether an invocation begins with the run."""
    match body:
        case ir.Serial(members=members):
            first = next((each for each in members if not isinstance(each, ir.Emit)), None)
            return first is not None and is_first(first, node)
        case ir.Parallel(members=members, start_to_start=None) | ir.OneOf(members=members):
            return any(is_first(each, node) for each in members)
    return body is node


def runs_beside(
    body: ir.Behavior,
    node: ir.Behavior,
    kinds: tuple[type[ir.Parallel | ir.OneOf], ...] = (ir.Parallel, ir.OneOf),
) -> Iterator[ir.Behavior]:
    """Yield the other members of the compositions around a member, which may run while it does."""
    for each in ir.walk_behaviors(body):
        if isinstance(each, kinds) and _holds(each, node):
            yield from (member for member in each.members if not _holds(member, node))


def _holds(body: ir.Behavior, node: ir.Behavior) -> bool:
    return any(each is node for each in ir.walk_behaviors(body))


def is_last(body: ir.Behavior, node: ir.Behavior) -> bool:
    """Whether the run ends with a member."""
    if isinstance(body, ir.Serial) and body is not node:
        members = [each for each in body.members if not isinstance(each, ir.Emit)]
        return bool(members) and is_last(members[-1], node)
    return body is node


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


def is_single(node: ir.Behavior) -> bool:
    """Whether nothing has to be stopped but one action: a leaf, or waits before and after it."""
    return _leaves(node) <= 1


def is_timed(node: ir.Behavior) -> bool:
    """Whether a member holds others for a time, and fails if they take longer."""
    match node:
        case ir.Serial() | ir.Parallel() | ir.OneOf() | ir.InvokeScenario():
            return node.duration is not None
        case _:
            return False


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


def may_be_cut(body: ir.Behavior, label: str) -> bool:
    """Whether a composition around a labelled member may end before the member does."""
    for node in ir.walk_behaviors(body):
        if not isinstance(node, ir.Serial | ir.Parallel | ir.OneOf):
            continue
        is_bounded = bool(node.until) or node.duration is not None or isinstance(node, ir.OneOf)
        inside = (each.label for each in ir.walk_behaviors(node) if each is not node)
        if is_bounded and label in inside:
            return True
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


def shifts_beside(body: ir.Behavior, node: ir.Invoke, actor: str) -> bool:
    """Whether members beside an invocation may move an actor across the road; if in doubt, yes."""
    beside = runs_beside(body, node)
    return not _holds(body, node) or any(_shifts(member, actor) for member in beside)


def _shifts(member: ir.Behavior, actor: str) -> bool:
    for node in ir.walk_behaviors(member):
        if isinstance(node, ir.InvokeScenario):
            return True
        if not isinstance(node, ir.Invoke) or node.actor_name != actor:
            continue
        going_on = (m for m in node.modifiers if m.at != "start" and m.name != "keep_lane")
        if LATERAL in _domains(replace(node, modifiers=tuple(going_on))):
            return True
    return False


def _is_sideways(node: ir.Invoke) -> bool:
    """Whether an action is about the place across the road by its direction."""
    return any(
        argument.parameter == "direction"
        and isinstance(argument.value, ir.EnumValue)
        and argument.value.member not in DIRECTIONS_ALONG
        for argument in node.arguments
    )


def actors_of(node: ir.Behavior) -> tuple[str, ...]:
    """Return the actors of the actions in a tree, in source order."""
    names = (each.actor_name for each in ir.invocations(node))
    return tuple(dict.fromkeys(name for name in names if name is not None))


def follows_route(node: ir.Behavior) -> bool:
    """Whether an action is over at the end of a route of the map, if nothing ends it before."""
    if not isinstance(node, ir.Invoke) or node.action != "drive":
        return False
    if node.duration is not None or node.until:
        return False
    ways = [modifier for modifier in node.modifiers if modifier.name == "along"]
    routes = (a.value for way in ways for a in way.arguments if a.parameter == "route")
    return any(route.type.name not in ("crossing", "path") for route in routes)
