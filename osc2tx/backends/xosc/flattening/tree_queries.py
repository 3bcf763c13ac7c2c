"""Properties of members of a tree: instant, timed, the domains they control."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL

WEATHER = frozenset({"air", "assign_celestial_position", "clouds", "fog", "rain", "snow", "wind"})
SWITCHES = frozenset(
    {
        "set_bulb_state",
        "set_group_bulb_state",
        "set_group_semantic_state",
        "set_group_state",
        "set_semantic_state",
        "set_state",
    }
)
INSTANT = WEATHER | SWITCHES | {"connect_trailer", "disconnect_trailer", "set_lights"}
"""Actions that take no time, and so bound no `parallel`."""

OPEN_GLOBALS = frozenset({"play_cycles"})
"""Actions without entity that go on until something ends them."""

LATERAL_ACTIONS = frozenset(
    {
        "assign_orientation",
        "assign_position",
        "change_lane",
        "change_position",
        "follow_lane",
        "follow_path",
        "replay_path",
    }
)
"""Actions on the place across the road, or on the way, that leave the speed alone."""

GAP_ACTIONS = frozenset({"change_space_gap", "keep_space_gap"})
"""Actions on the speed or on the place across the road, by their direction."""

TIMED_ACTIONS = frozenset({"follow_trajectory", "replay_trajectory"})
"""Actions on both."""

SPEED_MODIFIERS = frozenset(
    {"speed", "change_speed", "acceleration", "position", "keep_position", "along_trajectory"}
)
LANE_MODIFIERS = frozenset({"along", "along_trajectory", "change_lane", "lane", "lateral"})
MOVEMENTS = frozenset({"drive", "move", "walk"})
FREE_SPEED = LATERAL_ACTIONS | MOVEMENTS | INSTANT


def is_instant(node: ir.Behavior) -> bool:
    """Whether a member takes no time."""
    match node:
        case ir.Serial(members=members) | ir.Parallel(members=members):
            return node.duration is None and all(is_instant(member) for member in members)
        case ir.OneOf(members=members):
            return all(is_instant(member) for member in members)
        case ir.Invoke(action=action):
            return action in INSTANT and node.duration is None
        case ir.Emit() | ir.Finish() | ir.Call() | ir.On():
            return True
        case ir.InvokeScenario() | ir.Wait():
            return False


def is_single(node: ir.Behavior) -> bool:
    """Whether nothing has to be stopped but one action: a leaf, or waits around it."""
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
    modifiers = {call.name for call in node.modifiers}
    domains = set()
    if node.action not in FREE_SPEED or modifiers & SPEED_MODIFIERS:
        domains.add(LONGITUDINAL)
    if node.action in GAP_ACTIONS and _is_sideways(node):
        return frozenset((LATERAL,))
    if node.action in LATERAL_ACTIONS | TIMED_ACTIONS or modifiers & LANE_MODIFIERS:
        domains.add(LATERAL)
    return frozenset(domains)


def _is_sideways(node: ir.Invoke) -> bool:
    """Whether a gap is one across the road."""
    for argument in node.arguments:
        if argument.parameter == "direction" and isinstance(argument.value, ir.EnumValue):
            return argument.value.member not in ("ahead", "behind", "longitudinal")
    return False


def actors_of(node: ir.Behavior) -> tuple[str, ...]:
    """Return the actors of the actions in a tree, in source order."""
    found = (
        each.actor.name
        for each in ir.walk_behaviors(node)
        if isinstance(each, ir.Invoke) and isinstance(each.actor, ir.FieldRef)
    )
    return tuple(dict.fromkeys(found))
