"""Behavior: `do`, `on`, compositions, directives, and all that begins with a name (§7.3.13)."""

from __future__ import annotations

from typing import Any

from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr.OpenSCENARIO2 import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Tree
from osc2tx.syntax.ast_builder.names import NameStatementBuilder
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Head

_COLON = t.PUNCTUATION[":"]


class BehaviorBuilder(NameStatementBuilder):
    """Builds what stands in and around `do`."""

    def _on(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        event = self._event_specification(tree.children[1])
        block = self._check_body(tree.children[2], "`on`", optional=False)
        members = self._block(block, Place.ON)
        return ast.OnDirective(**head.fields(), event=event, members=members)

    def _do(self, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
        children = tree.children
        if self._types_of(children[1]) == _COLON:
            member: Any = self._implicit_serial(tree)
        else:
            inner = children[1]
            member = self._build(inner, Head(self._tree_span(inner)), Place.DO)
        return None if member is None else ast.DoDirective(**head.fields(), member=member)

    def _implicit_serial(self, tree: Tree) -> ast.Composition:
        """`do:` without an operator, as in some examples of the standard."""
        colon = tree.children[1]
        message = "`do:` without an operator is taken as `do serial:`"
        self._report("OSC113", self._span(tree.start, colon), message, "write `do serial:`")
        return self._members_of(tree, Head(self._span(colon, self._last(tree))), None, "serial", ())

    def _composition(
        self, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
    ) -> ast.Statement:
        arguments: tuple[ast.Argument, ...] = ()
        for child in tree.children:
            if child.__class__ is Grammar.ArgumentsContext:
                arguments = self._arguments(child)
        for argument in arguments:
            if argument.name is not None and argument.name.namespace is not None:
                message = "the arguments of a composition have plain names"
                self._report("OSC100", argument.name.span, message)
        word = self._text(tree.children[0])
        return self._members_of(tree, head, label, word, arguments)

    def _members_of(
        self,
        tree: Tree,
        head: Head,
        label: ast.Name | None,
        word: str,
        arguments: tuple[ast.Argument, ...],
    ) -> ast.Composition:
        block = self._check_body(tree, f"`{word}`", optional=False)
        members = self._block(block, Place.DO)
        end_comments = self._block_end(block)
        with_members: Any = ()
        if tree.children[-1].__class__ is Grammar.WithBlockContext:
            with_members = self._with_block(tree.children[-1], Place.WITH)
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
        self, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
    ) -> ast.Statement:
        event = self._event_specification(tree.children[1])
        self._refuse_block(tree)
        return ast.WaitDirective(**head.fields(), label=label, event=event)

    def _until(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        event = self._event_specification(tree.children[1])
        self._refuse_block(tree)
        return ast.UntilDirective(**head.fields(), event=event)

    def _emit(
        self, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
    ) -> ast.Statement | None:
        expression = self._expression(tree.children[1])
        self._refuse_block(tree)
        arguments: tuple[ast.Argument, ...] = ()
        event = expression
        if isinstance(expression, ast.Call):
            event, arguments = expression.callee, expression.arguments
            if not arguments:
                last = self._last(tree.children[1])
                self._report_empty_parentheses(self._span(last - 1, last))
        if isinstance(event, ast.NameExpression):
            return ast.EmitDirective(
                **head.fields(), label=label, event=event.name, arguments=arguments
            )
        message = "`emit` takes the name of an event, not a path or an expression"
        help_ = "a scenario emits events that it declares or inherits"
        self._report("OSC100", event.span, message, help_)
        return None

    def _call_directive(
        self, tree: Tree, head: Head, place: Place, label: ast.Name | None = None
    ) -> ast.Statement | None:
        expression = self._expression(tree.children[1])
        self._refuse_block(tree)
        if isinstance(expression, ast.Call):
            method, arguments = expression.callee, expression.arguments
        else:
            method, arguments = expression, ()
            if isinstance(method, (ast.NameExpression, ast.MemberAccess)):
                self._call_parts(expression, "the call")
        if isinstance(method, (ast.NameExpression, ast.MemberAccess)):
            return ast.CallDirective(
                **head.fields(), label=label, method=method, arguments=arguments
            )
        self._report("OSC100", method.span, "`call` takes a method: `call object.method()`")
        return None

    def _labelled(
        self, tree: Tree, head: Head, place: Place, label: ast.Name
    ) -> ast.Statement | None:
        """Build the keyword member behind `label:`."""
        match tree:
            case Grammar.CompositionContext():
                return self._composition(tree, head, place, label)
            case Grammar.WaitDirectiveContext():
                return self._wait(tree, head, place, label)
            case Grammar.EmitDirectiveContext():
                return self._emit(tree, head, place, label)
        return self._call_directive(tree, head, place, label)
