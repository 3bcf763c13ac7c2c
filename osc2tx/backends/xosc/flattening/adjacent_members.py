"""Members before, behind and beside an invocation."""

from __future__ import annotations

from osc2tx import ir


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


def runs_beside(body: ir.Behavior, node: ir.Invoke) -> tuple[ir.Behavior, ...]:
    """Return the members of compositions that may run while an invocation does."""
    if not isinstance(body, ir.Serial | ir.Parallel | ir.OneOf):
        return ()
    (mine,) = (each for each in body.members if _holds(each, node))
    others = () if isinstance(body, ir.Serial) else body.members
    return (*(each for each in others if each is not mine), *runs_beside(mine, node))


def _holds(body: ir.Behavior, node: ir.Invoke) -> bool:
    return any(each is node for each in ir.walk_behaviors(body))


def is_last(body: ir.Behavior, node: ir.Behavior) -> bool:
    """Whether the run ends with a member."""
    if isinstance(body, ir.Serial) and body is not node:
        members = [each for each in body.members if not isinstance(each, ir.Emit)]
        return bool(members) and is_last(members[-1], node)
    return body is node
