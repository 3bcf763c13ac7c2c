"""Trees that are too large for a run: nested invocations multiply members.

A scenario that invokes another one twice has its members twice, so a chain of twenty scenarios has
a million members. The count needs no tree: each scenario is counted once.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping
from typing import TypeAlias

from osc2tx.analysis.tree_walk import do_directives
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Behavior: TypeAlias = sym.ScenarioSymbol | sym.ActionSymbol

MOST_MEMBERS = 100_000
"""Maximum number of members of a tree that is practical to run."""

MOST_LEVELS = 300
"""Members in each other, with those of invoked scenarios: a run walks them by recursion."""


@dataclass(slots=True)
class _Invoked:
    """A behavior that another one invokes.

    Attributes:
        place: The invocation that is in most compositions.
        level: In how many.
        times: Number of invocations.
    """

    place: Span
    level: int
    times: int = 1


@dataclass(slots=True)
class _Size:
    """The tree of a behavior.

    Attributes:
        place: Its `do`.
        members: Number of members in its text.
        levels: Number of levels in its text.
        invoked: The behaviors that it invokes.
        all_members: Including those of invoked behaviors; `None` until they are counted.
        all_levels: Likewise.
    """

    place: Span | None
    members: int
    levels: int
    invoked: dict[Behavior, _Invoked]
    all_members: int | None = None
    all_levels: int = 0


def report_tree_sizes(model: SemanticModel, sink: DiagnosticSink) -> None:
    """Report the scenarios whose trees are too large, but none that invokes one of them."""
    behaviors = dict.fromkeys(
        symbol
        for symbol in model.symbols
        if isinstance(symbol, sym.ScenarioSymbol | sym.ActionSymbol)
    )
    sizes = {behavior: _size_of(model, behavior, behaviors) for behavior in behaviors}
    for start in sizes:
        for behavior in _inner_first(sizes, start):
            size = sizes[behavior]
            inner = [(sizes[callee], each) for callee, each in size.invoked.items()]
            size.all_members = size.members + sum(
                each.times * (of.all_members or 0) for of, each in inner
            )
            size.all_levels = max(
                [size.levels, *(of.all_levels + each.level for of, each in inner)]
            )
            if size.all_members > MOST_MEMBERS or size.all_levels > MOST_LEVELS:
                _report(behavior, sizes, sink)
                size.all_members = size.all_levels = 0  # those that invoke it are not at fault


def _size_of(model: SemanticModel, behavior: Behavior, behaviors: Container[Behavior]) -> _Size:
    """Measure the text of a behavior; an action of the library is one member."""
    directives = do_directives(behavior)
    size = _Size(directives[0].span if directives else None, 0, 1, {})
    pending = [(each.member, 1) for each in directives]
    while pending:
        member, level = pending.pop()
        size.members, size.levels = size.members + 1, max(size.levels, level)
        if isinstance(member, ast.Composition):
            pending += [(inner, level + 1) for inner in reversed(member.members)]
        callee = (
            model.references.get(member.behavior) if isinstance(member, ast.Invocation) else None
        )
        if not isinstance(callee, sym.ScenarioSymbol | sym.ActionSymbol):
            continue
        if callee not in behaviors:
            continue
        found = size.invoked.get(callee)
        if found is None:
            size.invoked[callee] = _Invoked(member.span, level)
        else:
            found.times += 1
            if level > found.level:
                found.place, found.level = member.span, level
    return size


def _inner_first(sizes: Mapping[Behavior, _Size], start: Behavior) -> Iterator[Behavior]:
    """Yield uncounted behaviors, each after those that it invokes; a cycle ends where it closes."""
    pending = [(start, False)]
    entered: set[Behavior] = set()
    while pending:
        behavior, is_done = pending.pop()
        if is_done:
            yield behavior
        elif behavior not in entered and sizes[behavior].all_members is None:
            entered.add(behavior)
            pending.append((behavior, True))
            pending += ((each, False) for each in sizes[behavior].invoked)


def _report(behavior: Behavior, sizes: Mapping[Behavior, _Size], sink: DiagnosticSink) -> None:
    size, notes = sizes[behavior], []
    place = size.place
    name = f"`{behavior.qualified_name}`"
    if (size.all_members or 0) > MOST_MEMBERS:
        message = f"{name} has {size.all_members} members, with those of the scenarios that it"
        message += f" invokes; a run can have {MOST_MEMBERS}"
        weights = {
            of: each.times * (sizes[of].all_members or 0) for of, each in size.invoked.items()
        }
    else:
        message = f"{name} has {size.all_levels} levels of members in each other, with those of the"
        message += f" scenarios that it invokes; a run can have {MOST_LEVELS}"
        weights = {of: each.level + sizes[of].all_levels for of, each in size.invoked.items()}
    largest = max(weights, key=lambda callee: weights[callee], default=None)
    if largest is not None:
        of, each = sizes[largest], size.invoked[largest]
        place = each.place
        often = "once" if each.times == 1 else f"{each.times} times"
        notes.append(
            f"`{largest.qualified_name}`, invoked {often}, has {of.all_members} members in"
            f" {of.all_levels} levels"
        )
    assert place is not None, "without a `do` there are no members"
    sink.report("OSC444", place, message, notes=notes)
