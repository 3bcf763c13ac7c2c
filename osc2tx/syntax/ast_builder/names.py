"""Statements that begin with a name: fields, modifier applications, invocations, labels.

The grammar has one rule for all; the kind of their block distinguishes them (language reference
§2.8): in a type body `a: b` is a field, inside `do` it is a label with its member.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Help, leave_out, write
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Builder, StatementBuilder, Tree
from osc2tx.syntax.ast_builder.enums import PRIMITIVES
from osc2tx.syntax.ast_builder.events import call_parts
from osc2tx.syntax.ast_builder.expressions import build_expression
from osc2tx.syntax.ast_builder.members import build_ending, refuse_with
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Head
from osc2tx.syntax.syntax_errors import describe_token, shortened

_COLON, _DOT = t.PUNCTUATION[":"], t.PUNCTUATION["."]
_FIELDS = frozenset({Place.STRUCT, Place.ACTOR, Place.BEHAVIOR, Place.MODIFIER, Place.EXTENSION})
_APPLICATIONS = (_FIELDS - {Place.STRUCT}) | {Place.WITH}
# Types as other languages write them; compiled on the first type that is none of ours.
_BRACKETED_TYPE = r"(?:list)?\[(\w+)\]"
_COUNTED_TYPE = r"(\w+)\[(\d+)\]"
_BOUNDED_TYPE = r"(\w+) +in +(\[[^\n]{1,60}\])"
_COMPARED_TYPE = r"(\w+) *== *(.{1,40})"
_WITH_WORDS = {
    "duration": "the duration is an argument of the invocation: `(duration: …)`",
    "until": "write `until …` without a colon",
}


def build_name_statement(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
    """Build a statement that begins with a name, by the kind of its block."""
    children = tree.children
    rest = children[-1]
    if b.type_at(children[-2]) != _COLON if len(children) > 1 else True:
        return _plain(b, tree, head, place)
    if place is Place.DO:
        label = _only_name(b, children, "a label")
        if label is None:
            return None
        if rest.__class__ is not Grammar.TypedRestContext:
            return _labelled(b, rest, head, place, label)
        return _invocation_rest(b, rest, head, label)
    if rest.__class__ is not Grammar.TypedRestContext:
        _report_place(b, head, tree, place, f"`{b.text_of(rest.start)}`")
        _labelled(b, rest, head, Place.NOWHERE, b.name(tree.start))
        return None
    if place not in _FIELDS:
        _report_place(b, head, tree, place, "a field declaration")
        if place is not Place.WITH:
            build_field(b, tree, head)
        return None
    return build_field(b, tree, head)


def _labelled(
    b: Builder, tree: Tree, head: Head, place: Place, label: ast.Name
) -> ast.Statement | None:
    """Build the keyword member behind `label:`."""
    node: ast.Statement | None = b.builders[tree.__class__](b, tree, head, place, label=label)
    return node


def _report_place(b: Builder, head: Head, tree: Tree, place: Place, what: str) -> None:
    if place is Place.NOWHERE:
        return
    help_: Help = None
    if place is Place.FILE:
        help_ = "put it into a scenario; a global parameter begins with `global`"
    elif place is Place.ON:
        help_ = "an `on` block holds `call …` and `emit …`"
    elif place is Place.WITH:
        word = b.text_of(tree.start)
        help_ = _WITH_WORDS.get(word, f"a modifier is applied with parentheses: `{word}(…)`")
        if word == "until" and b.types[tree.start + 1] == _COLON:
            help_ = leave_out(b.span(tree.start + 1, tree.start + 1), _WITH_WORDS[word])
    span = b.span(tree.start, tree.start)
    b.report("OSC108", span, f"{what} does not belong {place.value}", help_)


# --- Without colon --------------------------------------------------------------------------


def _plain(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
    """An invocation or a modifier application, by place."""
    children = tree.children
    if len(children) > 2:
        span = b.tree_span(children[0])
        b.report("OSC100", span, "names in a list need a `: type` behind them")
        return None
    expression = build_expression(b, children[0])
    if place is not Place.DO and place not in _APPLICATIONS:
        _report_place(b, head, tree, place, f"`{shortened(expression.span.text)}`")
        build_ending(b, children[1], Place.NOWHERE)
        return None
    what = "an invocation" if place is Place.DO else "a modifier application"
    parts = call_parts(b, expression, what, in_type=place in _FIELDS)
    if place is Place.DO:
        return _invocation(b, parts, head, children[1], None)
    refuse_with(b, children[1], "a modifier application")
    if parts is None:
        return None
    actor, name, arguments = parts
    return ast.ModifierApplication(**head.fields(), actor=actor, modifier=name, arguments=arguments)


def _invocation_rest(b: Builder, tree: Tree, head: Head, label: ast.Name) -> ast.Statement | None:
    """Build the invocation behind a label."""
    children = tree.children
    if len(children) != 2 or b.text_of(tree.start) in PRIMITIVES:
        span = b.span(children[0] if isinstance(children[0], int) else tree.start, tree.start)
        help_ = "declare fields in the body of the scenario, above `do`"
        b.report("OSC108", span, "a field declaration does not belong inside `do`", help_)
        build_ending(b, children[-1], Place.NOWHERE)
        return None
    parts = call_parts(b, build_expression(b, children[0]), "an invocation")
    return _invocation(b, parts, head, children[1], label)


def _invocation(
    b: Builder, parts: Any, head: Head, ending: Tree, label: ast.Name | None
) -> ast.Statement | None:
    with_members: Any = build_ending(b, ending, Place.WITH)
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


def build_field(b: Builder, tree: Tree, head: Head) -> ast.ParameterDeclaration | None:
    """Build `names: type = default with: …`."""
    *listed, _, rest = tree.children
    names = [_declared_name(b, child, "a field") for child in listed[::2]]
    children = rest.children
    type_ = _field_type(b, children)
    default = None
    if children[-2].__class__ is Grammar.ExpressionContext and len(children) >= 4:
        default = build_expression(b, children[-2])
    constraints: Any = build_ending(b, children[-1], Place.FIELD_WITH)
    if type_ is None or None in names:
        return None
    return ast.ParameterDeclaration(
        **head.fields(),
        names=tuple(name for name in names if name is not None),
        type=type_,
        default=default,
        constraints=constraints,
    )


def _field_type(b: Builder, children: list[Tree]) -> ast.TypeName | None:
    first = children[0]
    if isinstance(first, int):
        end = next(i for i, c in enumerate(children) if c.__class__ is Grammar.BehaviorNameContext)
        return b.typed(children[: end + 1])
    parts = first.children
    kinds = [b.type_at(part) for part in parts]
    if kinds == [t.ID]:
        name = b.name(parts[0])
        path = ast.BehaviorName(span=name.span, actor=None, name=name)
        return ast.NamedType(span=name.span, name=path)
    if kinds == [t.ID, _DOT, t.ID]:
        span = b.tree_span(first)
        actor, name = b.name(parts[0]), b.name(parts[2])
        return ast.NamedType(span=span, name=ast.BehaviorName(span=span, actor=actor, name=name))
    _report_no_type(b, first)
    return None


def _report_no_type(b: Builder, tree: Tree) -> None:
    expression = build_expression(b, tree)
    if isinstance(expression, ast.Call):
        message = "a label belongs inside `do`; a member has none"
        b.report("OSC108", expression.span, message)
        return
    found = describe_token(b.table, tree.start)
    span: Span = b.tree_span(tree)
    help_: Help = "a field is declared `name: type = value`"
    if listed := re.fullmatch(_BRACKETED_TYPE, span.text):
        help_ = write(span, f"list of {listed[1]}")
    elif listed := re.fullmatch(_COUNTED_TYPE, span.text):
        help_ = _with_constraint(b, span, f"list of {listed[1]}", f"it.size() == {listed[2]}")
    elif bounded := re.fullmatch(_BOUNDED_TYPE, span.text):
        help_ = _with_constraint(b, span, bounded[1], f"it in {bounded[2]}")
    elif compared := re.fullmatch(_COMPARED_TYPE, span.text):
        given = f"{compared[1]} = {compared[2]}"
        help_ = write(span, given, f"a value is given with one `=`: `{given}`")
    b.report("OSC100", span, f"expected a type name, found {found}", help_)


def _with_constraint(b: Builder, span: Span, type_: str, constraint: str) -> Help:
    """Return the remedy that declares a field with a constraint on its value."""
    help_ = f"write `{type_} with:`, and `keep({constraint})` below"
    return write(span, f"{type_} with:\n{b.table.below(span.start)}keep({constraint})", help_)


def _only_name(b: Builder, children: list[Tree], what: str) -> ast.Name | None:
    if len(children) > 3:
        message = "a list of names does not belong inside `do`"
        help_ = "declare fields in the body of the scenario, above `do`"
        b.report("OSC108", b.tree_span(children[0]), message, help_)
        return None
    return _declared_name(b, children[0], what)


def _declared_name(b: Builder, tree: Tree, what: str) -> ast.Name | None:
    if len(tree.children) == 1 and b.type_at(tree.children[0]) == t.ID:
        return b.name(tree.children[0])
    span = b.tree_span(tree)
    message = f"the name of {what} is a single name"
    if span.text[:1].isdigit():
        message = f"`{span.text}` is no name: one begins with a letter or `_`"
    b.report("OSC100", span, message)
    return None


BUILDERS: Mapping[type, StatementBuilder] = {
    Grammar.NameStatementContext: build_name_statement,
}
