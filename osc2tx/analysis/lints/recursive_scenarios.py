"""Scenarios that invoke themselves endlessly.

The standard allows recursion (§7.6.1.4): a recursive invocation is created when it starts. It is
endless if every alternative is recursive and no surrounding member ends it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import TypeAlias

from osc2tx.analysis.tree_walk import do_directives, do_members
from osc2tx.diagnostics import DiagnosticSink, Label
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

Behavior: TypeAlias = sym.ScenarioSymbol | sym.ActionSymbol
Invoked: TypeAlias = Mapping[Behavior, ast.Name]


def report_recursion(model: SemanticModel, sink: DiagnosticSink) -> None:
    """Report the endless cycles of invocations, one for each entry."""
    graph = {
        symbol: _invoked_by(model, symbol)
        for symbol in model.symbols
        if isinstance(symbol, sym.ScenarioSymbol | sym.ActionSymbol)
    }
    done: set[Behavior] = set()
    circles = [c for each in graph if each not in done for c in _circles(graph, each, done)]
    if not circles:
        return
    ways_out = _WaysOut(model, graph)
    for circle in circles:
        if not any(map(ways_out.has_one, circle)):
            _report(graph, circle, sink)


class _WaysOut:
    """The behaviors that can end, and those that their invokers end."""

    def __init__(self, model: SemanticModel, graph: Mapping[Behavior, Invoked]) -> None:
        self._model = model
        self._found: set[Behavior] = set()
        while new := [b for b in graph if b not in self._found and self._ends(b)]:
            self._found.update(new)
        self._found.update(callee for behavior in graph for callee in self._cut(behavior))

    def has_one(self, behavior: Behavior) -> bool:
        """Return whether a behavior ends, or is ended."""
        return behavior in self._found

    def _ends(self, behavior: Behavior) -> bool:
        directives = list(do_directives(behavior))
        emitted = (s for s in behavior.statements if isinstance(s, ast.OnDirective))
        reactions = (r for on in emitted for r in on.members)
        declares_end = any(isinstance(r, ast.EmitDirective) and _is_end(r) for r in reactions)
        return declares_end or all(self._member_ends(each.member) for each in directives)

    def _member_ends(self, member: ast.BehaviorMember) -> bool:
        match member:
            case ast.Composition(members=members, operator=operator):
                if _has_until(member):
                    return True
                ends = [self._member_ends(each) for each in members]
                return any(ends) if operator is ast.CompositionOperator.ONE_OF else all(ends)
            case ast.Invocation():
                callee = self._model.references.get(member.behavior)
                is_ours = isinstance(callee, sym.ScenarioSymbol | sym.ActionSymbol)
                return not is_ours or _has_until(member) or self._is_known(callee)
            case _:
                return True

    def _is_known(self, callee: sym.Symbol | None) -> bool:
        if not isinstance(callee, sym.ScenarioSymbol | sym.ActionSymbol):
            return True
        return callee in self._found or callee.origin != "user"

    def _cut(self, behavior: Behavior) -> Iterator[Behavior]:
        """Yield the behaviors that a behavior invokes and ends by an `until`."""
        for directive in do_directives(behavior):
            for member in do_members(directive.member):
                if isinstance(member, ast.Invocation | ast.Composition) and _has_until(member):
                    for inner in do_members(member):
                        callee = (
                            self._model.references.get(inner.behavior)
                            if isinstance(inner, ast.Invocation)
                            else None
                        )
                        if isinstance(callee, sym.ScenarioSymbol | sym.ActionSymbol):
                            yield callee


def _has_until(member: ast.Invocation | ast.Composition) -> bool:
    return any(isinstance(each, ast.UntilDirective) for each in member.with_members)


def _is_end(node: ast.EmitDirective) -> bool:
    return node.event.text in ("end", "fail")


def _invoked_by(model: SemanticModel, behavior: Behavior) -> Invoked:
    """Return the behaviors that a behavior invokes, with the first position of each."""
    invoked: dict[Behavior, ast.Name] = {}
    for directive in do_directives(behavior):
        for member in do_members(directive.member):
            if isinstance(member, ast.Invocation):
                callee = model.references.get(member.behavior)
                if isinstance(callee, sym.ScenarioSymbol | sym.ActionSymbol):
                    invoked.setdefault(callee, member.behavior)
    return invoked


def _circles(
    graph: Mapping[Behavior, Invoked], start: Behavior, done: set[Behavior]
) -> Iterator[list[Behavior]]:
    """Walk depth first; yield each cycle that a step closes."""
    way: dict[Behavior, Iterator[Behavior]] = {start: iter(graph[start])}
    while way:
        current = next(reversed(way))
        callee = next(way[current], None)
        if callee is None:
            done.add(current)
            del way[current]
        elif callee in way:
            yield list(way)[list(way).index(callee) :]
        elif callee not in done:
            way[callee] = iter(graph.get(callee, ()))


def _report(
    graph: Mapping[Behavior, Invoked], circle: list[Behavior], sink: DiagnosticSink
) -> None:
    start = circle[0]
    steps = [graph[caller][callee] for caller, callee in pairwise([*circle, start])]
    callers = [behavior.qualified_name for behavior in circle]
    way = " -> ".join(f"`{name}`" for name in [*callers, start.qualified_name])
    sink.report(
        "OSC438",
        steps[0].span,
        f"`{start.qualified_name}` invokes itself, and no alternative ends it",
        notes=[way] if len(circle) > 1 else [],
        labels=[
            Label(step.span, f"invoked by `{caller}`")
            for step, caller in zip(steps[1:], callers[1:], strict=True)
        ],
    )
