"""Declarations that repeat what is known: the library's units, bare declarations of a prelude.

ScenarioRunner has no library, so its scenarios declare units, and actors and modifiers without
content. A unit that is declared again is the library's if it has the same value. Otherwise a number
may be in either unit: its use is an error. Equal declarations of several files are one declaration;
within a file they are a mistake. An actor or modifier without base, body or target is that of the
prelude; any other is a new one.
"""

from __future__ import annotations

from dataclasses import field
from math import isclose

from osc2tx.diagnostics import DiagnosticSink, Label, Span
from osc2tx.semantics.dialects import Relaxations
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import Scope
from osc2tx.semantics.symbols import ActorSymbol, PhysicalTypeSymbol, Symbol, UnitSymbol
from osc2tx.semantics.types import Dimension, PhysicalType
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

CODE = "OSC616"
SAME = 1e-9  # relative; the same number, but for the digits that people write
ROUNDED = 1e-3


@dataclass(slots=True, eq=False)
class Repeats:
    """Distinguishes repeated declarations from conflicting ones.

    Attributes:
        sink: Receives the diagnostics.
        relaxations: The dialect of the file.
        units: The units of the library that were declared again, by name and file.
    """

    sink: DiagnosticSink
    relaxations: Relaxations
    units: dict[tuple[str, str], UnitSymbol] = field(default_factory=dict)

    def unit(self, symbol: UnitSymbol, dimension: Dimension, earlier: UnitSymbol) -> bool:
        """Whether a unit may be declared again; the library's declaration counts."""
        if symbol.origin != "user" or earlier.origin != "library" or not self._may_repeat:
            return False
        if not isinstance(earlier.type, PhysicalType) or earlier.type.dimension != dimension:
            return False
        if self.units.setdefault((symbol.name, symbol.span.source.name), symbol) is not symbol:
            return False
        what = f"unit `{symbol.name}` of the standard library is declared again"
        if _is_close(symbol, earlier, SAME):
            self._warn(symbol.span, what)
        elif _is_close(symbol, earlier, ROUNDED):
            self._warn(symbol.span, f"{what}, rounded; the library's {_value(earlier)} holds")
        else:
            self.relaxations.disputed[symbol.name] = symbol
            self._warn(
                symbol.span,
                f"{what} with another value, {_value(symbol)} instead of {_value(earlier)}; "
                "it must not be used",
            )
        return True

    def physical_type(self, symbol: Symbol, earlier: Symbol) -> bool:
        """Whether another file declares the same physical type."""
        if not isinstance(symbol, PhysicalTypeSymbol) or not isinstance(
            earlier, PhysicalTypeSymbol
        ):
            return False
        alike = symbol.dimension == earlier.dimension
        if not alike or symbol.span.source is earlier.span.source or not self._may_repeat:
            return False
        file = earlier.span.source.name
        self._warn(symbol.span, f"physical type `{symbol.name}` is declared in `{file}` already")
        return True

    def actor(self, node: ast.ActorDeclaration, scope: Scope) -> bool:
        """Whether an actor is declared without content, and the prelude declares it."""
        if node.base is not None or node.members:
            return False
        known = any(
            isinstance(s, ActorSymbol) and s.origin == "prelude"
            for s in scope.types_named(node.name.text)
        )
        return known and self._is_bare("actor", node.name.text, node.name.span)

    def modifier(self, node: ast.ModifierDeclaration, scope: Scope) -> bool:
        """Whether a modifier is declared without content, and the prelude declares it."""
        name, actor = node.name.name, node.name.actor
        if node.behavior is not None or node.members or actor is None:
            return False
        known = any(
            m.origin == "prelude" and m.actor is not None and m.actor.name == actor.text
            for m in scope.modifiers_named(name.text)
        )
        return known and self._is_bare("modifier", f"{actor}.{name}", node.name.span)

    def _is_bare(self, kind: str, name: str, span: Span) -> bool:
        if not self._may_repeat:
            return False
        dialect = self.relaxations.dialect.name
        self._warn(span, f"{kind} `{name}` is that of dialect `{dialect}`; this declares it again")
        return True

    @property
    def _may_repeat(self) -> bool:
        return CODE in self.relaxations.dialect.relaxed

    def _warn(self, span: Span, message: str) -> None:
        if self.relaxations.is_new(CODE, span.source.name, message):
            self.sink.report(CODE, span, message)


def report_disputed(r: Resolution, name: ast.Name, unit: UnitSymbol, rival: UnitSymbol) -> None:
    """Report the use of a unit that has one value here and another in the library."""
    r.report(
        "OSC203",
        name.span,
        f"`{name}` has two values: {_value(unit)} in the library, {_value(rival)} in this program",
        help=f"remove the second declaration, or rename its unit `{name}`",
        labels=(Label(rival.span, "declared again here"),),
    )


def _is_close(unit: UnitSymbol, other: UnitSymbol, tolerance: float) -> bool:
    return isclose(unit.factor, other.factor, rel_tol=tolerance) and isclose(
        unit.offset, other.offset, rel_tol=tolerance
    )


def _value(unit: UnitSymbol) -> str:
    offset = f", offset {unit.offset:.9g}" if unit.offset else ""
    return f"factor {unit.factor:.9g}{offset}"
