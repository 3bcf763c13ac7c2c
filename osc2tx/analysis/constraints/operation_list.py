"""An expression as a flat list of operations, operands before their operations.

A list can be evaluated forward and backward by loops, however deep the expression nests.
Values that are unknown at compile time (variables of the world, methods, casts, objects) become
operations that can have any value of their type.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from osc2tx.analysis.constraints.constants import ConstantEvaluator, WithoutValueError
from osc2tx.analysis.constraints.domains import (
    ANY_BOOL,
    ANYTHING,
    Choice,
    Domain,
    Interval,
    Value,
    point,
)
from osc2tx.analysis.constraints.interval_arithmetic import WHOLE
from osc2tx.semantics import SemanticModel, to_si, types
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.builtins import builtin_field
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Op = ast.BinaryOperator
ARITHMETIC = (Op.ADD, Op.SUBTRACT, Op.MULTIPLY, Op.DIVIDE, Op.MODULO)
COMPARISONS = (Op.EQUAL, Op.NOT_EQUAL, Op.LESS, Op.LESS_EQUAL, Op.GREATER, Op.GREATER_EQUAL)
LOGIC = (Op.AND, Op.OR, Op.IMPLIES)

Part: TypeAlias = sym.Symbol | ast.Node
Key: TypeAlias = tuple[Part, ...]
"""A parameter: the fields that lead to it; an invocation's begin with the invocation."""

INTEGERS = ("int", "uint")
SIZE = builtin_field("size", types.UINT)
"""Key of the size of a list: the list, and then this."""

Locate: TypeAlias = Callable[[ast.Expression], Key | None]
"""Returns the parameter of a name or path; `None` if it is not a parameter."""


@dataclass(frozen=True, slots=True, eq=False)
class Operation:
    """One step.

    Attributes:
        name: `const`, `any`, `var`, `not`, `-`, `?`, `in list`, `in range`, `convert`, or the text
            of a binary operator.
        kind: `bool`, `int`, `uint`, `float` or `choice`.
        operands: Positions of earlier operations.
        initial: Its domain when nothing is known of the operands.
        key: The parameter of a `var`.
        node: Its position in the source.
    """

    name: str
    kind: str
    initial: Domain
    operands: tuple[int, ...] = ()
    key: Key | None = None
    node: ast.Node | None = None


class OperationList:
    """Operations; the last one is the whole expression."""

    def __init__(self) -> None:
        """Begin with none; all are added before the first question."""
        self.items: list[Operation] = []
        self.alone: Domain | None = None  # domain of its parameter under a plain one, once known
        # The answers; mypyc makes a plain property of a `cached_property`.
        self._keys: frozenset[Key] | None = None
        self._keys_in_order: tuple[Key, ...] | None = None
        self._is_plain: bool | None = None

    @property
    def keys(self) -> frozenset[Key]:
        """The parameters in it."""
        if self._keys is None:
            self._keys = frozenset(self.keys_in_order)
        return self._keys

    @property
    def keys_in_order(self) -> tuple[Key, ...]:
        """The parameters, in order of occurrence: the order of a set differs between runs."""
        if self._keys_in_order is None:
            keys = [o.key for o in self.items if o.key is not None]
            self._keys_in_order = tuple(dict.fromkeys(keys))
        return self._keys_in_order

    @property
    def is_plain(self) -> bool:
        """Whether it compares one parameter with constants: one visit narrows all it can."""
        if self._is_plain is None:
            *operands, _ = self.items
            variables = sum(o.key is not None for o in operands)
            self._is_plain = variables == 1 and all(
                o.key is not None or self._is_constant(o) for o in operands
            )
        return self._is_plain

    def _is_constant(self, operation: Operation) -> bool:
        converts = operation.name == "convert"
        of = self.items[operation.operands[0]] if converts else operation
        return of.name == "const"

    @property
    def root(self) -> Operation:
        """The whole expression."""
        return self.items[-1]

    def add(self, operation: Operation) -> int:
        """Append an operation; return its position."""
        self.items.append(operation)
        return len(self.items) - 1


def kind_of(type_: types.Type) -> str | None:
    """Return how values of a type are handled; `None` if not at all."""
    match type_:
        case types.PhysicalType():
            return "float"
        case types.PrimitiveType(name="string"):
            return "choice"
        case types.PrimitiveType(name=name):
            return name
        case types.EnumType():
            return "choice"
        case _:
            return None


def domain_of_type(type_: types.Type) -> Domain:
    """Return all values of a type."""
    if isinstance(type_, types.EnumType):
        numbers = {member.value for member in type_.symbol.members.values()}
        return Choice(frozenset(numbers)) if numbers else ANYTHING
    kind = kind_of(type_)
    return ANY_BOOL if kind == "bool" else WHOLE.get(kind or "", ANYTHING)


class OperationListBuilder:
    """Writes expressions as lists of operations."""

    def __init__(self, model: SemanticModel) -> None:
        """Take the types and references of the program."""
        self._model = model
        self._constants = ConstantEvaluator(model)

    def write(self, expression: ast.Expression, locate: Locate) -> OperationList:
        """Return an expression as a list of operations."""
        operations = OperationList()
        self.append(operations, expression, locate)
        return operations

    def append(self, operations: OperationList, expression: ast.Expression, locate: Locate) -> int:
        """Append an expression; return its position."""
        done: dict[ast.Expression, int] = {}
        stack: list[tuple[ast.Expression, bool]] = [(expression, False)]
        while stack:
            node, is_ready = stack.pop()
            children = self._children(node)
            if children and not is_ready:
                stack.append((node, True))
                stack += ((child, False) for child in reversed(children))
                continue
            done[node] = self._add(operations, node, [done[child] for child in children], locate)
        return done[expression]

    def append_given(
        self, operations: OperationList, type_: types.Type, value: ast.Expression, locate: Locate
    ) -> int:
        """Append the value given to a parameter: an integer becomes one of the parameter's type."""
        position = self.append(operations, value, locate)
        kind = kind_of(type_)
        if kind in INTEGERS and operations.items[position].kind in INTEGERS:
            return self._convert(operations, position, kind, value)
        return position

    def append_variable(
        self, operations: OperationList, key: Key, type_: types.Type, node: ast.Node
    ) -> int:
        """Append a parameter; return its position."""
        kind = kind_of(type_) or "choice"
        return operations.add(Operation("var", kind, domain_of_type(type_), key=key, node=node))

    def append_comparison(
        self, operations: OperationList, name: str, left: int, others: list[int], node: ast.Node
    ) -> int:
        """Append a comparison, with the conversion of its operands; return its position."""
        kinds = {operations.items[o].kind for o in (left, *others)}
        if len(kinds) > 1 and kinds <= {"int", "uint", "float"}:
            kind = "float" if "float" in kinds else "int"
            left = self._convert(operations, left, kind, node)
            others = [self._convert(operations, o, kind, node) for o in others]
        elif len(kinds) > 1:
            return operations.add(Operation("any", "bool", ANY_BOOL, node=node))
        return operations.add(Operation(name, "bool", ANY_BOOL, (left, *others), node=node))

    def _children(self, node: ast.Expression) -> tuple[ast.Expression, ...]:
        match node:
            case ast.Unary(
                operator=ast.UnaryOperator.NEGATE,
                operand=ast.IntegerLiteral() | ast.PhysicalLiteral(),
            ):
                return ()
            case ast.Unary():
                return (node.operand,)
            case ast.Binary(operator=Op.IN):
                return self._children_of_in(node)
            case ast.Binary():
                return (node.left, node.right)
            case ast.Conditional():
                return (node.condition, node.when_true, node.when_false)
            case _:
                return ()

    def _children_of_in(self, node: ast.Binary) -> tuple[ast.Expression, ...]:
        match node.right:
            case ast.RangeLiteral(lower=lower, upper=upper):
                return (node.left, lower, upper)
            case ast.ListLiteral(elements=elements):
                return (node.left, *elements)
            case _:
                return (node.left, node.right)

    def _add(
        self, operations: OperationList, node: ast.Expression, operands: list[int], locate: Locate
    ) -> int:
        match node:
            case ast.BoolLiteral() | ast.IntegerLiteral() | ast.FloatLiteral():
                return self._constant(operations, node, node.value)
            case ast.StringLiteral():
                return self._constant(operations, node, node.value)
            case ast.PhysicalLiteral():
                return self._physical(operations, node)
            case ast.Unary(
                operator=ast.UnaryOperator.NEGATE, operand=ast.IntegerLiteral(value=value)
            ):
                return operations.add(Operation("const", "int", point(-value), node=node))
            case ast.Unary(
                operator=ast.UnaryOperator.NEGATE, operand=ast.PhysicalLiteral() as literal
            ):
                return self._physical(operations, literal, -1)
            case ast.Unary(operator=ast.UnaryOperator.NOT):
                return operations.add(
                    Operation("not", "bool", ANY_BOOL, tuple(operands), node=node)
                )
            case ast.Unary():
                return self._negation(operations, node, operands[0])
            case ast.Binary() if operands:
                return self._binary(operations, node, operands)
            case ast.Conditional():
                return self._conditional(operations, node, operands)
            case ast.NameExpression() | ast.EnumLiteral() | ast.MemberAccess():
                return self._path(operations, node, locate)
            case ast.ItExpression():
                return self._variable(operations, node, locate)
            case ast.Index() if (key := locate(node)) is not None:
                return self.append_variable(operations, key, self._model.type_of(node), node)
            case ast.Call() if (key := self._size_of(node, locate)) is not None:
                return self.append_variable(operations, key, types.UINT, node)
            case _:
                return self._computed(operations, node)

    def _size_of(self, node: ast.Call, locate: Locate) -> Key | None:
        """Return the size of a list that is a parameter, if it is that."""
        binding = self._model.bindings.get(node)
        if binding is None or binding.receiver is None or binding.callee.name != SIZE.name:
            return None
        if not isinstance(self._model.type_of(binding.receiver), types.ListType):
            return None
        list_ = locate(binding.receiver)
        return None if list_ is None else (*list_, SIZE)

    def _computed(self, operations: OperationList, node: ast.Expression) -> int:
        """Append the result of a method, a conversion or a list: a constant, or anything."""
        try:
            value = self._constants.value(node)
        except WithoutValueError:
            value = None
        kind = kind_of(self._model.type_of(node))
        if value is None or isinstance(value, tuple) or kind is None:
            return self._any(operations, node)
        initial = point_of_choice(value) if kind == "choice" else point(value)
        return operations.add(Operation("const", kind, initial, node=node))

    def _constant(
        self, operations: OperationList, node: ast.Expression, value: bool | int | float | str
    ) -> int:
        if value != value:
            return self._any(operations, node)  # NaN equals nothing, yet it is no contradiction
        kind = kind_of(self._model.type_of(node)) or "choice"
        if isinstance(value, int) and not isinstance(value, bool) and kind == "float":
            value = float(value)
        return operations.add(Operation("const", kind, point(value), node=node))

    def _physical(self, operations: OperationList, node: ast.PhysicalLiteral, sign: int = 1) -> int:
        unit = self._model.units.get(node)
        if unit is None:
            return self._any(operations, node)
        value = to_si(sign * float(node.value), unit)
        return operations.add(Operation("const", "float", point(value), node=node))

    def _any(self, operations: OperationList, node: ast.Expression) -> int:
        type_ = self._model.type_of(node)
        kind = kind_of(type_) or "choice"
        return operations.add(Operation("any", kind, domain_of_type(type_), node=node))

    def _path(
        self,
        operations: OperationList,
        node: ast.NameExpression | ast.EnumLiteral | ast.MemberAccess,
        locate: Locate,
    ) -> int:
        symbol = self._model.symbol_of(node)
        if isinstance(symbol, sym.EnumMemberSymbol):
            return operations.add(Operation("const", "choice", point_of(symbol), node=node))
        return self._variable(operations, node, locate)

    def _variable(self, operations: OperationList, node: ast.Expression, locate: Locate) -> int:
        key = locate(node)
        if key is None:
            return self._any(operations, node)
        return self.append_variable(operations, key, self._model.type_of(node), node)

    def _negation(self, operations: OperationList, node: ast.Unary, operand: int) -> int:
        kind = kind_of(self._model.type_of(node)) or "choice"
        operand = self._convert(operations, operand, kind, node)
        return operations.add(
            Operation("-", kind, domain_of_type(self._model.type_of(node)), (operand,), node=node)
        )

    def _binary(self, operations: OperationList, node: ast.Binary, operands: list[int]) -> int:
        name = node.operator.value
        if node.operator in LOGIC:
            return operations.add(Operation(name, "bool", ANY_BOOL, tuple(operands), node=node))
        if node.operator is Op.IN:
            if not isinstance(node.right, ast.RangeLiteral | ast.ListLiteral):
                return self._any(operations, node)  # its contents are known in the run
            form = "in range" if isinstance(node.right, ast.RangeLiteral) else "in list"
            return self.append_comparison(operations, form, operands[0], operands[1:], node)
        if node.operator in COMPARISONS:
            return self.append_comparison(operations, name, operands[0], operands[1:], node)
        type_ = self._model.type_of(node)
        kind = kind_of(type_) or "choice"
        if kind == "choice" or any(
            operations.items[o].kind not in ("int", "uint", "float") for o in operands
        ):
            return self._any(operations, node)  # strings: not worth it
        converted = tuple(self._convert(operations, o, kind, node) for o in operands)
        return operations.add(Operation(name, kind, domain_of_type(type_), converted, node=node))

    def _convert(self, operations: OperationList, operand: int, kind: str, node: ast.Node) -> int:
        source = operations.items[operand]
        if source.kind == kind or kind == "choice":
            return operand
        if source.name == "const" and isinstance(source.initial, Interval) and kind != "float":
            return operations.add(Operation("const", kind, source.initial, node=source.node))
        return operations.add(Operation("convert", kind, WHOLE[kind], (operand,), node=node))

    def _conditional(
        self, operations: OperationList, node: ast.Conditional, operands: list[int]
    ) -> int:
        type_ = self._model.type_of(node)
        kind = kind_of(type_)
        condition, *branches = operands
        if kind in ("int", "uint", "float"):
            branches = [self._convert(operations, branch, kind, node) for branch in branches]
        if kind is None or any(operations.items[b].kind != kind for b in branches):
            return self._any(operations, node)
        initial = domain_of_type(type_)
        return operations.add(Operation("?", kind, initial, (condition, *branches), node=node))


def point_of(member: sym.EnumMemberSymbol) -> Choice:
    """Return the set of one enum member; members of equal value are one (§7.3.3)."""
    return point_of_choice(member.value)


def point_of_choice(value: Value) -> Choice:
    """Return the set of one string, or of one enum member, as its number."""
    return Choice(frozenset({value}))
