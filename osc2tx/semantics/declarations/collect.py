"""The definition pass: makes a symbol for every declaration of a file, in source order.

Nothing is looked up here except namespaces; types, bases and actors are names until `resolve`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from typing import assert_never

from osc2tx.diagnostics import DiagnosticSink, Label
from osc2tx.diagnostics.fixes import write
from osc2tx.semantics.declarations.members import Basics, make_field, members_of
from osc2tx.semantics.declarations.redeclarations import Repeats
from osc2tx.semantics.dialects import Relaxations
from osc2tx.semantics.scope import NULL, Context, NamedSymbol, Scope
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    EnumMemberSymbol,
    EnumSymbol,
    EventSymbol,
    LabelSymbol,
    Member,
    MethodSymbol,
    ModifierSymbol,
    PhysicalTypeSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
    TypeSymbol,
    UnitSymbol,
)
from osc2tx.semantics.types import SI_BASES, Dimension, PhysicalType
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

LIBRARY_NAMESPACES = ("std", "stdtypes")
NULL_USES = "namespace null use std, stdtypes"


@dataclass(slots=True, eq=False)
class Collector:
    """Fills a scope from files.

    Attributes:
        scope: The layer to fill.
        sink: Receives the diagnostics.
        relaxations: The dialect of the file.
        origin: `"user"`, `"library"` or `"prelude"`.
        null_uses: The `use` list of the null namespace at the start of a file (`import
            osc.standard`).
    """

    scope: Scope
    sink: DiagnosticSink
    relaxations: Relaxations
    origin: str = "user"
    null_uses: tuple[str, ...] = ()
    _repeats: Repeats = field(init=False)

    def __post_init__(self) -> None:
        """Make the judge of repeated declarations."""
        self._repeats = Repeats(self.sink, self.relaxations)

    def collect_file(self, file: ast.File) -> None:
        """Define everything that a file declares."""
        context = Context(NULL, self.null_uses)
        for statement in file.statements:
            match statement:
                case ast.NamespaceStatement():
                    context = self._enter_namespace(statement)
                case ast.UseStatement():
                    self._check_use(statement)
                    context = Context(context.namespace, (*context.uses, *statement.path))
                case ast.ExportStatement():
                    self.scope.contexts[statement] = context
                    self._collect_export(statement, context)
                case _:
                    self.scope.contexts[statement] = context
                    self._collect_declaration(statement, context)

    def _enter_namespace(self, statement: ast.NamespaceStatement) -> Context:
        if self.origin == "user" and statement.name.startswith("std"):
            self.sink.report(
                "OSC207",
                statement.span,
                f"namespace `{statement.name}` is reserved for the standard library",
                help="choose a name that does not start with `std`",
            )
        self.scope.namespaces.add(statement.name)
        implied = self.null_uses if self.relaxations.dialect.unprefixed_library else ()
        return Context(statement.name, (*statement.uses, *implied))

    def _check_use(self, statement: ast.UseStatement) -> None:
        path = ".".join(statement.path)
        if "OSC601" in self.relaxations.dialect.relaxed:
            if self.relaxations.is_new("OSC601", statement.span.source.name, path):
                self.sink.report(
                    "OSC601", statement.span, f"`use {path}` is not in the standard; it is skipped"
                )
            return
        self.sink.report(
            "OSC110",
            statement.span,
            f"`use {path}` is not a statement",
            help=write(
                statement.span,
                NULL_USES,
                f"write `{NULL_USES}` below the imports",
                is_safe=False,
            ),
        )

    def _collect_export(self, statement: ast.ExportStatement, context: Context) -> None:
        offered = self.scope.exports.setdefault(context.namespace, set())
        for item in statement.items:
            if item.name is None:
                offered.add((item.namespace or context.namespace, None))
            else:
                self.scope.named_exports.append((item, context))

    def _collect_declaration(self, node: ast.Declaration, context: Context) -> None:
        match node:
            case ast.PhysicalTypeDeclaration():
                self._collect_physical_type(node, context)
            case ast.UnitDeclaration():
                self._collect_unit(node, context)
            case ast.EnumDeclaration():
                self._collect_enum(node, context)
            case ast.StructDeclaration():
                struct = StructSymbol(**self._basics(node.name, context), condition=node.condition)
                self._define_type(struct, node)
                self.collect_body(struct, node.members, context)
            case ast.ActorDeclaration() if self._repeats.actor(node, self.scope):
                pass
            case ast.ModifierDeclaration() if self._repeats.modifier(node, self.scope):
                pass
            case ast.ActorDeclaration():
                actor = ActorSymbol(**self._basics(node.name, context), condition=node.condition)
                self._define_type(actor, node)
                self.collect_body(actor, node.members, context)
            case ast.ScenarioDeclaration() | ast.ActionDeclaration():
                self._collect_behavior(node, context)
            case ast.ModifierDeclaration():
                self._collect_modifier(node, context)
            case ast.EnumExtension() | ast.TypeExtension() | ast.PrimitiveExtension():
                self.scope.extensions.append(node)
            case ast.GlobalParameter():
                self._collect_global(node, context)
            case _:
                assert_never(node)

    def _basics(self, name: ast.Name, context: Context) -> Basics:
        return Basics(
            name=name.text,
            namespace=name.namespace or context.namespace,
            span=name.span,
            origin=self.origin,
        )

    def _define(self, symbol: Symbol, node: ast.Declaration) -> None:
        self.scope.declared.append(symbol)
        self.scope.nodes[symbol] = node

    def _define_type(self, symbol: NamedSymbol, node: ast.Declaration) -> None:
        self._define(symbol, node)
        if self._is_unique(symbol, self.scope.types_named(symbol.name)):
            self.scope.types.setdefault(symbol.name, []).append(symbol)

    def _is_unique(self, symbol: Symbol, others: Sequence[Symbol]) -> bool:
        """Report a name that its namespace has already; the first definition counts."""
        for other in others:
            if other.namespace == symbol.namespace:
                if not self._repeats.physical_type(symbol, other):
                    report_duplicate(self.sink, symbol, other)
                return False
        return True

    def _collect_physical_type(self, node: ast.PhysicalTypeDeclaration, context: Context) -> None:
        dimension = dimension_of(node.exponents)
        symbol = PhysicalTypeSymbol(**self._basics(node.name, context), dimension=dimension)
        self._define_type(symbol, node)
        self.scope.physical_types.setdefault(dimension, PhysicalType(symbol.name, dimension))

    def _collect_unit(self, node: ast.UnitDeclaration, context: Context) -> None:
        symbol = UnitSymbol(
            **self._basics(node.name, context), factor=node.factor, offset=node.offset
        )
        self._define(symbol, node)
        if earlier := self.scope.unit_named(symbol.name):
            if not self._repeats.unit(symbol, dimension_of(node.exponents), earlier):
                report_duplicate(self.sink, symbol, earlier)
            return
        self.scope.units[symbol.name] = symbol

    def _collect_enum(self, node: ast.EnumDeclaration, context: Context) -> None:
        symbol = EnumSymbol(**self._basics(node.name, context))
        self._define_type(symbol, node)
        self.collect_enum_members(symbol, node.members, context)

    def collect_enum_members(
        self, symbol: EnumSymbol, members: Sequence[ast.EnumMember], context: Context
    ) -> None:
        """Add members, all with value 0; the resolution pass counts them."""
        for member in members:
            item = EnumMemberSymbol(**self._basics(member.name, context), enum=symbol, value=0)
            if earlier := symbol.members.get(item.name):
                report_duplicate(self.sink, item, earlier)
                continue
            symbol.members[item.name] = item
            self.scope.enum_nodes[item] = member
            self.scope.contexts[member] = context

    def _collect_behavior(
        self, node: ast.ScenarioDeclaration | ast.ActionDeclaration, context: Context
    ) -> None:
        basics = self._basics(node.name.name, context)
        symbol: ScenarioSymbol | ActionSymbol
        if isinstance(node, ast.ScenarioDeclaration):
            symbol = ScenarioSymbol(**basics, node=node, condition=node.condition)
        else:
            symbol = ActionSymbol(**basics, node=node, condition=node.condition)
        known = self.scope.types_named(symbol.name)
        self._define(symbol, node)
        if node.name.actor is not None or self._is_unique(symbol, known):
            self.scope.behaviors.setdefault(symbol.name, []).append(symbol)
            if node.name.actor is None:
                self.scope.types.setdefault(symbol.name, []).append(symbol)
        self.collect_body(symbol, node.members, context)

    def _collect_modifier(self, node: ast.ModifierDeclaration, context: Context) -> None:
        symbol = ModifierSymbol(**self._basics(node.name.name, context), node=node)
        self._define(symbol, node)
        self.scope.modifiers.setdefault(symbol.name, []).append(symbol)
        self.collect_body(symbol, node.members, context)

    def _collect_global(self, node: ast.GlobalParameter, context: Context) -> None:
        parameter = node.parameter
        self.scope.contexts[parameter] = context
        for name in parameter.names:
            symbol = make_field(self._basics(name, context), None, parameter)
            self._define(symbol, node)
            if self._is_unique(symbol, self.scope.globals_named(symbol.name)):
                self.scope.globals.setdefault(symbol.name, []).append(symbol)

    def collect_body(
        self,
        owner: TypeSymbol,
        statements: Sequence[ast.Statement],
        context: Context,
        *,
        extends: bool = False,
    ) -> None:
        """Add the members of a type, or of an extension of it, which may override methods."""
        for statement in statements:
            self.scope.contexts[statement] = context
            owner.statements.append(statement)
            for member in members_of(statement, owner, context, self.origin):
                if extends:
                    self._take_namespace(owner, member, context)
                self._add_member(owner, member, extends)

    def _take_namespace(self, owner: TypeSymbol, member: Member, context: Context) -> None:
        """Take the name of a method that overrides one of a used namespace for that one's."""
        if not isinstance(member, MethodSymbol) or member.node is None or not member.node.is_only:
            return
        methods = [each for each in owner.named(member.name) if isinstance(each, MethodSymbol)]
        meant = self.scope.select(methods, member.node.name, context)
        if len({each.namespace for each in meant}) == 1:
            member.namespace = meant[0].namespace

    def _check_parameters(self, member: Member) -> None:
        """Report parameters of a method or event that have the same name."""
        if not isinstance(member, MethodSymbol | EventSymbol):
            return
        seen: dict[str, Symbol] = {}
        for parameter in member.parameters:
            earlier = seen.setdefault(parameter.name, parameter)
            if earlier is not parameter:
                report_duplicate(self.sink, parameter, earlier)

    def _add_member(self, owner: TypeSymbol, member: Member, extends: bool) -> None:
        self._check_parameters(member)
        key = member.name
        earlier = owner.members.get(key)
        if earlier is not None and earlier.namespace != member.namespace:
            key = f"{member.namespace}::{member.name}"
            earlier = owner.members.get(key)
        replaces = earlier is not None and self.origin == "prelude" and earlier.origin == "library"
        if extends and isinstance(member, MethodSymbol) and isinstance(earlier, MethodSymbol):
            self.scope.overridden[member] = earlier
        elif earlier is not None and self._is_repeated_label(member, earlier):
            return
        elif earlier is not None and not replaces:
            report_duplicate(self.sink, member, earlier)
            return
        owner.members[key] = member
        if key != member.name:
            same_name = owner.namesakes.setdefault(member.name, [])
            same_name[:] = [*(each for each in same_name if each is not earlier), member]

    def _is_repeated_label(self, member: Member, earlier: Member) -> bool:
        """Whether the dialect allows a repeated label; its name denotes the first one."""
        if not isinstance(member, LabelSymbol) or not isinstance(earlier, LabelSymbol):
            return False
        if "OSC625" not in self.relaxations.dialect.relaxed:
            return False
        self.sink.report(
            "OSC625",
            member.span,
            f"label `{member.name}` is used twice; its name means the first one",
            labels=(Label(earlier.span, "first used here"),),
            help="give each member a label of its own",
        )
        return True


def dimension_of(exponents: Sequence[ast.SiExponent]) -> Dimension:
    """Return the dimension that a list of exponents means."""
    given = {e.base: e.exponent for e in exponents}
    return Dimension(tuple(given.get(base, 0) for base in SI_BASES))


def report_duplicate(sink: DiagnosticSink, symbol: Symbol, earlier: Symbol) -> None:
    """Report a second definition of a name."""
    sink.report(
        "OSC203",
        symbol.span,
        f"`{symbol.name}` is defined twice",
        labels=(Label(earlier.span, "first defined here"),),
    )
