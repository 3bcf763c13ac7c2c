"""Assignability of values: defaults, arguments, conditions (§7.4.2.6)."""

from __future__ import annotations

from collections.abc import Callable

from osc2tx.diagnostics.fixes import Help, write
from osc2tx.semantics.builtins import TIME
from osc2tx.semantics.conversions import NUMBERS, converts, dimension_of
from osc2tx.semantics.names.scenario_runner import reads_as_quantity
from osc2tx.semantics.names.unfit_types import described, hidden_type
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.types import (
    BOOL,
    EVENT,
    UINT,
    Dimension,
    EnumType,
    ErrorType,
    ListType,
    PhysicalType,
    RangeType,
    Type,
)
from osc2tx.syntax import ast

Advise = Callable[[Type], Help]


def check_value(
    r: Resolution,
    expression: ast.Expression,
    target: Type,
    env: Environment,
    what: str,
    *,
    allow_range: bool = False,
    advise: Advise | None = None,
) -> Type:
    """Type an expression, and report it if it does not fit the target type.

    Args:
        r: The state of the pass.
        expression: The value.
        target: The required type.
        env: Its environment.
        what: The use of the value, for the beginning of a message.
        allow_range: Whether it may be a range of the target type.
        advise: Returns the help for a value of a type that does not fit.
    """
    source = r.type_of(expression, env, target)
    if reads_as_quantity(r, expression, target, env):
        r.types[expression] = source = target
    check_fits(r, expression, source, target, what, allow_range=allow_range, advise=advise)
    return source


def check_condition(r: Resolution, expression: ast.Expression, env: Environment) -> None:
    """Type an expression that must be boolean."""
    check_value(r, expression, BOOL, env, "a condition")


def check_duration(r: Resolution, expression: ast.Expression, env: Environment) -> None:
    """Type an expression that must be a time, or a range of times."""
    check_value(r, expression, TIME, env, "a duration", allow_range=True)


def check_fits(
    r: Resolution,
    expression: ast.Expression,
    source: Type,
    target: Type,
    what: str,
    *,
    allow_range: bool = False,
    advise: Advise | None = None,
) -> None:
    """Report an expression whose type does not fit the target type; see `check_value`."""
    if isinstance(source, ErrorType) or isinstance(target, ErrorType):
        return
    if allow_range and isinstance(source, RangeType) and not isinstance(target, RangeType):
        source = source.element
        if isinstance(expression, ast.RangeLiteral):
            check_fits(r, expression.lower, r.types[expression.lower], target, what)
            check_fits(r, expression.upper, r.types[expression.upper], target, what)
            return
    if converts(source, target):
        _check_sign(r, expression, target, what)
        return
    wanted = _dimension_inside(target)
    given = _dimension_inside(source)
    composed = isinstance(source, ListType | RangeType)
    if wanted is None or given is None or composed or wanted == given:
        r.report(
            "OSC301",
            expression.span,
            f"{_named(what, target)} must be `{target}`, not {described(source)}",
            help=(advise and advise(source))
            or hidden_type(r, source)
            or _mismatch_help(expression, source, target),
        )
    elif source in NUMBERS:
        _report_missing_unit(r, expression, target, what)
    else:
        _report_dimension(r, expression, source, target, what, advise and advise(source))


def _mismatch_help(expression: ast.Expression, source: Type, target: Type) -> Help:
    if isinstance(source, RangeType):
        return f"constrain it in its `with:` block: `keep(it in {expression.span.text})`"
    if isinstance(expression, ast.StringLiteral):
        return _unquoted(expression, target)
    if source == EVENT and target == BOOL:
        event = f"@{expression.span.text}"
        return write(expression.span, event, f"to react to an event write `{event}`")
    if isinstance(expression, ast.PhysicalLiteral) and source == TIME and target == BOOL:
        wait = f"elapsed({expression.span.text})"
        return write(expression.span, wait, f"to let time pass write `{wait}`")
    return None


def _unquoted(expression: ast.StringLiteral, target: Type) -> Help:
    """Return the help that a member of an enum, or a quantity, is written without quotes."""
    text = expression.value
    is_member = isinstance(target, EnumType) and text in target.symbol.members
    is_quantity = isinstance(target, PhysicalType) and text[:1].isdigit() and len(text) < 30
    is_truth = target == BOOL and text in ("true", "false")
    if not (is_member or is_quantity or is_truth):
        return None
    return write(expression.span, text, f"write it without quotes: `{text}`")


def _dimension_inside(type_: Type) -> Dimension | None:
    return dimension_of(type_.element if isinstance(type_, RangeType) else type_)


def _report_missing_unit(
    r: Resolution, expression: ast.Expression, target: Type, what: str
) -> None:
    physical = target.element if isinstance(target, RangeType) else target
    si = dimension_of(physical)
    if r.relaxes(
        "OSC605", expression.span, f"a number without unit for `{target}` is taken in SI (`{si}`)"
    ):
        return
    unit = example_unit(r, physical)
    with_unit = write(expression.span, f"{expression.span.text}{unit}", is_safe=False)
    r.report(
        "OSC303",
        expression.span,
        f"{_named(what, target)} must be `{target}`; a plain number has no unit",
        help=with_unit if unit and _is_literal(expression) else None,
    )


def _is_literal(expression: ast.Expression) -> bool:
    operand = expression.operand if isinstance(expression, ast.Unary) else expression
    return isinstance(operand, ast.IntegerLiteral | ast.FloatLiteral)


def example_unit(r: Resolution, type_: Type) -> str | None:
    """Return the shortest unit of a physical type that is its SI unit."""
    dimension = dimension_of(type_)
    names = [
        unit.name
        for unit in r.scope.all_units()
        if unit.factor == 1.0 and unit.offset == 0.0 and dimension_of(unit.type) == dimension
    ]
    return min(names, key=len, default=None)


def _report_dimension(
    r: Resolution, expression: ast.Expression, source: Type, target: Type, what: str, help: Help
) -> None:
    product = isinstance(expression, ast.Binary) and expression.operator in (
        ast.BinaryOperator.MULTIPLY,
        ast.BinaryOperator.DIVIDE,
    )
    si = _dimension_inside(target)
    if product and r.relaxes(
        "OSC604",
        expression.span,
        f"a product of dimension `{_dimension_inside(source)}` is taken as a number "
        f"in SI for `{target}` (`{si}`)",
    ):
        return
    notes = [f"`{target}` has dimension `{si}`"] if isinstance(target, PhysicalType) else []
    r.report(
        "OSC302",
        expression.span,
        f"{_named(what, target)} must be `{target}`, not `{source}`",
        notes=[*notes, f"the value has dimension `{_dimension_inside(source)}`"],
        help=help,
    )


def _check_sign(r: Resolution, expression: ast.Expression, target: Type, what: str) -> None:
    if isinstance(target, ListType) and isinstance(expression, ast.ListLiteral):
        for element in expression.elements:
            _check_sign(r, element, target.element, f"an element of {what}")
        return
    if not isinstance(expression, ast.Unary) or target != UINT:
        return
    match expression:
        case ast.Unary(
            operator=ast.UnaryOperator.NEGATE, operand=ast.IntegerLiteral(value=value)
        ) if value:
            r.report("OSC317", expression.span, f"{what} is unsigned and cannot be {-value}")
        case _:
            return


def _named(what: str, target: Type) -> str:
    """Return the subject of a message; a name that is also a type is marked as a name."""
    return f"the value of {what}" if what == f"`{target}`" else what
