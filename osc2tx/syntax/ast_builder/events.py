"""Event specifications and calls, behind `wait`, `until`, `on`, `call`, `emit`."""

from __future__ import annotations

from typing import NamedTuple

from osc2tx.diagnostics.fixes import insert_before
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax.ast_builder.base import Builder, Tree
from osc2tx.syntax.ast_builder.expressions import build_expression, is_named
from osc2tx.syntax.syntax_errors import shortened

_AT, _ASSIGN, _COLON = (t.PUNCTUATION[text] for text in ["@", "=", ":"])
_AS, _IF = t.KEYWORDS["as"], t.KEYWORDS["if"]
_CONDITIONS: dict[
    str, type[ast.RiseCondition] | type[ast.FallCondition] | type[ast.ElapsedCondition]
] = {
    "rise": ast.RiseCondition,
    "fall": ast.FallCondition,
    "elapsed": ast.ElapsedCondition,
}


class CallParts(NamedTuple):
    """`actor.name(arguments)` in its parts."""

    actor: ast.Expression | None
    name: ast.Name
    arguments: tuple[ast.Argument, ...]


def build_event_specification(b: Builder, tree: Tree) -> ast.EventSpecification:
    """Build `@event as field if condition` or a condition alone."""
    children = tree.children
    span = b.tree_span(tree)
    kinds = [b.type_at(child) for child in children]
    if kinds[0] != _AT and len(children) == 1:
        condition = _condition(b, children[0])
        return ast.EventSpecification(span=span, event=None, field=None, condition=condition)
    path = _event_path(b, children[1 if kinds[0] == _AT else 0])
    if kinds[0] != _AT:
        help_ = insert_before(path.span, "@", "write `@event`")
        b.report("OSC100", path.span, "`@` is missing before the event", help_)
    field = b.name(children[kinds.index(_AS) + 1]) if _AS in kinds else None
    clause = _condition(b, children[-1]) if _IF in kinds else None
    if field is not None and clause is None:
        message = "an event field `as …` needs a condition `if …`"
        b.report("OSC100", field.span, message)
    return ast.EventSpecification(span=span, event=path, field=field, condition=clause)


def _event_path(b: Builder, tree: Tree) -> ast.Expression:
    path = build_expression(b, tree)
    if not isinstance(path, (ast.NameExpression, ast.MemberAccess)):
        message = "the name of an event follows `@`"
        help_ = "a condition follows after `if`: `@event if condition`"
        b.report("OSC100", path.span, message, help_)
    return path


def _condition(b: Builder, tree: Tree) -> ast.EventCondition:
    expression = build_expression(b, tree)
    if isinstance(expression, ast.Call) and isinstance(expression.callee, ast.NameExpression):
        if is_named(expression.callee, "every"):
            return _every(b, expression)
        for word, node in _CONDITIONS.items():
            if is_named(expression.callee, word):
                return _edge(b, expression, word, node)
    return ast.LevelCondition(span=b.tree_span(tree), expression=expression)


def _edge(
    b: Builder,
    call: ast.Call,
    word: str,
    node: type[ast.RiseCondition] | type[ast.FallCondition] | type[ast.ElapsedCondition],
) -> ast.EventCondition:
    if len(call.arguments) != 1 or call.arguments[0].name is not None:
        help_ = "`elapsed(5s)`" if word == "elapsed" else f"`{word}(distance < 5m)`"
        message = f"`{word}` takes one expression in its parentheses"
        b.report("OSC100", call.span, message, help_)
        if not call.arguments:
            return ast.LevelCondition(span=call.span, expression=call)
    value = call.arguments[0].value
    if node is ast.ElapsedCondition:
        return ast.ElapsedCondition(span=call.span, duration=value)
    if node is ast.FallCondition:
        return ast.FallCondition(span=call.span, expression=value)
    return ast.RiseCondition(span=call.span, expression=value)


def _every(b: Builder, call: ast.Call) -> ast.EventCondition:
    period, *rest = call.arguments or (None,)
    offset = rest[0] if rest else None
    fits = period is not None and period.name is None and len(rest) <= 1
    if offset is not None and (offset.name is None or offset.name.text != "offset"):
        fits = False
    if not fits:
        message = "`every` takes a period, and perhaps an offset"
        b.report("OSC100", call.span, message, "`every(5s, offset: 1s)`")
    if period is None:
        return ast.LevelCondition(span=call.span, expression=call)
    return ast.EveryCondition(
        span=call.span, period=period.value, offset=offset.value if offset else None
    )


# --- Calls ----------------------------------------------------------------------------------


def call_parts(
    b: Builder, expression: ast.Expression, what: str, *, in_type: bool = False
) -> CallParts | None:
    """Split `actor.name(arguments)`; missing parentheses are reported and accepted.

    Args:
        b: The builder.
        expression: The expression.
        what: The required construct.
        in_type: Whether a field is possible there as well.
    """
    callee: ast.Expression = expression
    arguments: tuple[ast.Argument, ...] = ()
    if isinstance(expression, ast.Call):
        callee, arguments = expression.callee, expression.arguments
    parts: CallParts | None = None
    match callee:
        case ast.NameExpression(name=name):
            parts = CallParts(None, name, arguments)
        case ast.MemberAccess(base=base, name=name):
            parts = CallParts(base, name, arguments)
    if parts is None:
        _report_no_call(b, expression, what)
    elif callee is expression:
        shown = shortened(expression.span.text)
        message = f"missing parentheses after `{shown}`"
        help_ = f"write {what} as `{shown}()`"
        if isinstance(callee, ast.NameExpression) and in_type:
            message = f"`{shown}` alone has no meaning"
            help_ = f"a field has a type, `{shown}: type`; a modifier is `{shown}(…)`"
            parts = None
        b.report("OSC100", expression.span, message, help_)
    return parts


def _report_no_call(b: Builder, expression: ast.Expression, what: str) -> None:
    help_ = None
    if isinstance(expression, ast.Binary):
        help_ = "a constraint is written `keep(…)`"
    message = f"expected {what}, found an expression"
    b.report("OSC100", expression.span, message, help_)


def build_parameters(b: Builder, tree: Tree) -> tuple[ast.ParameterSpecification, ...]:
    """Build the formal parameters in a context `parameters`."""
    return tuple(_parameter(b, child) for child in tree.children[::2])


def _parameter(b: Builder, tree: Tree) -> ast.ParameterSpecification:
    children = tree.children
    return ast.ParameterSpecification(
        span=b.tree_span(tree),
        name=b.name(children[0]),
        type=b.type_name(children[2]),
        default=build_expression(b, children[4]) if len(children) > 3 else None,
    )
