"""Expressions of the IR as Python expressions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import assert_never

from osc2tx import ir
from osc2tx.backends.py_trees.code import (
    Level,
    PyExpr,
    PyName,
    literal,
    name_expression,
    self_attribute,
)
from osc2tx.backends.py_trees.naming import NameTable, identifier

COMPARISONS = {"==": "==", "!=": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
ARITHMETIC = {"+": Level.SUM, "-": Level.SUM, "*": Level.TERM, "/": Level.TERM, "%": Level.TERM}
INVERSES = {"==": "!=", "!=": "=="}
LOGICAL = {"and": Level.AND, "or": Level.OR}


class ExpressionWriter:
    """Writes expressions and remembers which units and runtime names they need.

    Args:
        fields: Python names of the scenario's fields.
        use_unit: Told of each unit that is written; returns the name it goes by.
        use_name: Told of each name that must be imported from the runtime library.
        methods: The scenario's methods; their parameters must not hide what their bodies use.
    """

    def __init__(
        self,
        fields: NameTable,
        use_unit: Callable[[ir.Unit], PyName],
        use_name: Callable[[str], PyName],
        methods: tuple[ir.Method, ...] = (),
    ) -> None:
        """See the class."""
        parts = (part for method in methods for part in ir.walk(method.expression))
        units = (part.unit.name for part in parts if isinstance(part, ir.Quantity))
        self._hidden = {"self", "within", *map(identifier, units)}
        self._fields = fields
        self._use_unit = use_unit
        self._use_name = use_name

    def value(self, expression: ir.Expression) -> PyExpr:
        """Write an argument: late, as a lambda, if it depends on the state of the world."""
        written = self.write(expression)
        return self.late(written) if ir.is_live(expression) else written

    def field(self, name: str) -> PyExpr:
        """Write a field of the scenario."""
        return self_attribute(self._fields[name])

    def parameter(self, name: str) -> PyName:
        """Name a parameter of a method; one called `m` would hide the unit in `5 * m`."""
        wanted = identifier(name)
        return PyName(f"{wanted}_" if wanted in self._hidden else wanted)

    def late(self, expression: PyExpr) -> PyExpr:
        """Write `lambda: expression`."""
        return PyExpr(f"lambda: {expression.within(Level.CONDITIONAL)}", Level.LAMBDA)

    def write(self, expression: ir.Expression) -> PyExpr:
        """Write an expression."""
        match expression:
            case ir.Literal(value=value):
                return literal(value)
            case ir.Quantity():
                return self._quantity(expression)
            case ir.EnumValue(member=member):
                return literal(member)
            case ir.FieldRef(name=name):
                return self.field(name)
            case ir.ParameterRef(name=name):
                return name_expression(self.parameter(name))
            case ir.ScenarioSelf():
                return PyExpr("self", Level.ATOM)
            case ir.EventArgument(event=event, parameter=parameter):
                return PyExpr(f"{self.field(event)}[{literal(parameter)}]", Level.ATOM)
            case ir.Attribute(base=base, name=name):
                return PyExpr(f"{self._atom(base)}.{PyName(identifier(name))}", Level.ATOM)
            case ir.MethodCall():
                return self._method_call(expression)
            case ir.Unary():
                return self._unary(expression)
            case ir.Binary():
                return self._binary(expression)
            case ir.Conditional():
                return self._conditional(expression)
            case ir.ListValue(elements=elements):
                inner = ", ".join(self.write(e).within(Level.CONDITIONAL) for e in elements)
                return PyExpr(f"[{inner}]", Level.ATOM)
            case ir.RangeValue(lower=lower, upper=upper):
                bounds = f"{self.write(lower)}, {self.write(upper)}"
                return PyExpr(f"{self._use_name('within')}({bounds})", Level.ATOM)
            case _:
                assert_never(expression)

    def _atom(self, expression: ir.Expression) -> str:
        return self.write(expression).within(Level.ATOM)

    def _quantity(self, quantity: ir.Quantity) -> PyExpr:
        unit = self._use_unit(quantity.unit)
        number = literal(quantity.value)
        if quantity.unit.offset:
            return PyExpr(f"{unit}({number})", Level.ATOM)
        return PyExpr(f"{number.within(Level.TERM)} * {unit}", Level.TERM)

    def _method_call(self, call: ir.MethodCall) -> PyExpr:
        own = isinstance(call.base, ir.ScenarioSelf)
        arguments = ", ".join(self._argument(argument, own) for argument in call.arguments)
        method = self._fields[call.method] if own else PyName(identifier(call.method))
        return PyExpr(f"{self._atom(call.base)}.{method}({arguments})", Level.ATOM)

    def _argument(self, argument: ir.Argument, own: bool) -> str:
        value = self.write(argument.value).within(Level.CONDITIONAL)
        if argument.is_positional:
            return value
        name = argument.parameter
        return f"{self.parameter(name) if own else PyName(identifier(name))}={value}"

    def _unary(self, unary: ir.Unary) -> PyExpr:
        if unary.operator == "-" and isinstance(unary.operand, ir.Quantity):
            inner = unary.operand
            if not inner.unit.offset:  # `-1 * m` reads better than `-(1 * m)`
                return self._quantity(replace(inner, value=-inner.value))
        if unary.operator == "not" and isinstance(unary.operand, ir.Binary):
            inverse = INVERSES.get(unary.operand.operator)
            if inverse is not None:
                return self._binary(replace(unary.operand, operator=inverse))
        operand = self.write(unary.operand)
        if unary.operator == "not":
            return PyExpr(f"not {operand.within(Level.NOT)}", Level.NOT)
        return PyExpr(f"-{operand.within(Level.UNARY)}", Level.UNARY)

    def _binary(self, binary: ir.Binary) -> PyExpr:
        """Write a chain of operators; its left spine may be long, so it is walked in a loop."""
        spine = [binary]
        while isinstance(spine[-1].left, ir.Binary):
            spine.append(spine[-1].left)
        left = self.write(spine[-1].left)
        for node in reversed(spine):
            left = self._combine(node, left)
        return left

    def _combine(self, node: ir.Binary, left: PyExpr) -> PyExpr:
        operator = node.operator
        if operator == "in" and isinstance(node.right, ir.RangeValue):
            return self._in_range(left, node.right)
        right = self.write(node.right)
        if operator in COMPARISONS or operator == "in":
            # Python would read a chain `a < b < c` differently: both sides bind tighter.
            text = f"{left.within(Level.SUM)} {operator} {right.within(Level.SUM)}"
            return PyExpr(text, Level.COMPARISON)
        if operator in ARITHMETIC:
            level = ARITHMETIC[operator]
            spelled = "//" if _is_integer_division(node) else operator
            return PyExpr(f"{left.within(level)} {spelled} {right.within(level + 1)}", level)
        if operator in LOGICAL:
            level = LOGICAL[operator]
            return PyExpr(f"{left.within(level)} {operator} {right.within(level + 1)}", level)
        # a => b; a chain of them stays flat, for `or` is associative
        return PyExpr(f"not {left.within(Level.NOT)} or {right.within(Level.OR)}", Level.OR)

    def _in_range(self, left: PyExpr, bounds: ir.RangeValue) -> PyExpr:
        lower, upper = self.write(bounds.lower), self.write(bounds.upper)
        text = f"{lower.within(Level.SUM)} <= {left.within(Level.SUM)} <= {upper.within(Level.SUM)}"
        return PyExpr(text, Level.COMPARISON)

    def _conditional(self, node: ir.Conditional) -> PyExpr:
        condition = self.write(node.condition).within(Level.OR)
        when_true = self.write(node.when_true).within(Level.OR)
        when_false = self.write(node.when_false).within(Level.CONDITIONAL)
        return PyExpr(f"{when_true} if {condition} else {when_false}", Level.CONDITIONAL)


def _is_integer_division(node: ir.Binary) -> bool:
    return node.operator == "/" and node.type.kind is ir.Kind.INTEGER
