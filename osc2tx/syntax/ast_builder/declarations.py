"""Declarations at file level (§7.2.2.1, §7.7)."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.diagnostics import Span
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Builder, StatementBuilder, Tree
from osc2tx.syntax.ast_builder.enums import PRIMITIVES, build_enum_members
from osc2tx.syntax.ast_builder.expressions import build_expression
from osc2tx.syntax.ast_builder.names import build_field, build_name_statement
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import (
    Head,
    block_of,
    build_block,
    build_body,
    check_body,
    comments_at_end,
    enum_members_of,
    refuse_block,
)
from osc2tx.syntax.literals import string_value


def _import(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    what = tree.children[1]
    refuse_block(b, tree)
    if isinstance(what, int):
        uri = string_value(b.text_of(what))
        return ast.Import(**head.fields(), uri=uri, module=())
    module = b.dotted(what, "the name of a module")
    return ast.Import(**head.fields(), uri=None, module=module)


def _namespace(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    uses: list[str] = []
    for child in tree.children:
        if child.__class__ is Grammar.DottedNameContext:
            path = b.dotted(child, "a namespace")
            if len(path) > 1:
                message = "the name of a namespace has no dots"
                help_ = f"list the namespaces: `use {', '.join(path)}`"
                b.report("OSC100", b.tree_span(child), message, help_)
            uses.extend(path)
    refuse_block(b, tree)
    name = b.plain_name(tree.children[1], "a namespace")
    return ast.NamespaceStatement(**head.fields(), name=name, uses=tuple(uses))


def _use(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    """`use a.b`: a dialect may allow it, so the next stage judges (OSC110)."""
    refuse_block(b, tree)
    paths = [c for c in tree.children if c.__class__ is Grammar.DottedNameContext]
    path = b.dotted(paths[0], "a namespace")
    return ast.UseStatement(**head.fields(), path=path)


def _export(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    refuse_block(b, tree)
    items = tuple(
        _export_item(b, child)
        for child in tree.children
        if child.__class__ is Grammar.ExportItemContext
    )
    return ast.ExportStatement(**head.fields(), items=items)


def _export_item(b: Builder, tree: Tree) -> ast.ExportItem:
    token = tree.children[0]
    span = b.tree_span(tree)
    if b.types[token] == t.ID:
        name = b.name(token)
        return ast.ExportItem(span=span, namespace=name.namespace, name=name.text)
    if b.types[token] == t.NAMESPACE_STAR:
        namespace = b.text_of(token)[: -len("::*")].strip("|")
        return ast.ExportItem(span=span, namespace=namespace or "null", name=None)
    return ast.ExportItem(span=span, namespace=None, name=None)


def _global(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
    inner = tree.children[1]
    span = b.tree_span(inner)
    if inner.children[-1].__class__ is not Grammar.TypedRestContext:
        help_ = "`global name: type = value`"
        b.report("OSC100", span, "`global` declares a parameter", help_)
        build_name_statement(b, inner, Head(span), Place.NOWHERE)
        return None
    parameter = build_field(b, inner, Head(span))
    if parameter is None:
        return None
    return ast.GlobalParameter(**head.fields(), parameter=parameter)


# --- Structured types -----------------------------------------------------------------------


def _struct(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    name, base, condition = _plain_header(b, tree, "a struct")
    members = build_body(b, tree.children[-1], Place.STRUCT, f"`struct {name}`")
    return ast.StructDeclaration(
        **head.fields(), name=name, base=base, condition=condition, members=members
    )


def _actor(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    name, base, condition = _plain_header(b, tree, "an actor")
    members = build_body(b, tree.children[-1], Place.ACTOR, f"`actor {name}`")
    return ast.ActorDeclaration(
        **head.fields(), name=name, base=base, condition=condition, members=members
    )


def _scenario(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    name, base, condition = _header(b, tree)
    body = tree.children[-1]
    end_comments = comments_at_end(b, block_of(b, body))
    members = build_body(b, body, Place.BEHAVIOR, f"`scenario {name}`")
    return ast.ScenarioDeclaration(
        **head.fields(),
        name=name,
        base=base,
        condition=condition,
        members=members,
        end_comments=end_comments,
    )


def _action(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    name, base, condition = _header(b, tree)
    members = build_body(b, tree.children[-1], Place.BEHAVIOR, f"`action {name}`")
    return ast.ActionDeclaration(
        **head.fields(), name=name, base=base, condition=condition, members=members
    )


def _modifier(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    children = tree.children
    name = b.behavior_name(children[1])
    behavior = b.behavior_name(children[3]) if len(children) == 5 else None
    members = build_body(b, children[-1], Place.MODIFIER, f"`modifier {name}`")
    return ast.ModifierDeclaration(**head.fields(), name=name, behavior=behavior, members=members)


def _extension(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    name = b.behavior_name(tree.children[1])
    enum_members = enum_members_of(b, tree)
    if enum_members is not None:
        enum = _without_actor(b, name, "an enumeration")
        members, head = build_enum_members(b, enum_members, head)
        refuse_block(b, tree)
        return ast.EnumExtension(**head.fields(), name=enum, members=members)
    shown = f"`extend {name}`"
    if name.actor is None and name.name.namespace is None and name.name.text in PRIMITIVES:
        block = check_body(b, tree, shown, optional=False)
        methods = build_block(b, block, Place.PRIMITIVE)
        return ast.PrimitiveExtension(**head.fields(), primitive=name.name.text, members=methods)
    block = check_body(b, tree, shown, optional=False)
    return ast.TypeExtension(
        **head.fields(), name=name, members=build_block(b, block, Place.EXTENSION)
    )


def _header(
    b: Builder, tree: Tree
) -> tuple[ast.BehaviorName, ast.BehaviorName | None, ast.InheritanceCondition | None]:
    """Build name, base and condition of a declaration."""
    name = b.behavior_name(tree.children[1])
    inheritance = tree.children[2]
    if inheritance.__class__ is not Grammar.InheritanceContext:
        return name, None, None
    children = inheritance.children
    base = b.behavior_name(children[1])
    condition = _inheritance_condition(b, children[3]) if len(children) > 2 else None
    return name, base, condition


def _plain_header(
    b: Builder, tree: Tree, what: str
) -> tuple[ast.Name, ast.Name | None, ast.InheritanceCondition | None]:
    """As `_header`, for types that belong to no actor."""
    name, base, condition = _header(b, tree)
    plain_base = _without_actor(b, base, what) if base is not None else None
    return _without_actor(b, name, what), plain_base, condition


def _without_actor(b: Builder, name: ast.BehaviorName, what: str) -> ast.Name:
    if name.actor is not None:
        b.report("OSC100", name.span, f"the name of {what} has no dot in it")
    return name.name


def _inheritance_condition(b: Builder, tree: Tree) -> ast.InheritanceCondition | None:
    expression = build_expression(b, tree)
    span: Span = b.tree_span(tree)
    match expression:
        case ast.Binary(
            operator=ast.BinaryOperator.EQUAL,
            left=ast.NameExpression(name=field),
            right=(ast.EnumLiteral() | ast.NameExpression() | ast.BoolLiteral()) as value,
        ):
            return ast.InheritanceCondition(span=span, field=field, value=value)
    message = "the condition of an inheritance compares a field with a literal"
    b.report("OSC100", span, message, "`inherits base(field == literal)`")
    return None


BUILDERS: Mapping[type, StatementBuilder] = {
    Grammar.ImportStatementContext: _import,
    Grammar.NamespaceStatementContext: _namespace,
    Grammar.UseStatementContext: _use,
    Grammar.ExportStatementContext: _export,
    Grammar.StructDeclarationContext: _struct,
    Grammar.ActorDeclarationContext: _actor,
    Grammar.ScenarioDeclarationContext: _scenario,
    Grammar.ActionDeclarationContext: _action,
    Grammar.ModifierDeclarationContext: _modifier,
    Grammar.ExtensionContext: _extension,
    Grammar.GlobalParameterContext: _global,
}
