"""Expressions: operator precedence over the flat lists of the grammar (§7.4)."""

from __future__ import annotations

from typing import NamedTuple

from osc2tx.diagnostics import Span
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax.ast_builder.base import BuilderBase, Tree
from osc2tx.syntax.literals import (
    MAX_NEGATED,
    MAX_UINT,
    integer_value,
    is_integer,
    split_name,
    split_physical,
    string_value,
)
from osc2tx.syntax.tokens import EOF

MAX_PREFIXES = 200

_LEVELS = ("=>", "or", "and", "not", "== != < <= > >= in", "+ -", "* / %")
_PRECEDENCE: dict[int, int] = {}
_OPERATORS: dict[int, ast.BinaryOperator] = {}
for _level, _group in enumerate(_LEVELS):
    for _word in _group.split():
        _kind = t.KEYWORDS.get(_word) or t.PUNCTUATION[_word]
        _PRECEDENCE[_kind] = _level
        if _word != "not":
            _OPERATORS[_kind] = ast.BinaryOperator(_word)

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


class ExpressionBuilder(BuilderBase):
    """Builds expressions; chains of any length in loops, nesting by recursion."""

    def _expression(self, tree: Tree) -> ast.Expression:
        children = tree.children
        if len(children) == 1:
            return self._operand(children[0])
        if len(children) > 4 and self._types_of(children[-4]) == _QUESTION:
            condition = self._chain(children[:-4])
            when_true = self._expression(children[-3])
            when_false = self._expression(children[-1])
            return ast.Conditional(
                span=self._tree_span(tree),
                condition=condition,
                when_true=when_true,
                when_false=when_false,
            )
        return self._chain(children)

    def _types_of(self, child: object) -> int:
        """Type of a child that is a token; of a context, nothing that a token has."""
        return self._types[child] if isinstance(child, int) else EOF

    def _chain(self, children: list[Tree]) -> ast.Expression:
        """Resolve the precedence of a flat row of operators and operands."""
        operands: list[_Operand] = []
        pending: list[_Pending] = []
        position, size = 0, len(children)
        while position < size:
            position = self._prefixes(children, position, pending)
            child = children[position]
            node = self._operand(child)
            start = self._starts[child if isinstance(child, int) else child.start]
            position += 1
            while position < size and self._types[children[position]] not in _OPERATORS:
                node, position = self._postfix(node, start, children, position)
            last = children[position - 1]
            end = self._ends[last if isinstance(last, int) else last.stop]
            operands.append(_Operand(node, start, end))
            if position == size:
                break
            kind = self._types[children[position]]
            level = _PRECEDENCE[kind]
            self._reduce(operands, pending, level + 1 if kind == _IMPLIES else level)
            pending.append(_Pending(level, _OPERATORS[kind], None, 0))
            position += 1
        self._reduce(operands, pending, 0)
        return operands[0].node

    def _prefixes(self, children: list[Tree], position: int, pending: list[_Pending]) -> int:
        first = position
        while (kind := self._types_of(children[position])) in (_NOT, _MINUS, _PLUS):
            start = self._starts[children[position]]
            if kind == _PLUS:
                self._check_plus(children, position)
            elif kind == _NOT:
                if pending and pending[-1].level > _NOT_LEVEL:
                    message = "`not` binds weaker than the operator before it"
                    span = self._span(children[position], children[position])
                    self._report("OSC100", span, message, "put `(not …)` in parentheses")
                pending.append(_Pending(_NOT_LEVEL, None, ast.UnaryOperator.NOT, start))
            else:
                pending.append(_Pending(_NEGATE_LEVEL, None, ast.UnaryOperator.NEGATE, start))
            position += 1
        if position - first > MAX_PREFIXES:
            message = f"more than {MAX_PREFIXES} prefix operators in a row"
            self._report("OSC105", self._span(children[first], children[position - 1]), message)
            kept = len(pending) - (position - first) + MAX_PREFIXES
            del pending[max(kept, 0) :]
        return position

    def _check_plus(self, children: list[Tree], position: int) -> None:
        """`+` is a sign of floats only (§7.2.1.5.2)."""
        after = children[position + 1]
        kind = self._types[after] if isinstance(after, int) else None
        text = self._text(after) if isinstance(after, int) else ""
        span = self._span(children[position], children[position])
        if kind not in _NUMBERS and text not in ("inf", "nan"):
            self._report("OSC100", span, "a sign `+` stands before a number only")
        elif kind == t.INTEGER or (kind == t.PHYSICAL and is_integer(split_physical(text)[0])):
            message = "a sign `+` stands before numbers with a point or an exponent only"
            self._report("OSC100", span, message, f"write `{text}`")

    def _reduce(self, operands: list[_Operand], pending: list[_Pending], level: int) -> None:
        """Apply the waiting operators that bind at least as strongly as `level`."""
        while pending and pending[-1].level >= level:
            operator = pending.pop()
            right = operands.pop()
            if operator.binary is not None:
                left = operands.pop()
                start = left.start
                node: ast.Expression = ast.Binary(
                    span=Span(self._source, start, right.end),
                    operator=operator.binary,
                    left=left.node,
                    right=right.node,
                )
            else:
                assert operator.unary is not None
                self._check_negated(operator, right.node)
                start = operator.start
                span = Span(self._source, start, right.end)
                node = ast.Unary(span=span, operator=operator.unary, operand=right.node)
            operands.append(_Operand(node, start, right.end))

    def _check_negated(self, operator: _Pending, operand: ast.Expression) -> None:
        is_negated = operator.unary is ast.UnaryOperator.NEGATE
        if is_negated and isinstance(operand, ast.IntegerLiteral) and operand.value > MAX_NEGATED:
            span = Span(self._source, operator.start, operand.span.end)
            self._report("OSC107", span, "the number does not fit a signed integer of 64 bits")

    # --- Operands -------------------------------------------------------------------------------

    def _operand(self, child: Tree) -> ast.Expression:
        if not isinstance(child, int):
            return self._group(child)
        kind = self._types[child]
        span = Span(self._source, self._starts[child], self._ends[child])
        text = self._code[span.start : span.end]
        if kind == t.ID:
            return self._word(child, text, span)
        if kind == t.STRING:
            return ast.StringLiteral(span=span, value=string_value(text))
        if kind == t.INTEGER:
            return ast.IntegerLiteral(span=span, value=self._integer(text, span))
        if kind == t.FLOAT:
            return ast.FloatLiteral(span=span, value=self._float(text, span))
        return self._physical(text, span)

    def _word(self, token: int, text: str, span: Span) -> ast.Expression:
        if text == "it":
            return ast.ItExpression(span=span)
        if text in ("true", "false"):
            return ast.BoolLiteral(span=span, value=text == "true")
        if text in ("inf", "nan"):
            return ast.FloatLiteral(span=span, value=float(text))
        return ast.NameExpression(span=span, name=self._name(token))

    def _integer(self, text: str, span: Span) -> int:
        value = integer_value(text)
        if value is None or value > MAX_UINT:
            self._report("OSC107", span, "the number does not fit an integer of 64 bits")
            return MAX_UINT
        return value

    def _float(self, text: str, span: Span) -> float:
        value = float(text)
        if value == float("inf"):
            message = "the number is too large for a float of 64 bits"
            self._report("OSC107", span, message, "write `inf` for an infinite value")
        return value

    def _physical(self, text: str, span: Span) -> ast.Expression:
        number, unit = split_physical(text)
        value = self._integer(number, span) if is_integer(number) else self._float(number, span)
        namespace, name = split_name(unit)
        unit_span = Span(self._source, span.start + len(number), span.end)
        unit_name = ast.Name(span=unit_span, text=name, namespace=namespace)
        return ast.PhysicalLiteral(span=span, value=value, unit=unit_name)

    def _group(self, tree: Tree) -> ast.Expression:
        """`( e )`, `[ a, b ]` or `[ a .. b ]`."""
        children = tree.children
        if self._types[children[0]] == _LPAREN:
            return self._expression(children[1])
        span = self._tree_span(tree)
        if len(children) > 3 and self._types[children[2]] == _DOTS:
            lower, upper = self._expression(children[1]), self._expression(children[3])
            return ast.RangeLiteral(span=span, lower=lower, upper=upper)
        elements = tuple(self._expression(child) for child in children[1:-1:2])
        if len(children) == 2:
            self._report("OSC100", span, "a list needs at least one element")
            elements = ()
        return ast.ListLiteral(span=span, elements=elements)

    # --- Postfix forms --------------------------------------------------------------------------

    def _postfix(
        self, base: ast.Expression, start: int, children: list[Tree], position: int
    ) -> tuple[ast.Expression, int]:
        """Apply one postfix form; return the result and the position behind it."""
        kind = self._types[children[position]]
        if kind == _DOT:
            word = children[position + 1]
            if self._types[word] == t.ID:
                name = self._name(word)
                span = Span(self._source, start, name.span.end)
                return ast.MemberAccess(span=span, base=base, name=name), position + 2
            type_ = self._type_name(children[position + 3])
            node = ast.Cast if self._types[word] == _AS else ast.TypeTest
            span = Span(self._source, start, self._ends[children[position + 4]])
            return node(span=span, base=base, type=type_), position + 5
        if kind == _BANG:
            return self._enum_literal(base, children[position + 1]), position + 2
        if kind == _LBRACKET:
            index = self._expression(children[position + 1])
            span = Span(self._source, start, self._ends[children[position + 2]])
            return ast.Index(span=span, base=base, index=index), position + 3
        has_arguments = not isinstance(children[position + 1], int)
        arguments = self._arguments(children[position + 1]) if has_arguments else ()
        end = position + (2 if has_arguments else 1)
        span = Span(self._source, start, self._ends[children[end]])
        return self._call(span, base, arguments), end + 1

    def _enum_literal(self, base: ast.Expression, member: int) -> ast.Expression:
        name = self._name(member)
        span = base.span.to(name.span)
        if isinstance(base, ast.NameExpression):
            return ast.EnumLiteral(span=span, enum=base.name, member=name)
        self._report("OSC100", base.span, "the name of an enumeration stands before `!`")
        return base

    def _call(
        self, span: Span, callee: ast.Expression, arguments: tuple[ast.Argument, ...]
    ) -> ast.Expression:
        if is_named(callee, "range") and len(arguments) == 2:
            lower, upper = arguments
            if lower.name is None and upper.name is None:
                return ast.RangeLiteral(span=span, lower=lower.value, upper=upper.value)
        return ast.Call(span=span, callee=callee, arguments=arguments)

    def _arguments(self, tree: Tree) -> tuple[ast.Argument, ...]:
        """Positional arguments first, then named ones."""
        children = tree.children
        arguments: list[ast.Argument] = []
        position, size, seen_named = 0, len(children), False
        while position < size:
            first = children[position]
            if position + 1 < size and self._types[children[position + 1]] == _COLON:
                argument = self._named_argument(first, children[position + 2])
                seen_named = True
                position += 4
            else:
                value = self._expression(first)
                argument = ast.Argument(span=self._tree_span(first), name=None, value=value)
                if seen_named:
                    message = "a positional argument follows a named one"
                    self._report("OSC109", value.span, message, "name it too, or put it first")
                position += 2
            arguments.append(argument)
        return tuple(arguments)

    def _named_argument(self, name_tree: Tree, value_tree: Tree) -> ast.Argument:
        value = self._expression(value_tree)
        children = name_tree.children
        if len(children) == 1 and self._types_of(children[0]) == t.ID:
            name: ast.Name | None = self._name(children[0])
        else:
            name = None
            self._report("OSC100", self._tree_span(name_tree), "the name of an argument is a name")
        span = self._span(name_tree.start, self._last(value_tree))
        return ast.Argument(span=span, name=name, value=value)


def is_named(expression: ast.Expression, word: str) -> bool:
    """Whether an expression is the plain name `word`, not quoted and not qualified."""
    return (
        isinstance(expression, ast.NameExpression)
        and expression.name.text == word
        and expression.name.span.text == word
    )
