"""Declarations at file level (§7.2.2.1, §7.7)."""

from __future__ import annotations

from osc2tx.diagnostics import Span
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr.OpenSCENARIO2 import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Tree
from osc2tx.syntax.ast_builder.behaviors import BehaviorBuilder
from osc2tx.syntax.ast_builder.enums import PRIMITIVES, EnumBuilder
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Head
from osc2tx.syntax.literals import string_value


class DeclarationBuilder(BehaviorBuilder, EnumBuilder):
    """Builds imports, namespaces and type declarations."""

    def _import(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        what = tree.children[1]
        self._refuse_block(tree)
        if isinstance(what, int):
            uri = string_value(self._text(what))
            return ast.Import(**head.fields(), uri=uri, module=())
        module = self._dotted(what, "the name of a module")
        return ast.Import(**head.fields(), uri=None, module=module)

    def _namespace(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        uses: list[str] = []
        for child in tree.children:
            if child.__class__ is Grammar.DottedNameContext:
                path = self._dotted(child, "a namespace")
                if len(path) > 1:
                    message = "the name of a namespace has no dots"
                    help_ = f"list the namespaces: `use {', '.join(path)}`"
                    self._report("OSC100", self._tree_span(child), message, help_)
                uses.extend(path)
        self._refuse_block(tree)
        name = self._plain_name(tree.children[1], "a namespace")
        return ast.NamespaceStatement(**head.fields(), name=name, uses=tuple(uses))

    def _use(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        """`use a.b`: a dialect may allow it, so the next stage judges (OSC110)."""
        self._refuse_block(tree)
        paths = [c for c in tree.children if c.__class__ is Grammar.DottedNameContext]
        path = self._dotted(paths[0], "a namespace")
        return ast.UseStatement(**head.fields(), path=path)

    def _export(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        self._refuse_block(tree)
        items = tuple(
            self._export_item(child)
            for child in tree.children
            if child.__class__ is Grammar.ExportItemContext
        )
        return ast.ExportStatement(**head.fields(), items=items)

    def _export_item(self, tree: Tree) -> ast.ExportItem:
        token = tree.children[0]
        span = self._tree_span(tree)
        if self._types[token] == t.ID:
            name = self._name(token)
            return ast.ExportItem(span=span, namespace=name.namespace, name=name.text)
        if self._types[token] == t.NAMESPACE_STAR:
            namespace = self._text(token)[: -len("::*")].strip("|")
            return ast.ExportItem(span=span, namespace=namespace or "null", name=None)
        return ast.ExportItem(span=span, namespace=None, name=None)

    def _global(self, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
        inner = tree.children[1]
        span = self._tree_span(inner)
        if inner.children[-1].__class__ is not Grammar.TypedRestContext:
            help_ = "`global name: type = value`"
            self._report("OSC100", span, "`global` declares a parameter", help_)
            self._name_statement(inner, Head(span), Place.NOWHERE)
            return None
        parameter = self._field(inner, Head(span))
        if parameter is None:
            return None
        return ast.GlobalParameter(**head.fields(), parameter=parameter)

    # --- Structured types -----------------------------------------------------------------------

    def _struct(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        name, base, condition = self._plain_header(tree, "a struct")
        members = self._body(tree.children[-1], Place.STRUCT, f"`struct {name}`")
        return ast.StructDeclaration(
            **head.fields(), name=name, base=base, condition=condition, members=members
        )

    def _actor(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        name, base, condition = self._plain_header(tree, "an actor")
        members = self._body(tree.children[-1], Place.ACTOR, f"`actor {name}`")
        return ast.ActorDeclaration(
            **head.fields(), name=name, base=base, condition=condition, members=members
        )

    def _scenario(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        name, base, condition = self._header(tree)
        body = tree.children[-1]
        members = self._body(body, Place.BEHAVIOR, f"`scenario {name}`")
        return ast.ScenarioDeclaration(
            **head.fields(),
            name=name,
            base=base,
            condition=condition,
            members=members,
            end_comments=self._block_end(self._block_of(body)),
        )

    def _action(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        name, base, condition = self._header(tree)
        members = self._body(tree.children[-1], Place.BEHAVIOR, f"`action {name}`")
        return ast.ActionDeclaration(
            **head.fields(), name=name, base=base, condition=condition, members=members
        )

    def _modifier(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        children = tree.children
        name = self._behavior_name(children[1])
        behavior = self._behavior_name(children[3]) if len(children) == 5 else None
        members = self._body(children[-1], Place.MODIFIER, f"`modifier {name}`")
        return ast.ModifierDeclaration(
            **head.fields(), name=name, behavior=behavior, members=members
        )

    def _extension(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        name = self._behavior_name(tree.children[1])
        enum_members = self._enum_members_of(tree)
        if enum_members is not None:
            enum = self._without_actor(name, "an enumeration")
            members = self._enum_members(enum_members, head)
            self._refuse_block(tree)
            return ast.EnumExtension(**head.fields(), name=enum, members=members)
        shown = f"`extend {name}`"
        if name.actor is None and name.name.namespace is None and name.name.text in PRIMITIVES:
            block = self._check_body(tree, shown, optional=False)
            methods = self._block(block, Place.PRIMITIVE)
            return ast.PrimitiveExtension(
                **head.fields(), primitive=name.name.text, members=methods
            )
        block = self._check_body(tree, shown, optional=False)
        return ast.TypeExtension(
            **head.fields(), name=name, members=self._block(block, Place.EXTENSION)
        )

    def _header(
        self, tree: Tree
    ) -> tuple[ast.BehaviorName, ast.BehaviorName | None, ast.InheritanceCondition | None]:
        """Build name, base and condition of a declaration."""
        name = self._behavior_name(tree.children[1])
        inheritance = tree.children[2]
        if inheritance.__class__ is not Grammar.InheritanceContext:
            return name, None, None
        children = inheritance.children
        base = self._behavior_name(children[1])
        condition = self._inheritance_condition(children[3]) if len(children) > 2 else None
        return name, base, condition

    def _plain_header(
        self, tree: Tree, what: str
    ) -> tuple[ast.Name, ast.Name | None, ast.InheritanceCondition | None]:
        """As `_header`, for types that belong to no actor."""
        name, base, condition = self._header(tree)
        plain_base = self._without_actor(base, what) if base is not None else None
        return self._without_actor(name, what), plain_base, condition

    def _without_actor(self, name: ast.BehaviorName, what: str) -> ast.Name:
        if name.actor is not None:
            self._report("OSC100", name.span, f"the name of {what} has no dot in it")
        return name.name

    def _inheritance_condition(self, tree: Tree) -> ast.InheritanceCondition | None:
        expression = self._expression(tree)
        span: Span = self._tree_span(tree)
        match expression:
            case ast.Binary(
                operator=ast.BinaryOperator.EQUAL,
                left=ast.NameExpression(name=field),
                right=(ast.EnumLiteral() | ast.NameExpression() | ast.BoolLiteral()) as value,
            ):
                return ast.InheritanceCondition(span=span, field=field, value=value)
        message = "the condition of an inheritance compares a field with a literal"
        self._report("OSC100", span, message, "`inherits base(field == literal)`")
        return None
