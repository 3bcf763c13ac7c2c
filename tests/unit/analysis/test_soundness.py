"""Propagation never excludes a solution that brute force finds."""

import itertools
import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx.analysis.constraints.domains import Choice, Domain, close
from osc2tx.analysis.constraints.propagation import analyse_constraints
from tests.unit.semantics.support import build_text

Assignment = Mapping[str, float | int | bool]
GRID: dict[str, tuple[str, list[float]]] = {
    "i": ("int", [-3, -1, 0, 1, 2, 5]),
    "j": ("int", [-2, 0, 1, 4]),
    "u": ("uint", [0, 1, 3, 2**64 - 1]),
    "x": ("float", [-math.inf, -2.0, -0.0, 0.1, 0.5, 1.0, 3.0, math.nan]),
    "y": ("float", [-1.5, 0.0, 0.2, 2.0, math.inf]),
    "b": ("bool", [False, True]),
}


class Undefined(Exception):
    """A result that the standard leaves open in a way that no value stands for."""


@dataclass(frozen=True)
class Term:
    """An expression as text, its type, and its value for an assignment."""

    text: str
    type: str
    value: Callable[[Assignment], float]


def wrap(value: float, type_: str) -> float:
    """Return a result as its type keeps it."""
    if type_ == "float":
        return float(value)
    bits = int(value) % 2**64
    return bits - 2**64 if type_ == "int" and bits >= 2**63 else bits


def divide(a: float, b: float) -> float:
    if isinstance(a, int) and isinstance(b, int):
        if b == 0:
            raise Undefined
        return a // b
    if b == 0:
        zero_or_nan = a == 0 or math.isnan(a)
        return math.nan if zero_or_nan else math.copysign(math.inf, a) * math.copysign(1, b)
    return a / b


def remainder(a: float, b: float) -> float:
    if isinstance(a, int) and isinstance(b, int):
        if b == 0:
            raise Undefined
        return a % b
    return math.nan if b == 0 or math.isinf(a) else math.fmod(a, b)


ARITHMETIC: dict[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": divide,
    "%": remainder,
}
COMPARISONS: dict[str, Callable[[float, float], bool]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
LOGIC: dict[str, Callable[[bool, bool], bool]] = {
    "and": lambda a, b: a and b,
    "or": lambda a, b: a or b,
    "=>": lambda a, b: not a or b,
}


def common(a: Term, b: Term) -> str:
    types = {a.type, b.type}
    return "float" if "float" in types else "int" if "int" in types else "uint"


def converted(term: Term, type_: str, values: Assignment) -> float:
    return wrap(term.value(values), type_)


def arithmetic(name: str, a: Term, b: Term) -> Term:
    type_ = common(a, b)
    function = ARITHMETIC[name]

    def value(values: Assignment) -> float:
        return wrap_float(function(converted(a, type_, values), converted(b, type_, values)), type_)

    return Term(f"({a.text} {name} {b.text})", type_, value)


def wrap_float(value: float, type_: str) -> float:
    return value if type_ == "float" else wrap(value, type_)


def comparison(name: str, a: Term, b: Term) -> Term:
    type_, function = common(a, b), COMPARISONS[name]
    return Term(
        f"({a.text} {name} {b.text})",
        "bool",
        lambda values: function(converted(a, type_, values), converted(b, type_, values)),
    )


def within(a: Term, low: Term, high: Term) -> Term:
    type_ = common(Term("", common(a, low), a.value), high)

    def value(values: Assignment) -> bool:
        number, first, last = (converted(t, type_, values) for t in (a, low, high))
        return first <= number <= last or last <= number <= first

    return Term(f"({a.text} in [{low.text}..{high.text}])", "bool", value)


def one_of(a: Term, b: Term, c: Term) -> Term:
    element = common(b, c)  # of all elements (§7.4.2.7)
    first, second = (
        comparison("==", a, Term("", element, lambda values, t=t: converted(t, element, values)))
        for t in (b, c)
    )
    return Term(
        f"({a.text} in [{b.text}, {c.text}])",
        "bool",
        lambda values: first.value(values) or second.value(values),
    )


def logic(name: str, a: Term, b: Term) -> Term:
    function = LOGIC[name]
    return Term(
        f"({a.text} {name} {b.text})",
        "bool",
        lambda values: function(bool(a.value(values)), bool(b.value(values))),
    )


def choice(condition: Term, a: Term, b: Term) -> Term:
    type_ = common(a, b)
    return Term(
        f"({condition.text} ? {a.text} : {b.text})",
        type_,
        lambda values: converted(a if condition.value(values) else b, type_, values),
    )


def parameter(name: str) -> Term:
    return Term(name, GRID[name][0], lambda values: values[name])


def number(value: float) -> Term:
    is_negative = isinstance(value, int) and value < 0
    type_ = "float" if isinstance(value, float) else "int" if is_negative else "uint"
    return Term(f"({value})" if value < 0 else str(value), type_, lambda values: value)


LEAVES = st.sampled_from([parameter(name) for name in "ijuxy"]) | st.sampled_from(
    [number(v) for v in (0, 1, 2, 5, -1, 0.5, 0.1, 2.0, 0.3)]
)
NUMBERS = st.recursive(
    LEAVES,
    lambda inner: st.builds(arithmetic, st.sampled_from(sorted(ARITHMETIC)), inner, inner),
    max_leaves=4,
)
ATOMS = (
    st.builds(comparison, st.sampled_from(sorted(COMPARISONS)), NUMBERS, NUMBERS)
    | st.builds(within, LEAVES, NUMBERS, NUMBERS)
    | st.builds(one_of, LEAVES, LEAVES, LEAVES)
    | st.just(parameter("b"))
)
CONDITIONS = st.recursive(
    ATOMS,
    lambda inner: (
        st.builds(logic, st.sampled_from(sorted(LOGIC)), inner, inner)
        | st.builds(
            lambda a: Term(f"(not {a.text})", "bool", lambda v: not a.value(v)),
            inner,
        )
        | st.builds(lambda c, a, b: comparison("<=", choice(c, a, b), a), inner, LEAVES, LEAVES)
    ),
    max_leaves=4,
)


def holds(condition: Term, values: Assignment) -> bool:
    try:
        return bool(condition.value(values))
    except Undefined:
        return False


def is_left(value: float, domain: Domain) -> bool:
    if isinstance(domain, Choice):
        return (value in domain.values) != domain.excluded
    return domain.contains(value) or close(value, domain.lower) or close(value, domain.upper)


@pytest.mark.slow
@settings(max_examples=25)
@given(st.lists(CONDITIONS, min_size=1, max_size=4))
def test_no_solution_is_excluded(conditions: list[Term]) -> None:
    lines = ["struct s:", *(f"    {name}: {type_}" for name, (type_, _) in GRID.items())]
    lines += [f"    keep({condition.text})" for condition in conditions]
    model, sink = build_text("\n".join(lines) + "\n")
    assert not sink.has_errors, sink.sorted()
    (found,) = analyse_constraints(model).types.values()
    solutions = [
        values
        for combination in itertools.product(*(grid for _, grid in GRID.values()))
        if all(
            holds(condition, values := dict(zip(GRID, combination, strict=True)))
            for condition in conditions
        )
    ]
    if solutions:
        assert not found.conflicts, ("solved by", solutions[0])
    for key, domain in found.domains.items():
        name = key[0].name  # type: ignore[union-attr]
        for values in solutions:
            assert is_left(values[name], domain), (name, values, domain)
