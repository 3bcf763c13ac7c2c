"""Members of a `parallel` that control the same of one actor: the run ends with an error.

In the XML one of them would just take over from the other.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.compositions.parallel_overlaps import is_open
from osc2tx.backends.xosc.flattening.tree_queries import claims, entry_of
from osc2tx.backends.xosc.report import Remedy
from osc2tx_shared.classes import dataclass, replace


@dataclass(frozen=True, slots=True)
class _Claimant:
    """An action that controls something.

    Attributes:
        member: The number of the member that it is in.
        node: The action.
        at_once: Whether it begins when the composition does.
        lasts: Whether it then goes on for as long as the composition.
    """

    member: int
    node: ir.Invoke
    at_once: bool
    lasts: bool


def report_conflicts(ctx: Context, node: ir.Parallel) -> None:
    """Report actions that control what another one surely controls at the same time."""
    overridden = {override.overridden for override in ctx.scope.scenario.overrides}
    claimants: dict[tuple[str, str], list[_Claimant]] = {}
    for number, member in enumerate(node.members):
        first = list(map(id, _from_the_start(member)))
        for action in _actions(member):
            if action.label in overridden:
                continue
            begins = id(action) in first
            lasts = action is member and begins and is_open(action)
            at_once = begins and _starts_together(node)
            for what in _controls(action):
                found = _Claimant(number, action, at_once, lasts)
                claimants.setdefault(what, []).append(found)
    told = set()
    for rivals in claimants.values():
        holders = [each for each in rivals if each.lasts or each.at_once]
        for holder, rival in product(holders, rivals):
            meet = holder.lasts or rival.at_once
            pair = (id(holder.node), id(rival.node))
            if meet and holder.member != rival.member and pair not in told:
                told.add(pair)
                _report(ctx, holder.node, rival.node)


def _report(ctx: Context, holder: ir.Invoke, rival: ir.Invoke) -> None:
    reason = f"runs fail: it would control what `{_head(holder)}` controls at the same time"
    instead = Remedy(instead="one after the other, or with an `override`, they are exact")
    ctx.report.cannot(f"action {rival.action}", rival.span, reason, instead)


def _head(node: ir.Invoke) -> str:
    first = node.span.text.splitlines()[0]
    return first.removesuffix(":").removesuffix(" with")


def _starts_together(node: ir.Parallel) -> bool:
    return node.overlap is None and not (node.start_to_start or node.end_to_end)


def _from_the_start(member: ir.Behavior) -> list[ir.Invoke]:
    """Return the actions that begin when a member does."""
    match member:
        case ir.Serial(members=members):
            return _from_the_start(members[0])
        case ir.Parallel(members=members) if _starts_together(member):
            return [found for each in members for found in _from_the_start(each)]
        case ir.Invoke() if _takes_time(member):
            return [member]
        case _:
            return []


def _actions(member: ir.Behavior) -> Iterator[ir.Invoke]:
    for each in ir.walk_behaviors(member):
        if isinstance(each, ir.Invoke) and _takes_time(each):
            yield each


def _takes_time(node: ir.Invoke) -> bool:
    entry = entry_of(node)
    return entry is not None and entry.ends in ("goal", "open")


def _controls(node: ir.Invoke) -> frozenset[tuple[str, str]]:
    """Return actor and domain of what an action controls while it goes on."""
    lasting = tuple(call for call in node.modifiers if call.at != "start")
    return claims(replace(node, modifiers=lasting))
