"""Values and domains as text, in the units in which they were written."""

from __future__ import annotations

import math

from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.domains import Choice, Domain, Interval, Number
from osc2tx.analysis.constraints.operation_list import OperationListBuilder
from osc2tx.analysis.constraints.propagation import ParameterDomain
from osc2tx.analysis.constraints.solver import values_on
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

MOST_CHOICES = 6


def format_range(model: SemanticModel, parameter: ParameterDomain) -> str:
    """Return the domain of a bounded parameter, as `in [80kph..95kph]` or `in {12m, 40m}`."""
    unit = unit_of(model, parameter.constraints)
    listed = _listed(model, parameter, unit)
    if listed:
        return f"in {_format_values(listed)}"
    return f"in {format_domain(parameter.domain, parameter.type, unit)}"


def _listed(
    model: SemanticModel, parameter: ParameterDomain, unit: sym.UnitSymbol | None
) -> list[str]:
    """Return the numbers of the list that a parameter is in; none if it is in no list of numbers.

    The domain of such a parameter is the interval around them; numbers outside of it are left out.
    """
    domain = parameter.domain
    if not isinstance(parameter.range, ast.ListLiteral) or not isinstance(domain, Interval):
        return []
    place = parameter.constraints[-1].place
    found: list[str] = []
    for element in parameter.range.elements:
        operations = OperationListBuilder(model).write(element, place.locate)
        value = values_on(operations, {})[-1]
        if not isinstance(value, Interval) or not value.is_point:
            return []
        if domain.contains(value.lower):
            fits = unit is not None and unit.type == parameter.type
            found.append(format_number(value.lower, unit if fits else None))
    return list(dict.fromkeys(found))


def format_free(model: SemanticModel, parameter: ParameterDomain) -> str:
    """Return a parameter without value or range, with its bound on one side."""
    domain = parameter.domain
    if isinstance(domain, Interval) and isinstance(parameter.type, types.PhysicalType):
        unit = unit_of(model, parameter.constraints)
        if domain.upper < math.inf:
            sign = "<" if domain.upper_open else "<="
            return f"{parameter.name} {sign} {format_number(domain.upper, unit)}"
        if domain.lower > -math.inf:
            sign = ">" if domain.lower_open else ">="
            return f"{parameter.name} {sign} {format_number(domain.lower, unit)}"
    return parameter.name


def format_value(model: SemanticModel, parameter: ParameterDomain) -> str:
    """Return the value of a fixed parameter: `high`, `60kph`, `true`; a string without quotes."""
    value = parameter.value
    if isinstance(value, sym.EnumMemberSymbol):
        return value.name
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value if isinstance(value, str) else str(value).lower()
    unit = unit_of(model, parameter.constraints)
    fits = unit is not None and unit.type == parameter.type
    return format_number(value, unit if fits else None)


def unit_of(model: SemanticModel, constraints: tuple[Constraint, ...]) -> sym.UnitSymbol | None:
    """Return the unit that the last of some constraints uses."""
    for constraint in reversed(constraints):
        for node in nodes_below(constraint.node):
            if isinstance(node, ast.PhysicalLiteral) and node in model.units:
                return model.units[node]
    return None


def format_domain(domain: Domain, type_: types.Type, unit: sym.UnitSymbol | None) -> str:
    """Return a domain as text."""
    if isinstance(domain, Interval):
        fits = unit is not None and unit.type == type_
        lower, upper = (
            format_number(bound, unit if fits else None) for bound in (domain.lower, domain.upper)
        )
        return f"[{lower}..{upper}]"
    return _format_choice(domain, type_)


def _format_choice(domain: Choice, type_: types.Type) -> str:
    if isinstance(type_, types.EnumType):
        texts = [m.name for m in type_.symbol.members.values() if m.value in domain.values]
    else:
        texts = [_literal(value) for value in sorted(domain.values, key=str)]
    return _format_values(texts)


def _format_values(texts: list[str]) -> str:
    """Return a set of values as text."""
    shown = ", ".join(texts[:MOST_CHOICES]) + (", ..." if len(texts) > MOST_CHOICES else "")
    return f"{{{shown}}}"


def _literal(value: object) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value).lower()


def format_number(number: Number, unit: sym.UnitSymbol | None) -> str:
    """Return a number in SI in the unit that it was written in."""
    if unit is None:
        return f"{number:.10g}" if isinstance(number, float) else str(number)
    return f"{(number - unit.offset) / unit.factor:.10g}{unit.name}"
