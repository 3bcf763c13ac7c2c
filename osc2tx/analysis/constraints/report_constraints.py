"""Reports on constraints: contradictions with both places, and numbers that fit no type."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from osc2tx.analysis.constraints.conjunctions import conjuncts, in_keeps_of_their_own
from osc2tx.analysis.constraints.constants import (
    ConstantEvaluator,
    ImpossibleConversionError,
    WithoutValueError,
)
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.domains import Interval
from osc2tx.analysis.constraints.forward import exact_result
from osc2tx.analysis.constraints.operation_list import Operation
from osc2tx.analysis.constraints.parameter_lookup import name_of
from osc2tx.analysis.constraints.propagation import (
    ConstraintAnalysis,
    TypeConstraints,
    analyse_globals,
)
from osc2tx.analysis.constraints.solver import values_on
from osc2tx.analysis.lints.usage import Usage
from osc2tx.diagnostics import DiagnosticSink, Label
from osc2tx.diagnostics.fixes import Remedy
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.types import INT, UINT, Type
from osc2tx.syntax import ast

LIMITS: Mapping[Type, tuple[int, int]] = {INT: (-(2**63), 2**63 - 1), UINT: (0, 2**64 - 1)}
KINDS = {"int": INT, "uint": UINT}
ARITHMETIC = frozenset({"+", "-", "*", "/", "%", "convert"})
EQUALITIES = (ast.BinaryOperator.EQUAL, ast.BinaryOperator.IN)
MOST_LABELS = 6


def report_constraints(
    model: SemanticModel,
    analysis: ConstraintAnalysis,
    usage: Usage,
    sink: DiagnosticSink,
) -> None:
    """Report errors of the constraints of all types and global parameters.

    Args:
        model: The checked program.
        analysis: Its constraints.
        usage: Where the program gives values, and divides them.
        sink: Receives the diagnostics.
    """
    misfits = _report_integers(model, usage.settings, sink)
    misfits |= _report_divisions(model, usage.divisions, sink)
    _report_without_value(model, usage, sink)
    reported: list[frozenset[ast.Node]] = []
    for found in [*analysis.types.values(), analyse_globals(model)]:
        for conflict in found.conflicts:
            nodes = frozenset(constraint.node for constraint in conflict)
            if nodes & misfits or any(earlier <= nodes for earlier in reported):
                continue  # reported before, for the type of a member
            reported.append(nodes)
            _report_conflict(found, conflict, sink)
        _report_arithmetic(found, misfits, sink)


def _report_conflict(
    found: TypeConstraints, conflict: tuple[Constraint, ...], sink: DiagnosticSink
) -> None:
    defaults = [c for c in conflict if c.is_default]
    arguments = [c for c in conflict if c.origin == "argument"]
    if len(conflict) == 1:
        _report_impossible(conflict[0], sink)
    elif arguments:
        _report_argument(conflict, arguments[-1], sink)
    elif defaults and len(defaults) < len(conflict):
        _report_default(conflict, defaults[-1], sink)
    else:
        last = conflict[-1]
        sink.report(
            "OSC420",
            last.span,
            f"this {_what(last)}{_about(conflict)} contradicts {_others(conflict, last)}",
            labels=_labels(conflict, last),
        )


def _report_impossible(constraint: Constraint, sink: DiagnosticSink) -> None:
    if constraint.subject is not None and constraint.origin != "keep":
        name = name_of(constraint.subject)
        message = f"`{name}` can never have this value"
    else:
        message = "this constraint can never hold"
    sink.report("OSC421", constraint.span, message)


def _report_argument(
    conflict: tuple[Constraint, ...], argument: Constraint, sink: DiagnosticSink
) -> None:
    name = name_of(argument.subject) if argument.subject is not None else "?"
    sink.report(
        "OSC423",
        argument.span,
        f"argument `{name}` contradicts {_others(conflict, argument)}",
        labels=_labels(conflict, argument),
    )


def _report_default(
    conflict: tuple[Constraint, ...], default: Constraint, sink: DiagnosticSink
) -> None:
    name = name_of(default.subject) if default.subject is not None else ""
    what = f"the default of `{name}`" if name else "this default"
    sink.report(
        "OSC422",
        default.span,
        f"{what} contradicts {_others(conflict, default)}",
        labels=_labels(conflict, default),
        notes=[
            "only a later `parameter == value` or `parameter in range`, with the parameter alone "
            "on the left, replaces a default"
        ],
        help=_replacing(conflict, default)
        or (f"drop the default: `remove_default({name})`" if name else None),
    )


def _replacing(conflict: tuple[Constraint, ...], default: Constraint) -> Remedy | None:
    """Return the remedy that lets a part of a conjunction replace the default."""
    for each in conflict:
        if each.is_default or not isinstance(each.node, ast.KeepConstraint):
            continue
        for part in conjuncts(each.node.expression):
            if not isinstance(part, ast.Binary) or part.operator not in EQUALITIES:
                continue
            if each.subject is None and each.place.locate(part.left) == default.subject:
                return in_keeps_of_their_own(each.node)
    return None


def _what(constraint: Constraint) -> str:
    return {"keep": "constraint"}.get(constraint.origin, constraint.origin)


def _others(conflict: tuple[Constraint, ...], primary: Constraint) -> str:
    others = [c for c in conflict if c is not primary]
    if len(others) > 1:
        return f"{len(others)} others together"
    match others[0]:
        case Constraint(origin="keep", is_default=True):
            return "a default constraint"
        case Constraint(origin="keep"):
            return "another constraint" if primary.origin == "keep" else "a constraint"
        case Constraint(origin=origin):
            return f"{'an' if origin == 'argument' else 'a'} {origin}"


def _about(conflict: tuple[Constraint, ...]) -> str:
    """Return the parameter that they are about, if there is just one."""
    if conflict[-1].origin == "element":
        return f" `{conflict[-1].span.text}`"
    shared = frozenset.intersection(*(c.operations.keys for c in conflict))
    names = sorted({name_of(key) for key in shared})
    return f" on `{names[0]}`" if len(names) == 1 else ""


def _labels(conflict: tuple[Constraint, ...], primary: Constraint) -> list[Label]:
    return [
        Label(c.span, f"{'default' if c.is_default else _what(c)}: {_constraint_text(c)}")
        for c in conflict
        if c is not primary
    ][:MOST_LABELS]


def _constraint_text(constraint: Constraint) -> str:
    text = " ".join(constraint.span.text.split())
    if constraint.origin == "element":
        return f"`{text}` is one of several alternatives"
    if constraint.origin == "keep" or constraint.subject is None:
        return f"`{text}`"
    word = "in" if constraint.is_range else "=="
    return f"`{name_of(constraint.subject)} {word} {text}`"


# --- numbers ---


def _report_integers(
    model: SemanticModel, settings: Iterable[ast.Node], sink: DiagnosticSink
) -> frozenset[ast.Node]:
    """Report integer literals that the type they are given to cannot hold."""
    found = set()
    for expression, type_, name in _typed_values(model, settings):
        value = _integer(expression)
        lower, upper = LIMITS[type_]
        if value is None or lower <= value <= upper or (type_ == UINT and value < 0):
            continue  # OSC317 is about negative numbers
        found.add(expression)
        sink.report(
            "OSC424",
            expression.span,
            f"{value} does not fit `{name}`",
            notes=[f"`{type_}` holds {lower} to {upper}"],
        )
    return frozenset(found)


def _report_divisions(
    model: SemanticModel, divisions: Iterable[ast.Binary], sink: DiagnosticSink
) -> frozenset[ast.Node]:
    """Report divisors that are a zero as written; computed ones are found with the constraints."""
    found = {node for node in divisions if _is_zero(model, node.right)}
    for node in divisions:
        if node in found:
            sink.report("OSC425", node.right.span, "this divisor is always zero")
    return frozenset(found)


def _report_without_value(model: SemanticModel, usage: Usage, sink: DiagnosticSink) -> None:
    """Report expressions that have no value for any parameters."""
    constants = ConstantEvaluator(model)
    reported = set()
    for expression in (*usage.demanded, *usage.casts):
        try:
            constants.value(expression)
        except WithoutValueError as error:
            is_certain = expression in usage.evaluated
            is_conversion = isinstance(error, ImpossibleConversionError)
            if error.node not in reported and (is_certain or is_conversion):
                reported.add(error.node)
                sink.report(error.code, error.node.span, error.message, help=error.help)


def _is_zero(model: SemanticModel, expression: ast.Expression) -> bool:
    match expression:
        case ast.Unary(operator=ast.UnaryOperator.NEGATE, operand=operand):
            return _is_zero(model, operand)
        case ast.IntegerLiteral(value=value) | ast.FloatLiteral(value=value):
            return value == 0
        case ast.PhysicalLiteral(value=value):
            unit = model.units.get(expression)
            return value == 0 and unit is not None and unit.offset == 0
        case _:
            return False


def _typed_values(
    model: SemanticModel, settings: Iterable[ast.Node]
) -> Iterator[tuple[ast.Expression, Type, str]]:
    """Yield the values of `int` and `uint` fields and parameters, with their types."""
    for node in settings:
        match node:
            case ast.ParameterDeclaration() | ast.VariableDeclaration():
                type_ = model.types.get(node.type)
                default = node.default
                if isinstance(default, ast.SampleExpression):
                    default = default.default
                if type_ is not None and type_ in LIMITS and default is not None:
                    yield default, type_, node.names[0].text
            case _:
                yield from _bound_values(model, node)


def _bound_values(
    model: SemanticModel, node: ast.Node
) -> Iterator[tuple[ast.Expression, Type, str]]:
    binding = model.bindings.get(node)
    for parameter, value in binding.arguments if binding is not None else ():
        if parameter.type in LIMITS:
            yield value, parameter.type, parameter.name


def _integer(expression: ast.Expression) -> int | None:
    match expression:
        case ast.IntegerLiteral(value=value):
            return value
        case ast.Unary(operator=ast.UnaryOperator.NEGATE, operand=ast.IntegerLiteral(value=value)):
            return -value
        case _:
            return None


def _report_arithmetic(
    found: TypeConstraints, misfits: frozenset[ast.Node], sink: DiagnosticSink
) -> None:
    """Report divisions by zero, and integers that are computed too large."""
    for constraint in found.in_force.constraints:
        if constraint.node in misfits or all(
            operation.name not in ARITHMETIC for operation in constraint.operations.items
        ):
            continue
        values = values_on(constraint.operations, found.domains)
        for operation in constraint.operations.items:
            operands = [values[o] for o in operation.operands]
            intervals = [o for o in operands if isinstance(o, Interval)]
            if operation.name not in ARITHMETIC or not isinstance(operation.node, ast.Node):
                continue
            if len(intervals) < len(operands) or not all(o.is_point for o in intervals[-1:]):
                continue
            if operation.name in ("/", "%"):
                node = operation.node
                if node not in misfits and isinstance(node, ast.Binary) and intervals[1].lower == 0:
                    span = node.right.span
                    sink.report("OSC425", span, "this divisor is always zero")
            elif operation.kind in KINDS and all(o.is_point for o in intervals):
                _check_overflow(operation, intervals, sink)


def _check_overflow(
    operation: Operation, operands: Sequence[Interval], sink: DiagnosticSink
) -> None:
    exact = exact_result(operation, operands)
    type_ = KINDS[operation.kind]
    lower, upper = LIMITS[type_]
    if not lower <= exact <= upper and operation.node is not None:
        sink.report(
            "OSC424",
            operation.node.span,
            f"{exact} does not fit `{type_}`",
            notes=[f"`{type_}` holds {lower} to {upper}"],
        )
