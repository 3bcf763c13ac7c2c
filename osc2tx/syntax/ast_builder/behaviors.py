"""Behavior: `do`, `on`, compositions, directives, and all that begins with a name (§7.3.13)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from osc2tx.diagnostics.fixes import write
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Builder, StatementBuilder, Tree
from osc2tx.syntax.ast_builder.events import build_event_specification, call_parts
from osc2tx.syntax.ast_builder.expressions import build_arguments, build_expression
from osc2tx.syntax.ast_builder.members import build_with_block, report_empty_parentheses
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import (
    Head,
    build_block,
    build_in_place,
    check_body,
    comments_at_end,
    refuse_block,
)

_COLON = t.PUNCTUATION[":"]


def _on(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    event = build_event_specification(b, tree.children[1])
    block = check_body(b, tree.children[2], "`on`", optional=False)
    members = build_block(b, block, Place.ON)
    return ast.OnDirective(**head.fields(), event=event, members=members)


def _do(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
    children = tree.children
    if b.type_at(children[1]) == _COLON:
        member: Any = _implicit_serial(b, tree)
    else:
        inner = children[1]
        member = build_in_place(b, inner, Head(b.tree_span(inner)), Place.DO)
    return None if member is None else ast.DoDirective(**head.fields(), member=member)


def _implicit_serial(b: Builder, tree: Tree) -> ast.Composition:
    """`do:` without an operator, as in some examples of the standard."""
    colon = tree.children[1]
    message = "`do:` without an operator is taken as `do serial:`"
    span = b.span(tree.start, colon)
    b.report("OSC113", span, message, write(span, "do serial:"))
    return _members_of(b, tree, Head(b.span(colon, b.last_token(tree))), None, "serial", ())


def _composition(
    b: Builder, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
) -> ast.Statement:
    arguments: tuple[ast.Argument, ...] = ()
    for child in tree.children:
        if child.__class__ is Grammar.ArgumentsContext:
            arguments = build_arguments(b, child)
    for argument in arguments:
        if argument.name is not None and argument.name.namespace is not None:
            message = "the arguments of a composition have plain names"
            b.report("OSC100", argument.name.span, message)
    word = b.text_of(tree.children[0])
    return _members_of(b, tree, head, label, word, arguments)


def _members_of(
    b: Builder,
    tree: Tree,
    head: Head,
    label: ast.Name | None,
    word: str,
    arguments: tuple[ast.Argument, ...],
) -> ast.Composition:
    block = check_body(b, tree, f"`{word}`", optional=False)
    end_comments = comments_at_end(b, block)
    members = build_block(b, block, Place.DO)
    with_members: Any = ()
    if tree.children[-1].__class__ is Grammar.WithBlockContext:
        with_members = build_with_block(b, tree.children[-1], Place.WITH)
    return ast.Composition(
        **head.fields(),
        label=label,
        operator=ast.CompositionOperator(word),
        arguments=arguments,
        members=members,
        with_members=with_members,
        end_comments=end_comments,
    )


def _wait(
    b: Builder, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
) -> ast.Statement:
    event = build_event_specification(b, tree.children[1])
    refuse_block(b, tree)
    return ast.WaitDirective(**head.fields(), label=label, event=event)


def _until(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    event = build_event_specification(b, tree.children[1])
    refuse_block(b, tree)
    return ast.UntilDirective(**head.fields(), event=event)


def _emit(
    b: Builder, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
) -> ast.Statement | None:
    expression = build_expression(b, tree.children[1])
    refuse_block(b, tree)
    arguments: tuple[ast.Argument, ...] = ()
    event = expression
    if isinstance(expression, ast.Call):
        event, arguments = expression.callee, expression.arguments
        if not arguments:
            last = b.last_token(tree.children[1])
            report_empty_parentheses(b, b.span(last - 1, last))
    if isinstance(event, ast.NameExpression):
        return ast.EmitDirective(
            **head.fields(), label=label, event=event.name, arguments=arguments
        )
    message = "`emit` takes the name of an event, not a path or an expression"
    help_ = "a scenario emits events that it declares or inherits"
    b.report("OSC100", event.span, message, help_)
    return None


def _call_directive(
    b: Builder, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
) -> ast.Statement | None:
    expression = build_expression(b, tree.children[1])
    refuse_block(b, tree)
    if isinstance(expression, ast.Call):
        method, arguments = expression.callee, expression.arguments
    else:
        method, arguments = expression, ()
        if isinstance(method, (ast.NameExpression, ast.MemberAccess)):
            call_parts(b, expression, "the call")
    if isinstance(method, (ast.NameExpression, ast.MemberAccess)):
        return ast.CallDirective(**head.fields(), label=label, method=method, arguments=arguments)
    b.report("OSC100", method.span, "`call` takes a method: `call object.method()`")
    return None


BUILDERS: Mapping[type, StatementBuilder] = {
    Grammar.OnDirectiveContext: _on,
    Grammar.DoDirectiveContext: _do,
    Grammar.CompositionContext: _composition,
    Grammar.WaitDirectiveContext: _wait,
    Grammar.EmitDirectiveContext: _emit,
    Grammar.CallDirectiveContext: _call_directive,
    Grammar.UntilDirectiveContext: _until,
}
