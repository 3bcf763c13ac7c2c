"""Expressions: operator precedence over the flat lists of the grammar (§7.4)."""

from __future__ import annotations

from typing import NamedTuple

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import leave_out, write
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax.ast_builder.base import Builder, Tree
from osc2tx.syntax.literals import (
    MAX_NEGATED,
    MAX_UINT,
    integer_value,
    is_integer,
    split_name,
    split_physical,
    string_value,
)

MAX_PREFIXES = 200

_NAMED = "an argument is written `name: value`, where `name` is that of a parameter"
_LEVELS = ("=>", "or", "and", "not", "== != < <= > >= in", "+ -", "* / %")
_PRECEDENCE: dict[int, int] = {}
_OPERATORS: dict[int, ast.BinaryOperator] = {}
for _level, _signs in enumerate(_LEVELS):
    for _sign in _signs.split():
        _type = t.KEYWORDS.get(_sign) or t.PUNCTUATION[_sign]
        _PRECEDENCE[_type] = _level
        if _sign != "not":
            _OPERATORS[_type] = ast.BinaryOperator(_sign)

_IMPLIES = t.PUNCTUATION["=>"]
_NOT, _AS = t.KEYWORDS["not"], t.KEYWORDS["as"]
_MINUS, _PLUS, _COLON = (t.PUNCTUATION[text] for text in ["-", "+", ":"])
_DOT, _BANG, _LPAREN, _LBRACKET, _QUESTION, _DOTS = (
    t.PUNCTUATION[text] for text in [".", "!", "(", "[", "?", ".."]
)
_NOT_LEVEL = _PRECEDENCE[_NOT]
_NEGATE_LEVEL = len(_LEVELS)
_NUMBERS = (t.INTEGER, t.FLOAT, t.PHYSICAL)


class _Operand(NamedTuple):
    """An operand with its extent, parentheses around it included."""

    node: ast.Expression
    start: int
    end: int


class _Pending(NamedTuple):
    """An operator that waits for its right operand; `start` is set for prefix operators."""

    level: int
    binary: ast.BinaryOperator | None
    unary: ast.UnaryOperator | None
    start: int


def build_expression(b: Builder, tree: Tree) -> ast.Expression:
    """Build an expression."""
    children = tree.children
    if len(children) == 1:
        return _operand(b, children[0])
    if len(children) > 4 and b.type_at(children[-4]) == _QUESTION:
        condition = _chain(b, children[:-4])
        when_true = build_expression(b, children[-3])
        when_false = build_expression(b, children[-1])
        return ast.Conditional(
            span=b.tree_span(tree),
            condition=condition,
            when_true=when_true,
            when_false=when_false,
        )
    return _chain(b, children)


def _chain(b: Builder, children: list[Tree]) -> ast.Expression:
    """Resolve the precedence of a flat row of operators and operands."""
    operands: list[_Operand] = []
    pending: list[_Pending] = []
    position, size = 0, len(children)
    while position < size:
        position = _prefixes(b, children, position, pending)
        child = children[position]
        node = _operand(b, child)
        start = b.starts[child if isinstance(child, int) else child.start]
        position += 1
        while position < size and b.types[children[position]] not in _OPERATORS:
            node, position = _postfix(b, node, start, children, position)
        if position == size and not pending:
            return node
        last = children[position - 1]
        end = b.ends[last if isinstance(last, int) else last.stop]
        operands.append(_Operand(node, start, end))
        if position == size:
            break
        kind = b.types[children[position]]
        level = _PRECEDENCE[kind]
        _reduce(b, operands, pending, level + 1 if kind == _IMPLIES else level)
        pending.append(_Pending(level, _OPERATORS[kind], None, 0))
        position += 1
    _reduce(b, operands, pending, 0)
    return operands[0].node


def _prefixes(b: Builder, children: list[Tree], position: int, pending: list[_Pending]) -> int:
    first = position
    while (kind := b.type_at(children[position])) in (_NOT, _MINUS, _PLUS):
        start = b.starts[children[position]]
        if kind == _PLUS:
            _check_plus(b, children, position)
        elif kind == _NOT:
            if pending and pending[-1].level > _NOT_LEVEL:
                message = "`not` binds weaker than the operator before it"
                span = b.span(children[position], children[position])
                b.report("OSC100", span, message, "put `(not …)` in parentheses")
            pending.append(_Pending(_NOT_LEVEL, None, ast.UnaryOperator.NOT, start))
        else:
            pending.append(_Pending(_NEGATE_LEVEL, None, ast.UnaryOperator.NEGATE, start))
        position += 1
    if position - first > MAX_PREFIXES:
        message = f"more than {MAX_PREFIXES} prefix operators in a row"
        b.report("OSC105", b.span(children[first], children[position - 1]), message)
        kept = len(pending) - (position - first) + MAX_PREFIXES
        del pending[max(kept, 0) :]
    return position


def _check_plus(b: Builder, children: list[Tree], position: int) -> None:
    """`+` is a sign of floats only (§7.2.1.5.2)."""
    after = children[position + 1]
    kind = b.types[after] if isinstance(after, int) else None
    text = b.text_of(after) if isinstance(after, int) else ""
    span = b.span(children[position], children[position])
    if kind not in _NUMBERS and text not in ("inf", "nan"):
        b.report("OSC100", span, "a sign `+` precedes only a number")
    elif kind == t.INTEGER or (kind == t.PHYSICAL and is_integer(split_physical(text)[0])):
        message = "a sign `+` precedes only numbers with a point or an exponent"
        b.report("OSC100", span, message, leave_out(span, f"write `{text}`"))


def _reduce(b: Builder, operands: list[_Operand], pending: list[_Pending], level: int) -> None:
    """Apply the waiting operators that bind at least as strongly as `level`."""
    while pending and pending[-1].level >= level:
        operator = pending.pop()
        right = operands.pop()
        if operator.binary is not None:
            left = operands.pop()
            start = left.start
            node: ast.Expression = ast.Binary(
                span=Span(b.source, start, right.end),
                operator=operator.binary,
                left=left.node,
                right=right.node,
            )
        else:
            assert operator.unary is not None
            _check_negated(b, operator, right.node)
            start = operator.start
            span = Span(b.source, start, right.end)
            node = ast.Unary(span=span, operator=operator.unary, operand=right.node)
        operands.append(_Operand(node, start, right.end))


def _check_negated(b: Builder, operator: _Pending, operand: ast.Expression) -> None:
    is_negated = operator.unary is ast.UnaryOperator.NEGATE
    if is_negated and isinstance(operand, ast.IntegerLiteral) and operand.value > MAX_NEGATED:
        span = Span(b.source, operator.start, operand.span.end)
        b.report("OSC107", span, "the number does not fit a signed integer of 64 bits")


# --- Operands -------------------------------------------------------------------------------


def _operand(b: Builder, child: Tree) -> ast.Expression:
    if not isinstance(child, int):
        return _group(b, child)
    kind = b.types[child]
    span = Span(b.source, b.starts[child], b.ends[child])
    text = b.code[span.start : span.end]
    if kind == t.ID:
        return _word(b, child, text, span)
    if kind == t.STRING:
        return ast.StringLiteral(span=span, value=string_value(text))
    if kind == t.INTEGER:
        return ast.IntegerLiteral(span=span, value=_integer(b, text, span))
    if kind == t.FLOAT:
        return ast.FloatLiteral(span=span, value=_float(b, text, span))
    return _physical(b, text, span)


def _word(b: Builder, token: int, text: str, span: Span) -> ast.Expression:
    if text == "it":
        return ast.ItExpression(span=span)
    if text in ("true", "false"):
        return ast.BoolLiteral(span=span, value=text == "true")
    if text in ("inf", "nan"):
        return ast.FloatLiteral(span=span, value=float(text))
    return ast.NameExpression(span=span, name=b.name(token))


def _integer(b: Builder, text: str, span: Span) -> int:
    value = integer_value(text)
    if value is None or value > MAX_UINT:
        b.report("OSC107", span, "the number does not fit an integer of 64 bits")
        return MAX_UINT
    return value


def _float(b: Builder, text: str, span: Span) -> float:
    value = float(text)
    if value == float("inf"):
        message = "the number is too large for a float of 64 bits"
        help_ = write(span, "inf", "write `inf` for an infinite value", is_safe=False)
        b.report("OSC107", span, message, help_)
    return value


def _physical(b: Builder, text: str, span: Span) -> ast.Expression:
    number, unit = split_physical(text)
    value = _integer(b, number, span) if is_integer(number) else _float(b, number, span)
    namespace, name = split_name(unit)
    unit_span = Span(b.source, span.start + len(number), span.end)
    unit_name = ast.Name(span=unit_span, text=name, namespace=namespace)
    return ast.PhysicalLiteral(span=span, value=value, unit=unit_name)


def _group(b: Builder, tree: Tree) -> ast.Expression:
    """`( e )`, `[ a, b ]` or `[ a .. b ]`."""
    children = tree.children
    if b.types[children[0]] == _LPAREN:
        return build_expression(b, children[1])
    span = b.tree_span(tree)
    if len(children) > 3 and b.types[children[2]] == _DOTS:
        lower, upper = build_expression(b, children[1]), build_expression(b, children[3])
        return ast.RangeLiteral(span=span, lower=lower, upper=upper)
    elements = tuple(build_expression(b, child) for child in children[1:-1:2])
    if len(children) == 2:
        b.report("OSC100", span, "a list needs at least one element")
        elements = ()
    return ast.ListLiteral(span=span, elements=elements)


# --- Postfix forms --------------------------------------------------------------------------


def _postfix(
    b: Builder, base: ast.Expression, start: int, children: list[Tree], position: int
) -> tuple[ast.Expression, int]:
    """Apply one postfix form; return the result and the position behind it."""
    kind = b.types[children[position]]
    if kind == _DOT:
        word = children[position + 1]
        if b.types[word] == t.ID:
            name = b.name(word)
            span = Span(b.source, start, name.span.end)
            return ast.MemberAccess(span=span, base=base, name=name), position + 2
        type_ = b.type_name(children[position + 3])
        node = ast.Cast if b.types[word] == _AS else ast.TypeTest
        span = Span(b.source, start, b.ends[children[position + 4]])
        return node(span=span, base=base, type=type_), position + 5
    if kind == _BANG:
        return _enum_literal(b, base, children[position + 1]), position + 2
    if kind == _LBRACKET:
        index = build_expression(b, children[position + 1])
        span = Span(b.source, start, b.ends[children[position + 2]])
        return ast.Index(span=span, base=base, index=index), position + 3
    has_arguments = not isinstance(children[position + 1], int)
    arguments = build_arguments(b, children[position + 1]) if has_arguments else ()
    end = position + (2 if has_arguments else 1)
    span = Span(b.source, start, b.ends[children[end]])
    return _call(b, span, base, arguments), end + 1


def _enum_literal(b: Builder, base: ast.Expression, member: int) -> ast.Expression:
    name = b.name(member)
    span = base.span.to(name.span)
    if isinstance(base, ast.NameExpression):
        return ast.EnumLiteral(span=span, enum=base.name, member=name)
    b.report("OSC100", base.span, "the name of an enumeration precedes `!`")
    return base


def _call(
    b: Builder, span: Span, callee: ast.Expression, arguments: tuple[ast.Argument, ...]
) -> ast.Expression:
    if is_named(callee, "range") and len(arguments) == 2:
        lower, upper = arguments
        if lower.name is None and upper.name is None:
            return ast.RangeLiteral(span=span, lower=lower.value, upper=upper.value)
    return ast.Call(span=span, callee=callee, arguments=arguments)


def build_arguments(b: Builder, tree: Tree) -> tuple[ast.Argument, ...]:
    """Positional arguments first, then named ones."""
    children = tree.children
    arguments: list[ast.Argument] = []
    position, size, seen_named = 0, len(children), False
    while position < size:
        first = children[position]
        if position + 1 < size and b.types[children[position + 1]] == _COLON:
            argument = _named_argument(b, first, children[position + 2])
            seen_named = True
            position += 4
        else:
            value = build_expression(b, first)
            argument = ast.Argument(span=b.tree_span(first), name=None, value=value)
            if seen_named:
                message = "a positional argument follows a named one"
                b.report("OSC109", value.span, message, "name it too, or put it first")
            position += 2
        arguments.append(argument)
    return tuple(arguments)


def _named_argument(b: Builder, name_tree: Tree, value_tree: Tree) -> ast.Argument:
    value = build_expression(b, value_tree)
    children = name_tree.children
    if len(children) == 1 and b.type_at(children[0]) == t.ID:
        name: ast.Name | None = b.name(children[0])
    else:
        name = None
        b.report("OSC100", b.tree_span(name_tree), "the name of an argument is a name", _NAMED)
    span = b.span(name_tree.start, b.last_token(value_tree))
    return ast.Argument(span=span, name=name, value=value)


def is_named(expression: ast.Expression, word: str) -> bool:
    """Whether an expression is the plain name `word`, not quoted and not qualified."""
    return (
        isinstance(expression, ast.NameExpression)
        and expression.name.text == word
        and expression.name.span.text == word
    )
