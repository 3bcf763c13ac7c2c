"""Lists of actors and structs that constraints describe element by element (§7.3.5.2.1).

`keep(l[k].x == 1m)` states that the list has an element `k`, `keep(l.size() == n)` states its size.
The elements are objects like any other; their names are their indices.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from osc2tx.semantics.bodies.constraints import paths_of
from osc2tx.semantics.model import Binding
from osc2tx.semantics.symbols import ActionSymbol, FieldSymbol, ScenarioSymbol, Symbol
from osc2tx.semantics.types import ActorType, ListType, StructType
from osc2tx.syntax import ast

MOST = 1000
"""Elements of such a list."""


def list_elements(
    symbols: tuple[Symbol, ...],
    references: Mapping[ast.Node, Symbol],
    bindings: Mapping[ast.Node, Binding],
) -> dict[FieldSymbol, tuple[FieldSymbol, ...]]:
    """Return the elements of the lists of scenarios that have no value as a whole."""
    given = {parameter for binding in bindings.values() for parameter, _ in binding.arguments}
    found: dict[FieldSymbol, tuple[FieldSymbol, ...]] = {}
    for owner in symbols:
        if not isinstance(owner, ScenarioSymbol | ActionSymbol):
            continue
        sizes: dict[FieldSymbol, int] = {}
        whole: set[Symbol] = set(given)
        for keep, it in _constraints(owner):
            _Reader(references, bindings, it, sizes, whole).read(keep.expression)
        for field, size in sizes.items():
            if field.owner is owner and field not in whole and 0 < size <= MOST:
                found[field] = tuple(_element(field, index) for index in range(size))
    return found


def _constraints(
    owner: ScenarioSymbol | ActionSymbol,
) -> Iterator[tuple[ast.KeepConstraint, FieldSymbol | None]]:
    """Yield the constraints of a behavior, with their meaning of `it`."""
    for statement in owner.statements:
        if isinstance(statement, ast.KeepConstraint):
            yield statement, None
        if isinstance(statement, ast.ParameterDeclaration) and statement.constraints:
            named = (member for name in statement.names for member in owner.named(name.text))
            for field in (m for m in named if isinstance(m, FieldSymbol) and m.node is statement):
                for rule in statement.constraints:
                    if isinstance(rule, ast.KeepConstraint):
                        yield rule, field


def _element(field: FieldSymbol, index: int) -> FieldSymbol:
    assert isinstance(field.type, ListType)
    return FieldSymbol(
        name=f"{field.name}.{index}",
        namespace=field.namespace,
        span=field.span,
        origin=field.origin,
        owner=field.owner,
        type=field.type.element,
    )


class _Reader:
    """Reads the statements of a constraint about lists.

    Args:
        references: The meanings of names.
        bindings: The meanings of calls.
        it: The meaning of `it`.
        sizes: The minimum sizes of lists; sizes are added.
        whole: Fields with a value as a whole; fields are added.
    """

    def __init__(
        self,
        references: Mapping[ast.Node, Symbol],
        bindings: Mapping[ast.Node, Binding],
        it: FieldSymbol | None,
        sizes: dict[FieldSymbol, int],
        whole: set[Symbol],
    ) -> None:
        self._references, self._bindings, self._it = references, bindings, it
        self._sizes, self._whole = sizes, whole

    def read(self, expression: ast.Expression) -> None:
        """Record the statements of an expression that is required to be true."""
        if isinstance(expression, ast.Binary) and expression.operator is ast.BinaryOperator.EQUAL:
            self._equality(expression.left, expression.right)
        for path in paths_of(expression):
            current = path
            while isinstance(current, ast.MemberAccess | ast.Index | ast.Cast):
                if isinstance(current, ast.Index) and isinstance(current.index, ast.IntegerLiteral):
                    self._has(current.base, current.index.value + 1)
                current = current.base

    def _equality(self, left: ast.Expression, right: ast.Expression) -> None:
        field, binding = self._list(left), self._bindings.get(left)
        if field is not None:
            self._whole.add(field)
        if binding is None or binding.receiver is None or binding.callee.name != "size":
            return
        if isinstance(right, ast.IntegerLiteral):
            self._has(binding.receiver, right.value)

    def _has(self, expression: ast.Expression, size: int) -> None:
        field = self._list(expression)
        if field is not None:
            self._sizes[field] = max(size, self._sizes.get(field, 0))

    def _list(self, expression: ast.Expression) -> FieldSymbol | None:
        """Return the list of objects without default that an expression names."""
        is_it = isinstance(expression, ast.ItExpression)
        symbol = self._it if is_it else self._references.get(expression)
        if isinstance(expression, ast.NameExpression | ast.ItExpression) and isinstance(
            symbol, FieldSymbol
        ):
            type_ = symbol.type.element if isinstance(symbol.type, ListType) else None
            if isinstance(type_, ActorType | StructType) and symbol.default is None:
                return symbol
        return None
