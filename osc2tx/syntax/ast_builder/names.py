"""Statements that begin with a name: fields, modifier applications, invocations, labels.

The grammar reads them all by one rule; the kind of block they stand in tells them apart (language
reference §2.8): in a type body `a: b` is a field, inside `do` it is a label and what it names.
"""

from __future__ import annotations

import re
from abc import abstractmethod
from typing import Any

from osc2tx.diagnostics import Span
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr.OpenSCENARIO2 import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Tree
from osc2tx.syntax.ast_builder.enums import PRIMITIVES
from osc2tx.syntax.ast_builder.members import MemberBuilder
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Head
from osc2tx.syntax.syntax_errors import describe_token, shortened

_COLON, _DOT = t.PUNCTUATION[":"], t.PUNCTUATION["."]
_FIELDS = frozenset({Place.STRUCT, Place.ACTOR, Place.BEHAVIOR, Place.MODIFIER, Place.EXTENSION})
_APPLICATIONS = (_FIELDS - {Place.STRUCT}) | {Place.WITH}
_BRACKETED_TYPE = re.compile(r"(?:list)?\[(\w+)\]")
_COMPARED_TYPE = re.compile(r"(\w+) *== *(.{1,40})")
_WITH_WORDS = {
    "duration": "how long is an argument of what is invoked: `(duration: …)`",
    "until": "write `until …` without a colon",
}


class NameStatementBuilder(MemberBuilder):
    """Builds the statements that begin with a name."""

    @abstractmethod
    def _labelled(
        self, tree: Tree, head: Head, place: Place, label: ast.Name
    ) -> ast.Statement | None: ...

    def _name_statement(self, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
        children = tree.children
        rest = children[-1]
        if self._types_of(children[-2]) != _COLON if len(children) > 1 else True:
            return self._plain(tree, head, place)
        if place is Place.DO:
            label = self._only_name(children, "a label")
            if label is None:
                return None
            if rest.__class__ is not Grammar.TypedRestContext:
                return self._labelled(rest, head, place, label)
            return self._invocation_rest(rest, head, label)
        if rest.__class__ is not Grammar.TypedRestContext:
            self._report_place(head, tree, place, f"`{self._text(rest.start)}`")
            self._labelled(rest, head, Place.NOWHERE, self._name(tree.start))
            return None
        if place not in _FIELDS:
            self._report_place(head, tree, place, "a field declaration")
            if place is not Place.WITH:
                self._field(tree, head)
            return None
        return self._field(tree, head)

    def _report_place(self, head: Head, tree: Tree, place: Place, what: str) -> None:
        if place is Place.NOWHERE:
            return
        help_ = None
        if place is Place.FILE:
            help_ = "put it into a scenario; a global parameter begins with `global`"
        elif place is Place.ON:
            help_ = "an `on` block holds `call …` and `emit …`"
        elif place is Place.WITH:
            word = self._text(tree.start)
            help_ = _WITH_WORDS.get(word, f"a modifier is applied with parentheses: `{word}(…)`")
        span = self._span(tree.start, tree.start)
        self._report("OSC108", span, f"{what} does not belong {place.value}", help_)

    # --- Without colon --------------------------------------------------------------------------

    def _plain(self, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
        """An invocation or a modifier application, by place."""
        children = tree.children
        if len(children) > 2:
            span = self._tree_span(children[0])
            self._report("OSC100", span, "names in a list need a `: type` behind them")
            return None
        expression = self._expression(children[0])
        if place is not Place.DO and place not in _APPLICATIONS:
            self._report_place(head, tree, place, f"`{shortened(expression.span.text)}`")
            self._ending(children[1], Place.NOWHERE)
            return None
        what = "an invocation" if place is Place.DO else "a modifier application"
        parts = self._call_parts(expression, what, in_type=place in _FIELDS)
        if place is Place.DO:
            return self._invocation(parts, head, children[1], None)
        self._refuse_with(children[1], "a modifier application")
        if parts is None:
            return None
        actor, name, arguments = parts
        return ast.ModifierApplication(
            **head.fields(), actor=actor, modifier=name, arguments=arguments
        )

    def _invocation_rest(self, tree: Tree, head: Head, label: ast.Name) -> ast.Statement | None:
        """Build the invocation behind a label."""
        children = tree.children
        if len(children) != 2 or self._text(tree.start) in PRIMITIVES:
            span = self._span(
                children[0] if isinstance(children[0], int) else tree.start, tree.start
            )
            help_ = "declare fields in the body of the scenario, above `do`"
            self._report("OSC108", span, "a field declaration does not belong inside `do`", help_)
            self._ending(children[-1], Place.NOWHERE)
            return None
        parts = self._call_parts(self._expression(children[0]), "an invocation")
        return self._invocation(parts, head, children[1], label)

    def _invocation(
        self, parts: Any, head: Head, ending: Tree, label: ast.Name | None
    ) -> ast.Statement | None:
        with_members: Any = self._ending(ending, Place.WITH)
        if parts is None:
            return None
        return ast.Invocation(
            **head.fields(),
            label=label,
            actor=parts.actor,
            behavior=parts.name,
            arguments=parts.arguments,
            with_members=with_members,
        )

    # --- Fields ---------------------------------------------------------------------------------

    def _field(self, tree: Tree, head: Head) -> ast.ParameterDeclaration | None:
        """Build `names: type = default with: …`."""
        *listed, _, rest = tree.children
        names = [self._declared_name(child, "a field") for child in listed[::2]]
        children = rest.children
        type_ = self._field_type(children)
        default = None
        if children[-2].__class__ is Grammar.ExpressionContext and len(children) >= 4:
            default = self._expression(children[-2])
        constraints: Any = self._ending(children[-1], Place.FIELD_WITH)
        if type_ is None or None in names:
            return None
        return ast.ParameterDeclaration(
            **head.fields(),
            names=tuple(name for name in names if name is not None),
            type=type_,
            default=default,
            constraints=constraints,
        )

    def _field_type(self, children: list[Tree]) -> ast.TypeName | None:
        first = children[0]
        if isinstance(first, int):
            end = next(
                i for i, c in enumerate(children) if c.__class__ is Grammar.BehaviorNameContext
            )
            return self._typed(children[: end + 1])
        parts = first.children
        kinds = [self._types_of(part) for part in parts]
        if kinds == [t.ID]:
            name = self._name(parts[0])
            path = ast.BehaviorName(span=name.span, actor=None, name=name)
            return ast.NamedType(span=name.span, name=path)
        if kinds == [t.ID, _DOT, t.ID]:
            span = self._tree_span(first)
            actor, name = self._name(parts[0]), self._name(parts[2])
            return ast.NamedType(
                span=span, name=ast.BehaviorName(span=span, actor=actor, name=name)
            )
        self._report_no_type(first)
        return None

    def _report_no_type(self, tree: Tree) -> None:
        expression = self._expression(tree)
        if isinstance(expression, ast.Call):
            message = "a label belongs inside `do`; a member has none"
            self._report("OSC108", expression.span, message)
            return
        found = describe_token(self._table, tree.start)
        span: Span = self._tree_span(tree)
        help_ = "a field is declared `name: type = value`"
        if listed := _BRACKETED_TYPE.fullmatch(span.text):
            help_ = f"write `list of {listed[1]}`"
        elif compared := _COMPARED_TYPE.fullmatch(span.text):
            help_ = f"a value is given with one `=`: `{compared[1]} = {compared[2]}`"
        self._report("OSC100", span, f"expected a type name, found {found}", help_)

    def _only_name(self, children: list[Tree], what: str) -> ast.Name | None:
        if len(children) > 3:
            message = "a list of names does not belong inside `do`"
            help_ = "declare fields in the body of the scenario, above `do`"
            self._report("OSC108", self._tree_span(children[0]), message, help_)
            return None
        return self._declared_name(children[0], what)

    def _declared_name(self, tree: Tree, what: str) -> ast.Name | None:
        if len(tree.children) == 1 and self._types_of(tree.children[0]) == t.ID:
            return self._name(tree.children[0])
        span = self._tree_span(tree)
        message = f"the name of {what} is a single name"
        if span.text[:1].isdigit():
            message = f"`{span.text}` is no name: one begins with a letter or `_`"
        self._report("OSC100", span, message)
        return None
