"""Scenarios that invoke themselves without end.

A tree is made whole before it runs, and no condition leaves a member of a `do` out of it, so an
invocation that leads back to its own scenario would never be done.
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
    """Report the circles of invocations, one for each way in."""
    graph = {
        symbol: _invoked_by(model, symbol)
        for symbol in model.symbols
        if isinstance(symbol, sym.ScenarioSymbol | sym.ActionSymbol)
    }
    done: set[Behavior] = set()
    for behavior in graph:
        if behavior not in done:
            for circle in _circles(graph, behavior, done):
                _report(graph, circle, sink)


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
    """Walk depth first; yield the part of the way that each step back to it closes."""
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
        f"`{start.qualified_name}` invokes itself without end",
        notes=[way] if len(circle) > 1 else [],
        labels=[
            Label(step.span, f"invoked by `{caller}`")
            for step, caller in zip(steps[1:], callers[1:], strict=True)
        ],
    )
