"""Python expressions mean what the expressions of the language mean."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx import ir
from osc2tx.backends.py_trees.code import PyName
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.naming import NameTable
from osc2tx.diagnostics import SourceFile, Span

SPAN = Span(SourceFile("case.osc", "x"), 0, 1)
INTEGER = ir.ValueType(ir.Kind.INTEGER, "int")
BOOL = ir.ValueType(ir.Kind.BOOL, "bool")


def writer() -> ExpressionWriter:
    names = NameTable()
    names.add("v", "v")
    return ExpressionWriter(names, lambda unit: PyName(unit.name), PyName)


def literal(value: int | bool) -> ir.Literal:
    return ir.Literal(span=SPAN, type=BOOL if isinstance(value, bool) else INTEGER, value=value)


def binary(operator: str, left: ir.Expression, right: ir.Expression) -> ir.Binary:
    type_ = INTEGER if operator in "+-*/%" else BOOL
    return ir.Binary(span=SPAN, type=type_, operator=operator, left=left, right=right)


def evaluate(expression: ir.Expression) -> object:
    """Evaluate the IR directly: the independent reference for the written Python."""
    match expression:
        case ir.Literal(value=value):
            return value
        case ir.Unary(operator=operator, operand=operand):
            inner = evaluate(operand)
            return not inner if operator == "not" else -inner  # type: ignore[operator]
        case ir.Conditional(condition=c, when_true=t, when_false=f):
            return evaluate(t) if evaluate(c) else evaluate(f)
        case ir.Binary(operator=operator, left=left, right=right):
            a, b = evaluate(left), evaluate(right)
            table = {
                "+": lambda: a + b,  # type: ignore[operator]
                "-": lambda: a - b,  # type: ignore[operator]
                "*": lambda: a * b,  # type: ignore[operator]
                "and": lambda: a and b,
                "or": lambda: a or b,
                "=>": lambda: (not a) or b,
                "<": lambda: a < b,  # type: ignore[operator]
                ">=": lambda: a >= b,  # type: ignore[operator]
                "==": lambda: a == b,
                "!=": lambda: a != b,
            }
            return table[operator]()
    raise AssertionError(expression)


numbers = st.recursive(
    st.integers(0, 9).map(literal),
    lambda inner: st.one_of(
        st.builds(binary, st.sampled_from("+-*"), inner, inner),
        st.builds(lambda e: ir.Unary(span=SPAN, type=INTEGER, operator="-", operand=e), inner),
    ),
    max_leaves=12,
)
truths = st.recursive(
    st.builds(binary, st.sampled_from(["<", ">=", "=="]), numbers, numbers)
    | st.booleans().map(literal),
    lambda inner: st.one_of(
        st.builds(binary, st.sampled_from(["and", "or", "=>", "==", "!="]), inner, inner),
        st.builds(lambda e: ir.Unary(span=SPAN, type=BOOL, operator="not", operand=e), inner),
        st.builds(
            lambda c, t, f: ir.Conditional(
                span=SPAN, type=BOOL, condition=c, when_true=t, when_false=f
            ),
            inner,
            inner,
            inner,
        ),
    ),
    max_leaves=8,
)


@given(truths | numbers)
def test_written_python_gives_the_same_value(expression: ir.Expression) -> None:
    assert eval(writer().write(expression).text) == evaluate(expression)


@given(truths)
def test_a_late_value_is_a_lambda_of_the_same_value(expression: ir.Expression) -> None:
    text = writer().late(writer().write(expression)).text
    assert eval(text)() == evaluate(expression)


def test_a_long_chain_does_not_recurse() -> None:
    chain: ir.Expression = literal(1)
    for _ in range(5000):
        chain = binary("+", chain, literal(1))
    assert writer().write(chain).text.count("+") == 5000


def test_a_quantity_keeps_its_authored_form() -> None:
    kph = ir.Unit("kph", 1 / 3.6, 0.0, True)
    speed = ir.ValueType(ir.Kind.QUANTITY, "speed")
    quantity = ir.Quantity(span=SPAN, type=speed, value=35, unit=kph)
    assert writer().write(quantity).text == "35 * kph"
    field = ir.FieldRef(span=SPAN, type=speed, name="v")
    product = ir.Binary(span=SPAN, type=speed, operator="*", left=field, right=quantity)
    assert writer().write(product).text == "self.v * (35 * kph)"
    celsius = ir.Unit("celsius", 1.0, 273.15, True)
    warm = ir.Quantity(span=SPAN, type=speed, value=20, unit=celsius)
    assert writer().write(warm).text == "celsius(20)"


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_special_floats(value: float) -> None:
    float_type = ir.ValueType(ir.Kind.FLOAT, "float")
    written = eval(writer().write(ir.Literal(span=SPAN, type=float_type, value=value)).text)
    assert written == value or (math.isnan(written) and math.isnan(value))


def test_a_range_test_reads_its_value_once() -> None:
    bounds = ir.RangeValue(span=SPAN, type=INTEGER, lower=literal(1), upper=literal(3))
    inside = binary("in", ir.FieldRef(span=SPAN, type=INTEGER, name="v"), bounds)
    assert writer().write(inside).text == "1 <= self.v <= 3"


@pytest.mark.parametrize(
    ("operator", "expected"),
    [
        (ir.ListOperator.MAP, [False, True]),
        (ir.ListOperator.HAS, True),
        (ir.ListOperator.COUNT, 1),
    ],
)
def test_a_filter_below_another_operator_needs_no_list(
    operator: ir.ListOperator, expected: object
) -> None:
    numbers = ir.ValueType(ir.Kind.LIST, "list of int", INTEGER)
    it = ir.Element(span=SPAN, type=INTEGER, depth=0)
    listed = ir.ListValue(span=SPAN, type=numbers, elements=tuple(map(literal, (5, 3, 1))))
    small = ir.ListOperation(
        span=SPAN,
        type=numbers,
        base=listed,
        operator=ir.ListOperator.FILTER,
        argument=binary("<", it, literal(5)),
        depth=0,
    )
    outer = ir.ListOperation(
        span=SPAN,
        type=INTEGER,
        base=small,
        operator=operator,
        argument=binary("<", it, literal(3)),
        depth=0,
    )
    text = writer().write(outer).text
    assert eval(text) == expected
    assert text.count(" for ") == 1


def test_truth_values_are_not_compared_with_true_and_false() -> None:
    flag = ir.FieldRef(span=SPAN, type=BOOL, name="v")
    less = binary("<", literal(1), literal(2))
    written = {
        (operator, value, side): writer().write(binary(operator, *sides)).text
        for operator in ("==", "!=")
        for value in (True, False)
        for side, sides in enumerate([(flag, literal(value)), (literal(value), flag)])
    }
    assert written == {
        (operator, value, side): "self.v" if (operator == "==") is value else "not self.v"
        for operator, value, side in written
    }
    assert writer().write(binary("==", less, literal(False))).text == "not 1 < 2"
