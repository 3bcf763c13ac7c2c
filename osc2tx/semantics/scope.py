"""Scopes: symbol tables, and the names visible at a place (§7.7.3)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field
from typing import TypeAlias, TypeVar

from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    EnumMemberSymbol,
    EnumSymbol,
    FieldSymbol,
    MethodSymbol,
    ModifierSymbol,
    PhysicalTypeSymbol,
    PrimitiveSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
    TypeSymbol,
    UnitSymbol,
)
from osc2tx.semantics.types import Dimension, PhysicalType
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

NULL = "null"

NamedSymbol: TypeAlias = (
    PhysicalTypeSymbol | EnumSymbol | StructSymbol | ActorSymbol | ScenarioSymbol | ActionSymbol
)
CallableBehavior: TypeAlias = ScenarioSymbol | ActionSymbol
Extension: TypeAlias = ast.EnumExtension | ast.TypeExtension | ast.PrimitiveExtension

S = TypeVar("S", bound=Symbol)


@dataclass(frozen=True, slots=True)
class Context:
    """The context of a text: its namespace, and the namespaces that it uses."""

    namespace: str = NULL
    uses: tuple[str, ...] = ()


@dataclass(slots=True, eq=False, repr=False)
class Scope:
    """The definitions of a program, or of the library on which programs are layered.

    A layer is filled by the definition pass. `parent` is never written to.

    Attributes:
        parent: The layer below, already resolved.
        types: Types by simple name.
        behaviors: Scenarios and actions of all actors, by simple name.
        modifiers: Modifiers by simple name.
        globals: Global parameters by simple name.
        units: Units; one namespace for the whole program (§7.3.4).
        primitives: Primitive types with methods of their own.
        exports: The exports of each namespace; an item without name is a star.
        named_exports: Exports of single names, which `exports` fills into `exports`.
        contexts: The context of each declaration and each member of a type.
        declared: Symbols in the order of their declarations.
        nodes: The declaration of each of them.
        enum_nodes: The declarations of enum members.
        extensions: Extensions in source order.
        extended: Symbols of the layers below that this layer extends.
        physical_types: The declared type of each dimension.
        overridden: The methods that methods of extensions replace.
    """

    parent: Scope | None = None
    types: dict[str, list[NamedSymbol]] = field(default_factory=dict)
    behaviors: dict[str, list[CallableBehavior]] = field(default_factory=dict)
    modifiers: dict[str, list[ModifierSymbol]] = field(default_factory=dict)
    globals: dict[str, list[FieldSymbol]] = field(default_factory=dict)
    units: dict[str, UnitSymbol] = field(default_factory=dict)
    primitives: dict[str, PrimitiveSymbol] = field(default_factory=dict)
    namespaces: set[str] = field(default_factory=lambda: {NULL})
    exports: dict[str, set[tuple[str, str | None]]] = field(default_factory=dict)
    named_exports: list[tuple[ast.ExportItem, Context]] = field(default_factory=list)
    contexts: dict[ast.Node, Context] = field(default_factory=dict)
    declared: list[Symbol] = field(default_factory=list)
    nodes: dict[Symbol, ast.Declaration] = field(default_factory=dict)
    enum_nodes: dict[EnumMemberSymbol, ast.EnumMember] = field(default_factory=dict)
    extensions: list[Extension] = field(default_factory=list)
    extended: list[TypeSymbol | EnumSymbol] = field(default_factory=list)
    physical_types: dict[Dimension, PhysicalType] = field(default_factory=dict)
    overridden: dict[MethodSymbol, MethodSymbol] = field(default_factory=dict)

    def layers(self) -> Iterator[Scope]:
        """Yield this layer, then those below."""
        layer: Scope | None = self
        while layer is not None:
            yield layer
            layer = layer.parent

    def types_named(self, text: str) -> list[NamedSymbol]:
        """Return all types of a simple name, in any namespace."""
        return [s for layer in self.layers() for s in layer.types.get(text, ())]

    def behaviors_named(self, text: str) -> list[CallableBehavior]:
        """Return all scenarios and actions of a simple name."""
        return [s for layer in self.layers() for s in layer.behaviors.get(text, ())]

    def modifiers_named(self, text: str) -> list[ModifierSymbol]:
        """Return all modifiers of a simple name."""
        return [s for layer in self.layers() for s in layer.modifiers.get(text, ())]

    def globals_named(self, text: str) -> list[FieldSymbol]:
        """Return all global parameters of a simple name."""
        return [s for layer in self.layers() for s in layer.globals.get(text, ())]

    def unit_named(self, text: str) -> UnitSymbol | None:
        """Return the unit of that name."""
        for layer in self.layers():
            if unit := layer.units.get(text):
                return unit
        return None

    def primitive_named(self, text: str) -> PrimitiveSymbol | None:
        """Return the methods that a primitive type got by extension."""
        for layer in self.layers():
            if symbol := layer.primitives.get(text):
                return symbol
        return None

    def enum_members_named(self, text: str) -> list[EnumMemberSymbol]:
        """Return the members of that name of all enums."""
        return [
            symbol.members[text]
            for layer in self.layers()
            for symbol in layer.declared
            if isinstance(symbol, EnumSymbol) and text in symbol.members
        ]

    def all_units(self) -> Iterator[UnitSymbol]:
        """Yield every unit of the program."""
        for layer in self.layers():
            yield from layer.units.values()

    def has_namespace(self, name: str) -> bool:
        """Whether some statement opened that namespace."""
        return any(name in layer.namespaces for layer in self.layers())

    def enum_node(self, member: EnumMemberSymbol) -> ast.EnumMember | None:
        """Return the declaration of an enum member."""
        for layer in self.layers():
            if node := layer.enum_nodes.get(member):
                return node
        return None

    def own_types(self) -> list[TypeSymbol]:
        """Return the types that this layer declares or extends."""
        symbols = (*self.declared, *self.primitives.values(), *self.extended)
        return [s for s in symbols if isinstance(s, TypeSymbol)]

    def context_of(self, node: ast.Node) -> Context:
        """Return the context of a declaration or member."""
        for layer in self.layers():
            if node in layer.contexts:
                return layer.contexts[node]
        return Context()

    def physical_type(self, dimension: Dimension) -> PhysicalType:
        """Return the declared physical type of a dimension, or the bare dimension."""
        for layer in self.layers():
            if dimension in layer.physical_types:
                return layer.physical_types[dimension]
        return PhysicalType("", dimension)

    def is_exported(self, namespace: str, symbol: Symbol) -> bool:
        """Whether a namespace offers a symbol to those that use it (§7.7.4)."""
        item, star = (symbol.namespace, symbol.name), (symbol.namespace, None)
        for layer in self.layers():
            offered = layer.exports.get(namespace)
            if offered is not None and (item in offered or star in offered):
                return True
        return False

    def select(self, candidates: Sequence[S], name: ast.Name, context: Context) -> list[S]:
        """Return those candidates of one simple name that a place means by `name`."""
        if name.namespace is not None:
            return [
                s
                for s in candidates
                if s.namespace == name.namespace or self.is_exported(name.namespace, s)
            ]
        own = [s for s in candidates if s.namespace == context.namespace]
        if own:
            return own
        if not context.uses:
            return []
        return [s for s in candidates if any(self.is_exported(ns, s) for ns in context.uses)]


def supertypes(symbol: TypeSymbol) -> Iterator[TypeSymbol]:
    """Yield a type and its supertypes, the most derived first; cycles end the walk."""
    yield symbol  # before the set is made: mostly the walk ends here
    # Not by `base_of`: this is asked hundreds of times a line.
    current = symbol.base if isinstance(symbol, _DERIVED) else None
    if current is None:
        return
    seen = {symbol}
    while current is not None and current not in seen:
        seen.add(current)
        yield current
        current = current.base if isinstance(current, _DERIVED) else None


_DERIVED = (StructSymbol, ActorSymbol, ScenarioSymbol, ActionSymbol)


def base_of(symbol: TypeSymbol) -> TypeSymbol | None:
    """Return the supertype of a type."""
    return symbol.base if isinstance(symbol, _DERIVED) else None


def is_subtype(symbol: TypeSymbol, ancestor: TypeSymbol) -> bool:
    """Whether a type is another one or derives from it."""
    return symbol is ancestor or any(s is ancestor for s in supertypes(symbol))
