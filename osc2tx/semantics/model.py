"""The semantic model: the result of the resolution pass."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Set
from dataclasses import field

from osc2tx.semantics.symbols import (
    ActionSymbol,
    FieldSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    Symbol,
    UnitSymbol,
)
from osc2tx.semantics.types import ERROR, Type
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Binding:
    """The meaning of a call, invocation, modifier application or emit.

    Attributes:
        callee: The called symbol; arguments of events are bound too.
        receiver: The expression before the dot; `None` where the actor is implicit.
        arguments: Parameter and value, in source order. Omitted parameters are absent.
    """

    callee: Symbol
    receiver: ast.Expression | None
    arguments: tuple[tuple[FieldSymbol | ParameterSymbol, ast.Expression], ...]


@dataclass(frozen=True, eq=False, repr=False)
class SemanticModel:
    """A checked program: symbols, and side tables over its syntax trees.

    Attributes:
        root: The file to compile.
        files: All files, imported ones first.
        scenarios: The scenarios of the root file, in source order.
        actions: All actions that are known, the library's included.
        types: Type of every expression of the user's files, and of the type names of fields.
        references: The symbol of a `NameExpression`, `MemberAccess`, `EnumLiteral` or `Name`.
        bindings: The meaning of an `Invocation`, `ModifierApplication`, `Call`, `CallDirective` or
            `EmitDirective`.
        units: The unit of a `PhysicalLiteral`.
        quantities: The values of strings that a dialect reads as quantities of actors.
        symbols: The symbols of the user's files, in source order, imported files first.
        known_units: Every unit, also those of the library.
        elements: The elements of lists of objects that constraints describe one by one.
        global_parameters: Those of the program (§7.3.14), in the order of `symbols`.
        callees: All symbols that are called, invoked or applied.
        imported: The names of the files that each file imports itself.
    """

    root: ast.File
    files: tuple[ast.File, ...]
    scenarios: tuple[ScenarioSymbol, ...]
    actions: tuple[ActionSymbol, ...] = ()
    types: Mapping[ast.Node, Type] = field(default_factory=dict)
    references: Mapping[ast.Node, Symbol] = field(default_factory=dict)
    bindings: Mapping[ast.Node, Binding] = field(default_factory=dict)
    units: Mapping[ast.PhysicalLiteral, UnitSymbol] = field(default_factory=dict)
    quantities: Mapping[ast.StringLiteral, ast.MemberAccess] = field(default_factory=dict)
    symbols: tuple[Symbol, ...] = ()
    known_units: tuple[UnitSymbol, ...] = ()
    elements: Mapping[FieldSymbol, tuple[FieldSymbol, ...]] = field(default_factory=dict)
    global_parameters: tuple[FieldSymbol, ...] = ()
    callees: frozenset[Symbol] = frozenset()
    imported: Mapping[str, Set[str]] = field(default_factory=dict)

    def known_to(self, names: Iterable[str]) -> frozenset[str]:
        """Return the names of some files and of all files that they import, also indirectly."""
        known: set[str] = set()
        pending = list(names)
        while pending:
            name = pending.pop()
            if name not in known:
                known.add(name)
                pending += self.imported.get(name, ())
        return frozenset(known)

    def element_of(self, list_: Symbol | None, index: ast.Expression) -> FieldSymbol | None:
        """Return an element of a list that is a declared object."""
        elements = self.elements.get(list_, ()) if isinstance(list_, FieldSymbol) else ()
        number = index.value if isinstance(index, ast.IntegerLiteral) else len(elements)
        return elements[number] if number < len(elements) else None

    def type_of(self, expression: ast.Expression) -> Type:
        """Return the type of an expression; the error type if it has none."""
        return self.types.get(expression, ERROR)

    def symbol_of(self, node: ast.Node) -> Symbol | None:
        """Return the symbol of a name."""
        return self.references.get(node)

    def binding_of(self, node: ast.Node) -> Binding:
        """Return the meaning of a call; only for programs without errors."""
        return self.bindings[node]
