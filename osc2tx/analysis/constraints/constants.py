"""Values of expressions that are constant: literals, methods of constants, sizes of lists (§7.4).

Operands without effect on the result are not evaluated (§7.4.2.2), so recursive methods end.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from typing import ClassVar, TypeAlias

from osc2tx.analysis.constraints.domains import Interval, Value, close
from osc2tx.analysis.constraints.interval_arithmetic import fits
from osc2tx.semantics import SemanticModel, to_si, types
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.model import Binding
from osc2tx.semantics.scope import is_subtype
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Op = ast.BinaryOperator

Constant: TypeAlias = "Value | tuple[Constant, ...]"
"""A value in SI, the number of an enum member, or the elements of a list."""

Names: TypeAlias = Mapping[sym.Symbol, Constant]
"""Values of the parameters of a method."""

OPERATIONS: Mapping[str, Callable[..., Value]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": lambda a, b: a // b if isinstance(a, int) else a / b,
    "%": operator.mod,
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
EQUALITIES = ("==", "!=", "<=", ">=", "<", ">")

MOST_CALLS = 60  # one within the other
MOST_STEPS = 20_000  # of one expression


class WithoutValueError(Exception):
    """An expression that has no value is certainly evaluated.

    Attributes:
        code: Code of the diagnostic.
        node: The part without a value.
        message: The reason.
        help: The remedy.
    """

    code: ClassVar[str] = ""
    help: ClassVar[str | None] = None

    def __init__(self, node: ast.Expression, message: str) -> None:
        super().__init__(message)
        self.node = node
        self.message = message


class ImpossibleConversionError(WithoutValueError):
    """No value of the type equals the converted one (§7.4.2.6)."""

    code: ClassVar[str] = "OSC426"


class UndefinedMethodError(WithoutValueError):
    """A method without implementation is invoked (§7.3.7.1)."""

    code: ClassVar[str] = "OSC427"
    help: ClassVar[str | None] = (
        "override it, `is only expression …`, in a type that extends this one"
    )


@dataclass(slots=True, eq=False)
class ConstantEvaluator:
    """Evaluates expressions of a program that need nothing but themselves.

    Attributes:
        model: The checked program.
    """

    model: SemanticModel
    _steps: int = 0
    _calls: int = 0

    def value(self, expression: ast.Expression) -> Constant | None:
        """Return the value of an expression; `None` if it is no constant.

        Raises:
            WithoutValueError: If it, or a part that is evaluated for certain, has no value.
        """
        self._steps = self._calls = 0
        return self._value(expression, {})

    def _value(self, node: ast.Expression, names: Names) -> Constant | None:
        self._steps += 1
        if self._steps > MOST_STEPS:
            return None
        match node:
            case ast.BoolLiteral() | ast.IntegerLiteral() | ast.FloatLiteral():
                return node.value
            case ast.StringLiteral(value=text):
                return text
            case ast.PhysicalLiteral():
                unit = self.model.units.get(node)
                return None if unit is None else to_si(float(node.value), unit)
            case ast.NameExpression() | ast.EnumLiteral():
                return self._name(node, names)
            case ast.Unary():
                return self._unary(node, names)
            case ast.Binary():
                return self._binary(node, names)
            case ast.Conditional():
                return self._conditional(node, names)
            case ast.ListLiteral(elements=elements):
                return self._list(elements, names)
            case ast.Index(base=base, index=index):
                return self._element(base, index, names)
            case ast.Cast():
                return self._cast(node, names)
            case ast.Call():
                return self._call(node, names)
            case _:
                return None

    def _name(self, node: ast.NameExpression | ast.EnumLiteral, names: Names) -> Constant | None:
        symbol = self.model.symbol_of(node)
        if isinstance(symbol, sym.EnumMemberSymbol):
            return symbol.value
        return None if symbol is None else names.get(symbol)

    # --- operators ---

    def _unary(self, node: ast.Unary, names: Names) -> Constant | None:
        if isinstance(node.operand, ast.PhysicalLiteral) and (
            node.operator is ast.UnaryOperator.NEGATE
        ):
            unit = self.model.units.get(node.operand)  # -5celsius is below zero
            return None if unit is None else to_si(-float(node.operand.value), unit)
        operand = self._value(node.operand, names)
        if operand is None or isinstance(operand, tuple):
            return None
        if node.operator is ast.UnaryOperator.NOT:
            return not operand
        return self._computed("-", node, [operand])

    def _binary(self, node: ast.Binary, names: Names) -> Constant | None:
        left = self._value(node.left, names)
        decides = {Op.AND: False, Op.OR: True, Op.IMPLIES: False}.get(node.operator)
        if decides is not None:
            if left is decides:
                return node.operator is not Op.AND
            return None if left is None else self._value(node.right, names)
        if node.operator is Op.IN:
            return self._is_in(left, node.right, names)
        right = self._value(node.right, names)
        if left is None or right is None:
            return None
        if isinstance(left, tuple) or isinstance(right, tuple):
            if node.operator not in (Op.EQUAL, Op.NOT_EQUAL):
                return None
            return (left == right) is (node.operator is Op.EQUAL)
        return self._computed(node.operator.value, node, [left, right])

    def _is_in(self, left: Constant | None, right: ast.Expression, names: Names) -> bool | None:
        if isinstance(right, ast.RangeLiteral):
            bounds = [self._value(right.lower, names), self._value(right.upper, names)]
            numbers = [each for each in (left, *bounds) if isinstance(each, int | float)]
            if len(numbers) < 3:
                return None
            return min(numbers[1:]) <= numbers[0] <= max(numbers[1:])
        within = self._value(right, names)
        if left is None or not isinstance(within, tuple):
            return None
        return all(each in within for each in (left if isinstance(left, tuple) else (left,)))

    def _conditional(self, node: ast.Conditional, names: Names) -> Constant | None:
        match self._value(node.condition, names):
            case True:
                return self._value(node.when_true, names)
            case False:
                return self._value(node.when_false, names)
            case _:
                return None

    def _computed(self, name: str, node: ast.Expression, operands: Sequence[Value]) -> Value | None:
        type_ = self.model.type_of(node)
        numbers = [each for each in operands if not isinstance(each, bool | str)]
        if len(numbers) < len(operands):
            equal = operands[0] == operands[-1]
            return {"==": equal, "!=": not equal}.get(name)
        if _is_float(type_) or any(isinstance(each, float) for each in numbers):
            numbers = [float(each) for each in numbers]
            if name in EQUALITIES and numbers[0] != numbers[1] and close(numbers[0], numbers[1]):
                return None  # different by the rounding of units
        try:
            found = OPERATIONS[name](*numbers) if len(numbers) == 2 else -numbers[0]
        except ArithmeticError:
            return None  # has a diagnostic of its own
        if type_ in (types.INT, types.UINT) and not isinstance(found, bool | str):
            return found if fits(Interval(found, found), str(type_)) else None
        return found

    # --- lists ---

    def _list(
        self, elements: Sequence[ast.Expression], names: Names
    ) -> tuple[Constant, ...] | None:
        found: list[Constant] = []
        for element in elements:
            value = self._value(element, names)
            if value is None:
                return None
            found += value if isinstance(value, tuple) else (value,)
        return tuple(found)

    def _element(
        self, base: ast.Expression, index: ast.Expression, names: Names
    ) -> Constant | None:
        values, number = self._value(base, names), self._value(index, names)
        if not isinstance(values, tuple) or not isinstance(number, int):
            return None
        return values[number] if 0 <= number < len(values) else None

    # --- conversions ---

    def _cast(self, node: ast.Cast, names: Names) -> Constant | None:
        value = self._value(node.base, names)
        if value is None or isinstance(value, tuple):
            return None
        target = self.model.type_of(node)
        match target:
            case types.EnumType(symbol=enum):
                members = {member.value for member in enum.members.values()}
                if isinstance(value, int) and value not in members:
                    raise ImpossibleConversionError(
                        node, f"no member of `{enum.name}` has the value {value}"
                    )
                return value
            case types.INT | types.UINT if isinstance(value, float | int):
                if not math.isfinite(value) or (target == types.UINT and value <= -1):
                    raise ImpossibleConversionError(node, f"{value} is no `{target}`")
                return int(value)
            case types.FLOAT if not isinstance(value, str):
                return float(value)
            case _:
                return value if self.model.type_of(node.base) == target else None

    # --- methods ---

    def _call(self, node: ast.Call, names: Names) -> Constant | None:
        binding = self.model.bindings.get(node)
        if binding is None or not isinstance(binding.callee, sym.MethodSymbol):
            return None
        if binding.callee.origin == "builtin":
            return self._size(binding, names)
        method = binding.callee
        if method.origin != "user" or method.node is None or self._is_overridden(method):
            return None
        match method.node.body:
            case ast.UndefinedBody():
                raise UndefinedMethodError(node, f"method `{method.name}` is undefined")
            case ast.ExpressionBody(expression=body) if self._calls < MOST_CALLS:
                arguments = self._arguments(method, binding, names)
                self._calls += 1
                try:
                    return self._value(body, arguments)
                except UndefinedMethodError as error:
                    raise UndefinedMethodError(node, error.message) from error
                finally:
                    self._calls -= 1
            case _:
                return None

    def _arguments(self, method: sym.MethodSymbol, binding: Binding, names: Names) -> Names:
        given = {id(parameter): value for parameter, value in binding.arguments}
        found: dict[sym.Symbol, Constant] = {}
        for parameter in method.parameters:
            expression = given.get(id(parameter))
            value = (
                self._value(expression, names)
                if expression is not None
                else None if parameter.default is None else self._value(parameter.default, {})
            )
            if value is not None:
                found[parameter] = (
                    float(value) if isinstance(value, int) and _is_float(parameter.type) else value
                )
        return found

    def _size(self, binding: Binding, names: Names) -> int | None:
        if binding.receiver is None or binding.callee.name != "size":
            return None
        elements = self._value(binding.receiver, names)
        return len(elements) if isinstance(elements, tuple) else None

    def _is_overridden(self, method: sym.MethodSymbol) -> bool:
        owner = method.owner
        return isinstance(owner, sym.TypeSymbol) and any(
            other is not owner
            and isinstance(other, sym.TypeSymbol)
            and is_subtype(other, owner)
            and method.name in other.members
            for other in self.model.symbols
        )


def _is_float(type_: types.Type) -> bool:
    return type_ == types.FLOAT or isinstance(type_, types.PhysicalType)
