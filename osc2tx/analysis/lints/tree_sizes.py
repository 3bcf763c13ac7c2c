"""Trees that no run could make: invocations of invocations multiply their members.

A scenario that invokes another one twice holds its members twice, so twenty scenarios that invoke
one another make a million of them. What is counted needs no tree: each scenario is counted once.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from osc2tx.analysis.tree_walk import do_directives, do_members
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Behavior: TypeAlias = sym.ScenarioSymbol | sym.ActionSymbol

MOST_MEMBERS = 100_000
"""Members of a tree: what runs in the memory and the patience that there is."""


@dataclass(slots=True)
class _Size:
    """The members of a behavior.

    Attributes:
        own: Those in its text.
        invoked: What they invoke, with the first position of each and how often.
        total: All, with those of what it invokes; `None` until they are counted.
    """

    own: int
    invoked: dict[Behavior, tuple[ast.Name, int]]
    total: int | None = None


def report_tree_sizes(model: SemanticModel, sink: DiagnosticSink) -> None:
    """Report the scenarios that have too many members, but none of what they invoke."""
    sizes = {
        symbol: _size_of(model, symbol)
        for symbol in model.symbols
        if isinstance(symbol, sym.ScenarioSymbol | sym.ActionSymbol)
    }
    for start in sizes:
        for behavior in _inner_first(sizes, start):
            size = sizes[behavior]
            parts = {
                callee: times * (sizes[callee].total or 0)
                for callee, (_, times) in size.invoked.items()
                if callee in sizes
            }
            size.total = size.own + sum(parts.values())
            if size.total > MOST_MEMBERS:
                _report(behavior, size, parts, sink)
                size.total = 0  # those that invoke it are not at fault


def _size_of(model: SemanticModel, behavior: Behavior) -> _Size:
    size = _Size(0, {})
    for directive in do_directives(behavior):
        for member in do_members(directive.member):
            size.own += 1
            callee = None
            if isinstance(member, ast.Invocation):
                callee = model.references.get(member.behavior)
            if isinstance(callee, sym.ScenarioSymbol | sym.ActionSymbol):
                place, times = size.invoked.get(callee, (member.behavior, 0))
                size.invoked[callee] = (place, times + 1)
    return size


def _inner_first(sizes: dict[Behavior, _Size], start: Behavior) -> Iterator[Behavior]:
    """Yield what is not counted yet, after what it invokes; a circle is cut where it closes."""
    pending = [(start, False)]
    entered: set[Behavior] = set()
    while pending:
        behavior, is_done = pending.pop()
        if is_done:
            yield behavior
        elif behavior not in entered and sizes[behavior].total is None:
            entered.add(behavior)
            pending.append((behavior, True))
            pending += ((each, False) for each in sizes[behavior].invoked if each in sizes)


def _report(
    behavior: Behavior, size: _Size, parts: dict[Behavior, int], sink: DiagnosticSink
) -> None:
    largest = max(parts, key=lambda callee: parts[callee], default=None)
    place, times = size.invoked[largest] if largest is not None else (behavior.declaration.name, 1)
    notes = []
    if largest is not None:
        each = parts[largest] // times
        notes.append(f"`{largest.qualified_name}` has {each} members, and is invoked {times} times")
    sink.report(
        "OSC444",
        place.span,
        f"`{behavior.qualified_name}` has {size.total} members, with those of the scenarios that it"
        f" invokes; a run can have {MOST_MEMBERS}",
        notes=notes,
    )
