"""Linear equations between parameters: `a * 2 == 10`, `j + k == 10` with `j - k == 4`.

Propagation looks at one occurrence of a parameter at a time; Gaussian elimination sees all. A value
that an equation would only have because an integer wraps around is none that anybody asks for.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TypeAlias

from osc2tx.analysis.domains import Domain, Interval
from osc2tx.analysis.operation_list import Key, OperationList

MOST_EQUATIONS = 40

Form: TypeAlias = dict[Key | None, Fraction]
"""Factors of parameters; that of `None` is a plain number."""


def linear_solutions(
    expressions: Sequence[OperationList], active: Sequence[int], domains: Mapping[Key, Domain]
) -> Iterator[tuple[Key, Interval]]:
    """Yield the parameters that equations leave one value, with that value."""
    kinds: dict[Key, str] = {}
    rows: list[Form] = []
    for index in active:
        row = _equation(expressions[index], domains, kinds)
        if row is not None and any(key is not None for key in row):
            rows.append(row)
    if len(rows) > MOST_EQUATIONS:
        return
    for key, value in _solved(rows):
        number = _number(value, kinds[key])
        domain = domains[key]
        if number is not None and isinstance(domain, Interval) and domain.contains(number):
            yield key, Interval(number, number)


def _equation(
    operations: OperationList, domains: Mapping[Key, Domain], kinds: dict[Key, str]
) -> Form | None:
    """Return `left - right` of an equality; `None` if it is no linear one."""
    root = operations.root
    if root.name != "==":
        return None
    forms: list[Form | None] = []
    for operation in operations.items[:-1]:
        if operation.kind not in ("int", "uint", "float"):
            return None
        domain = operation.initial if operation.key is None else domains[operation.key]
        below = [forms[position] for position in operation.operands]
        if operation.key is not None and not _is_point(domain):
            kinds[operation.key] = operation.kind
            forms.append({operation.key: Fraction(1)})
        elif not operation.operands:
            forms.append(_constant(domain))
        else:
            forms.append(_combined(operation.name, operation.kind, below))
    left, right = (forms[position] for position in root.operands)
    return None if left is None or right is None else _sum(left, right, Fraction(-1))


def _is_point(domain: Domain) -> bool:
    return isinstance(domain, Interval) and domain.is_point


def _constant(domain: Domain) -> Form | None:
    is_finite = isinstance(domain, Interval) and math.isfinite(domain.lower)
    if not isinstance(domain, Interval) or not domain.is_point or not is_finite:
        return None
    return {None: Fraction(domain.lower)}


def _combined(name: str, kind: str, forms: Sequence[Form | None]) -> Form | None:
    known = [form for form in forms if form is not None]
    if len(known) != len(forms):
        return None
    match name, known:
        case "convert", [form]:
            return form
        case "-", [form]:
            return _scaled(form, Fraction(-1))
        case "+", [left, right]:
            return _sum(left, right, Fraction(1))
        case "-", [left, right]:
            return _sum(left, right, Fraction(-1))
        case "*", [left, right] if left.keys() <= {None}:
            return _scaled(right, left.get(None, Fraction(0)))
        case "*", [left, right] if right.keys() <= {None}:
            return _scaled(left, right.get(None, Fraction(0)))
        case "/", [left, right] if kind == "float" and right.keys() == {None} and right[None]:
            return _scaled(left, 1 / right[None])
        case _:
            return None


def _scaled(form: Form, factor: Fraction) -> Form:
    return {key: value * factor for key, value in form.items() if value * factor}


def _sum(left: Form, right: Form, factor: Fraction) -> Form:
    keys = dict.fromkeys((*left, *right))
    total = {key: left.get(key, Fraction(0)) + factor * right.get(key, Fraction(0)) for key in keys}
    return {key: value for key, value in total.items() if value}


def _solved(rows: list[Form]) -> Iterator[tuple[Key, Fraction]]:
    """Yield the parameters of rows that are left with one after elimination."""
    reduced: dict[Key, Form] = {}
    for row in rows:
        for pivot, other in reduced.items():
            row = _sum(row, other, -row.get(pivot, Fraction(0)))
        pivots = [key for key in row if key is not None]
        if not pivots:
            continue  # said already, or a contradiction, which others report
        own = _scaled(row, 1 / row[pivots[0]])
        for pivot, other in reduced.items():
            reduced[pivot] = _sum(other, own, -other.get(pivots[0], Fraction(0)))
        reduced[pivots[0]] = own
    for pivot, row in reduced.items():
        if all(key in (pivot, None) for key in row):
            yield pivot, -row.get(None, Fraction(0))


def _number(value: Fraction, kind: str) -> int | float | None:
    if kind == "float":
        return float(value)
    return int(value) if value.denominator == 1 else None
