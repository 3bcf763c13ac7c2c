"""Operators, with dimensional analysis (language.md 4.2 and 7.2)."""

from __future__ import annotations

from osc2tx.diagnostics.fixes import write
from osc2tx.semantics.assignability import check_condition, check_fits
from osc2tx.semantics.conversions import are_related, common_type, dimension_of, is_numeric
from osc2tx.semantics.names.colloquial_names import QUOTIENTS
from osc2tx.semantics.names.member_lookup import lookup_value
from osc2tx.semantics.names.unknown_names import in_newest_version
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.types import (
    BOOL,
    ERROR,
    FLOAT,
    INT,
    STRING,
    UINT,
    Dimension,
    EnumType,
    ListType,
    PhysicalType,
    PrimitiveType,
    RangeType,
    Type,
)
from osc2tx.syntax import ast

Op = ast.BinaryOperator

LOGICAL = (Op.AND, Op.OR, Op.IMPLIES)
ORDERING = (Op.LESS, Op.LESS_EQUAL, Op.GREATER, Op.GREATER_EQUAL)
EQUALITY = (Op.EQUAL, Op.NOT_EQUAL)


def infer_unary(r: Resolution, node: ast.Unary, env: Environment) -> Type:
    """Type `not e` and `-e`."""
    if node.operator is ast.UnaryOperator.NOT:
        check_condition(r, node.operand, env)
        return BOOL
    type_ = r.type_of(node.operand, env)
    if type_ == ERROR:
        return ERROR
    if not is_numeric(type_):
        r.report("OSC304", node.operand.span, f"`{type_}` has no sign")
        return ERROR
    return INT if type_ == UINT else type_


def infer_binary(r: Resolution, node: ast.Binary, env: Environment) -> Type:
    """Type `left op right`."""
    if node.operator in LOGICAL:
        return _infer_logical(r, node, env)
    if node.operator is Op.IN:
        return _infer_in(r, node, env)
    left, right = _operand_types(r, node, env)
    if node.operator in EQUALITY:
        return _infer_equality(r, node, left, right)
    if node.operator in ORDERING:
        return _infer_ordering(r, node, left, right)
    return _infer_arithmetic(r, node, left, right)


def _infer_logical(r: Resolution, node: ast.Binary, env: Environment) -> Type:
    check_condition(r, node.left, env)
    check_condition(r, node.right, env)
    chained = isinstance(node.right, ast.Binary) and node.right.operator is Op.IMPLIES
    if node.operator is Op.IMPLIES and chained and not _is_in_brackets(node.right):
        r.report(
            "OSC414",
            node.span,
            "a chain of `=>` is read from the right; the standard does not define this",
            help=write(node.right.span, f"({node.right.span.text})", "add parentheses"),
        )
    return BOOL


def _is_in_brackets(expression: ast.Expression) -> bool:
    text, start = expression.span.source.text, expression.span.start
    return text[:start].rstrip().endswith("(") or text[start : start + 1] == "("


def _operand_types(r: Resolution, node: ast.Binary, env: Environment) -> tuple[Type, Type]:
    """Type both sides; a bare enum member takes its enum from the other side."""
    if _lacks_value(r, node.left, env) and not _lacks_value(r, node.right, env):
        right = r.type_of(node.right, env)
        return r.type_of(node.left, env, right), right
    left = r.type_of(node.left, env)
    if _divides_by_unit(r, node, env):
        return left, ERROR
    return left, r.type_of(node.right, env, left)


def _divides_by_unit(r: Resolution, node: ast.Binary, env: Environment) -> bool:
    """Report `72km/h`, where `h` is not defined; the standard has a unit for it (§7.3.4)."""
    number, below = node.left, node.right
    if node.operator is not Op.DIVIDE or not isinstance(number, ast.PhysicalLiteral):
        return False
    if not isinstance(below, ast.NameExpression) or not _lacks_value(r, below, env):
        return False
    unit = QUOTIENTS.get((number.unit.text, below.name.text))
    if unit is None:
        return False
    help_ = write(node.span, f"{number.span.text.removesuffix(number.unit.text)}{unit}")
    r.report("OSC201", below.span, f"`{below.name}` is not defined", help=help_)
    return True


def _lacks_value(r: Resolution, operand: ast.Expression, env: Environment) -> bool:
    """Whether an operand is a bare name that can only be an enum member."""
    if not isinstance(operand, ast.NameExpression):
        return False
    return lookup_value(r, operand.name, env, quiet=True) is None


def _infer_in(r: Resolution, node: ast.Binary, env: Environment) -> Type:
    left, right = _sides_of_in(r, node, env)
    if ERROR in (left, right):
        return BOOL
    match right:
        case RangeType():
            if isinstance(left, RangeType):
                r.needs_standard(node.left.span, "a range on the left of `in`")
            value = left.element if isinstance(left, RangeType) else left
            _check_comparable(r, node, value, right.element)
        case ListType():
            value = left.element if isinstance(left, ListType) else left
            if is_numeric(value) and is_numeric(right.element):
                _check_comparable(r, node, value, right.element)
            elif not are_related(value, right.element):
                r.report("OSC304", node.span, f"`{left}` cannot be in `{right}`")
        case _:
            r.report("OSC304", node.right.span, f"`in` takes a range or list, not `{right}`")
    return BOOL


def _sides_of_in(r: Resolution, node: ast.Binary, env: Environment) -> tuple[Type, Type]:
    """Type a value and its range or list; bare enum members take their enum from the other."""
    if _lacks_value(r, node.left, env):
        right = r.type_of(node.right, env)
        element = right.element if isinstance(right, ListType) else None
        return r.type_of(node.left, env, ERROR if right == ERROR else element), right
    left = r.type_of(node.left, env)
    expected = left if isinstance(left, ListType) else ListType(left)
    return left, r.type_of(node.right, env, ERROR if left == ERROR else expected)


def _infer_equality(r: Resolution, node: ast.Binary, left: Type, right: Type) -> Type:
    if ERROR in (left, right):
        return BOOL
    if is_numeric(left) and is_numeric(right):
        _check_comparable(r, node, left, right)
    elif not are_related(left, right):
        r.report(
            "OSC304",
            node.span,
            f"`{left}` and `{right}` cannot be compared",
            help=_member_meant(r, left, node.right) or _member_meant(r, right, node.left),
        )
    return BOOL


def _member_meant(r: Resolution, enum: Type, other: ast.Expression) -> str | None:
    """Return the help for a comparison of an enum with a name that is none of its members."""
    if not isinstance(enum, EnumType):
        return None
    if isinstance(other, ast.NameExpression):
        newer = in_newest_version(r, enum.symbol.name, other.name)
        if newer:
            return f"`{other.name}` is another declaration here; as a member {newer}"
    return f"`{enum}` has members such as `{next(iter(enum.symbol.members), '')}`"


def _infer_ordering(r: Resolution, node: ast.Binary, left: Type, right: Type) -> Type:
    if ERROR in (left, right):
        return BOOL
    for type_, operand in ((left, node.left), (right, node.right)):
        if not is_numeric(type_):
            r.report(
                "OSC304",
                operand.span,
                f"`{node.operator.value}` orders numbers, not `{type_}`",
                help=_number_in(operand, type_),
            )
            return BOOL
    _check_comparable(r, node, left, right)
    return BOOL


def _number_in(operand: ast.Expression, type_: Type) -> str | None:
    """Return the help for `it` where it is not a number: a member of it that is one."""
    if not isinstance(operand, ast.ItExpression):
        return None
    return f"`it` is all of `{type_}` here: name a member, `it.member`"


def _check_comparable(r: Resolution, node: ast.Binary, left: Type, right: Type) -> None:
    """Check that both sides of a comparison have one dimension."""
    if dimension_of(left) is not None and dimension_of(left) == dimension_of(right):
        return
    if not (is_numeric(left) and is_numeric(right)):
        r.report("OSC304", node.span, f"`{left}` and `{right}` cannot be compared")
    elif isinstance(left, PhysicalType) and isinstance(right, PrimitiveType):
        check_fits(r, node.right, right, left, "the other side")
    elif isinstance(right, PhysicalType) and isinstance(left, PrimitiveType):
        check_fits(r, node.left, left, right, "the other side")
    else:
        _report_dimensions(r, node, left, right)


def _report_dimensions(r: Resolution, node: ast.Binary, left: Type, right: Type) -> None:
    r.report(
        "OSC302",
        node.span,
        f"`{node.operator.value}` needs equal dimensions, not `{left}` and `{right}`",
        notes=[f"the dimensions are `{dimension_of(left)}` and `{dimension_of(right)}`"],
    )


def _infer_arithmetic(r: Resolution, node: ast.Binary, left: Type, right: Type) -> Type:
    if ERROR in (left, right):
        return ERROR
    if node.operator is Op.ADD and left == right == STRING:
        return STRING
    first, second = dimension_of(left), dimension_of(right)
    if first is None or second is None:
        culprit = (left, node.left) if first is None else (right, node.right)
        r.report(
            "OSC304",
            culprit[1].span,
            f"`{node.operator.value}` takes numbers, not `{culprit[0]}`",
            help=_enum_help(culprit[0]),
        )
        return ERROR
    if isinstance(left, PrimitiveType) and isinstance(right, PrimitiveType):
        return common_type(r.scope, (left, right)) or ERROR
    if node.operator is Op.MULTIPLY:
        return _physical(r, first * second)
    if node.operator is Op.DIVIDE:
        return _physical(r, first / second)
    if first == second:
        return left
    _check_comparable(r, node, left, right)
    relaxed = "OSC605" in r.relaxations.dialect.relaxed
    if relaxed and isinstance(left, PrimitiveType) != isinstance(right, PrimitiveType):
        return left if isinstance(left, PhysicalType) else right
    return ERROR


def _enum_help(type_: Type) -> str | None:
    return "convert it with `.as(int)`" if isinstance(type_, EnumType) else None


def _physical(r: Resolution, dimension: Dimension) -> Type:
    return FLOAT if dimension.is_dimensionless else r.scope.physical_type(dimension)


def infer_conditional(
    r: Resolution, node: ast.Conditional, env: Environment, expected: Type | None
) -> Type:
    """Type `condition ? a : b`."""
    check_condition(r, node.condition, env)
    first = r.type_of(node.when_true, env, expected)
    second = r.type_of(node.when_false, env, expected if expected is not None else first)
    common = common_type(r.scope, (first, second))
    if common is None:
        r.report("OSC314", node.span, f"the branches are `{first}` and `{second}`")
        return ERROR
    return common
