"""One constraint, and how it is written from a `keep`, a value or a condition."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from osc2tx.analysis.constraints.operation_list import (
    SIZE,
    Key,
    OperationList,
    OperationListBuilder,
)
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.tree_walk import children_of
from osc2tx.diagnostics import Span
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Op = ast.BinaryOperator


@dataclass(frozen=True, slots=True, eq=False)
class Constraint:
    """A constraint on one instance.

    Attributes:
        node: The `keep`, the default value or the argument.
        span: The text to show.
        origin: `"keep"`, `"default value"`, `"argument"`, or `"element"`: a list is long enough for
            an element that a constraint mentions.
        is_default: Whether a later one may replace it.
        subject: The parameter alone on its left side, if it is an equality or a range.
        value: The value of the subject, or its range or list.
        operations: The complete constraint.
        place: Scope of the names in `value`.
    """

    node: ast.Node
    span: Span
    origin: str
    is_default: bool
    subject: Key | None
    value: ast.Expression | None
    operations: OperationList
    place: Place

    @property
    def is_range(self) -> bool:
        """Whether the value is a set of values rather than the value itself."""
        return self.operations.root.name in ("in range", "in list") or self._is_in_a_list

    @property
    def _is_in_a_list(self) -> bool:
        """Whether it is `x in xs`; the contents of `xs` may be unknown."""
        node = self.node
        said = node.expression if isinstance(node, ast.KeepConstraint) else None
        return isinstance(said, ast.Binary) and said.operator is Op.IN


@dataclass(frozen=True, slots=True, eq=False)
class Removal:
    """`remove_default(parameter)`."""

    subject: Key


Entry: TypeAlias = Constraint | Removal


class ConstraintWriter:
    """Writes the constraints of a program one by one."""

    def __init__(self, model: SemanticModel) -> None:
        """Write for a checked program."""
        self._operations = OperationListBuilder(model)

    def setting(
        self, place: Place, key: Key, type_: types.Type, value: ast.Expression, origin: str
    ) -> Constraint:
        """Return `key == value`, or `key in value` for a range given to a number."""
        operations = OperationList()
        left = self._operations.append_variable(operations, key, type_, value)
        if isinstance(value, ast.RangeLiteral) and not isinstance(type_, types.RangeType):
            lower = self._operations.append(operations, value.lower, place.locate)
            upper = self._operations.append(operations, value.upper, place.locate)
            self._operations.append_comparison(operations, "in range", left, [lower, upper], value)
        else:
            right = self._operations.append_given(operations, type_, value, place.locate)
            self._operations.append_comparison(operations, "==", left, [right], value)
        return Constraint(
            node=value,
            span=value.span,
            origin=origin,
            is_default=origin == "default value",
            subject=key,
            value=value,
            operations=operations,
            place=place,
        )

    def rule(self, place: Place, rule: ast.KeepConstraint | ast.RemoveDefault) -> Iterator[Entry]:
        """Yield the constraints of a `keep` or `remove_default`."""
        if isinstance(rule, ast.RemoveDefault):
            removed = place.locate(rule.parameter)
            if removed is not None:
                yield Removal(removed)
            return
        expression = rule.expression
        subject, value = None, None
        if isinstance(expression, ast.Binary) and expression.operator in (Op.EQUAL, Op.IN):
            subject = place.locate(expression.left)
            value = expression.right if subject is not None else None
            handed_in = place.locate(expression.right)
            if expression.operator is Op.EQUAL and _is_actor_of_invocation(handed_in):
                subject, value = handed_in, expression.left  # the invocation takes it
        yield Constraint(
            node=rule,
            span=expression.span,
            origin="keep",
            is_default=rule.strength is ast.KeepStrength.DEFAULT,
            subject=subject,
            value=value,
            operations=self._operations.write(expression, place.locate),
            place=place,
        )
        yield from self._elements(place, rule)

    def _elements(self, place: Place, rule: ast.KeepConstraint) -> Iterator[Entry]:
        """Yield how long the lists are of which a constraint names elements (§7.3.5.2.1)."""
        for index in _certain_elements(rule.expression):
            list_ = place.locate(index.base)
            if list_ is None or not isinstance(index.index, ast.IntegerLiteral):
                continue
            operations = OperationList()
            size = self._operations.append_variable(operations, (*list_, SIZE), types.UINT, index)
            last = self._operations.append(operations, index.index, place.locate)
            self._operations.append_comparison(operations, ">", size, [last], index)
            yield Constraint(
                node=index,
                span=index.span,
                origin="element",
                is_default=rule.strength is ast.KeepStrength.DEFAULT,
                subject=None,
                value=None,
                operations=operations,
                place=place,
            )


def _is_actor_of_invocation(key: Key | None) -> bool:
    return (
        key is not None
        and isinstance(key[0], ast.Invocation)
        and isinstance(key[-1], sym.FieldSymbol)
        and isinstance(key[-1].type, types.ActorType)
    )


def _certain_elements(condition: ast.Expression) -> Iterator[ast.Index]:
    """Yield the elements of lists that a condition reads whenever it holds."""
    stack: list[tuple[ast.Node, bool]] = [(condition, True)]
    while stack:
        node, holds = stack.pop()
        match node:
            case ast.Binary(operator=Op.AND) if holds:
                stack += ((node.left, True), (node.right, True))
            case ast.Binary(operator=Op.AND | Op.OR | Op.IMPLIES):
                stack.append((node.left, False))
            case ast.Conditional():
                stack.append((node.condition, False))
            case ast.Call():
                continue  # of a list, it may be for each element
            case _:
                if isinstance(node, ast.Index):
                    yield node
                stack += ((child, False) for child in children_of(node))
