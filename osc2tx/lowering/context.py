"""What every part of the lowering needs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from osc2tx import ir
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.symbols import FieldSymbol, ScenarioSymbol
from osc2tx.syntax import ast

Part = TypeVar("Part")


@dataclass(frozen=True, slots=True)
class LoweringContext:
    """The checked program and the place for complaints, while one scenario is lowered.

    Attributes:
        model: The program.
        sink: Where complaints go.
        globals: The global parameters that the scenario uses, in order of use.
        event_fields: Names of the events that fields such as `x` in `@e as x` stand for.
        invoked: The scenarios that it invokes, in order of use.
        drawn: Parameters that stand for ranges of time in its tree, in order of use.
    """

    model: SemanticModel
    sink: DiagnosticSink
    globals: dict[str, FieldSymbol] = field(default_factory=dict)
    event_fields: dict[int, str] = field(default_factory=dict)
    invoked: list[ScenarioSymbol] = field(default_factory=list)
    drawn: list[ir.Parameter] = field(default_factory=list)

    def draw(self, bounds: ir.RangeValue) -> ir.FieldRef:
        """Return a value from a range, as a parameter that one can set like any other.

        Its name has a blank, so that no plain name of the scenario can be the same.
        """
        number = len(self.drawn) + 1
        name = "wait time" if number == 1 else f"wait time {number}"
        type_ = bounds.lower.type
        parameter = ir.Parameter(
            name=name, span=bounds.span, type=type_, value=None, domain=bounds, is_fixed=False
        )
        self.drawn.append(parameter)
        return ir.FieldRef(span=bounds.span, type=type_, name=name)

    def unsupported(self, code: str, span: Span, what: str, help: str | None = None) -> None:
        """Report what cannot be lowered."""
        self.sink.report(code, span, what, help=help)


def present(parts: Sequence[Part | None]) -> tuple[Part, ...]:
    """Drop what could not be lowered; it has been reported."""
    return tuple(part for part in parts if part is not None)


def statement_comments(node: ast.Statement) -> tuple[str, ...]:
    """Return the comment lines that belong to a statement, its trailing one last."""
    trailing = () if node.trailing_comment is None else (node.trailing_comment,)
    return (*node.comments, *trailing)
