"""Open parameters: declarations of the document, and a document with the values they may have.

A range stays a parameter where the document says the same for every value in it. That is tested,
not assumed: the document is evaluated for values of the range and compared with what is written
down for the scenario with just these values. A parameter that fails keeps its nominal value, and
the report says so.

Values are listed deterministically, at equal steps with both ends: runs can be repeated, the
ends are what one tests, and not every tool carries out stochastic distributions.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from math import floor, isclose
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.names import Names
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.symbols import Symbol
from osc2tx.backends.xosc.tree import Element, element
from osc2tx.backends.xosc.values import Values
from osc2tx.light_dataclass import dataclass
from osc2tx.options import XmlVersion

MOST_COMBINATIONS = 100
"""Rows of a table of values for parameters that depend on each other."""

STEPS = 4
"""Steps from end to end of a range."""

INSIDE = 0.3137
"""A place in a range where nothing special is to be expected."""

Point: TypeAlias = Mapping[str, float]
Write: TypeAlias = Callable[[Mapping[str, float]], Element | None]
"""Writes the scenario down with values of its open parameters; `None` if that cannot be."""


@dataclass(frozen=True, slots=True, eq=False)
class OpenParameter:
    """A numeric parameter that may have several values.

    Attributes:
        declaration: The parameter.
        name: Its name in the document.
        low: The least value.
        high: The greatest one.
        choices: All values, if they are a set; else empty.
        nominal: The value that the declaration has.
    """

    declaration: ir.Parameter
    name: str
    low: float
    high: float
    choices: tuple[float, ...]
    nominal: float

    @property
    def is_integer(self) -> bool:
        """Whether it has no fractions."""
        return self.declaration.type.kind is ir.Kind.INTEGER

    def probes(self) -> tuple[float, ...]:
        """Values at which the document is tested."""
        return self.choices or (self.low, self.low + INSIDE * (self.high - self.low), self.high)

    def steps(self, count: int = STEPS) -> tuple[float, ...]:
        """Values at equal distances."""
        if self.choices:
            return self.choices
        step = (self.high - self.low) / count
        return (*(self.low + index * step for index in range(count)), self.high)

    def symbol(self, version: XmlVersion) -> Symbol:
        """Return the number that stands for it."""
        return Symbol(self.nominal, f"${self.name}", has_expressions=version >= "1.1")

    def told(self) -> str:
        """Return its values for people."""
        if self.choices:
            return f"[{', '.join(f'{choice:g}' for choice in self.choices)}]"
        return f"[{self.low:g}..{self.high:g}]"


def open_parameters(scenario: ir.Scenario, names: Names) -> tuple[OpenParameter, ...]:
    """Return the numeric parameters that a scenario leaves open, in source order.

    Those whose range depends on another open one are not among them, and keep their nominal value.
    """
    values = Values(scenario)
    found = []
    for declaration in scenario.declarations:
        if isinstance(declaration, ir.Parameter) and declaration.value is None:
            parameter = _open(declaration, values, names)
            if parameter is not None:
                found.append(parameter)
    return _within_constraints(scenario, found)


def _open(declaration: ir.Parameter, values: Values, names: Names) -> OpenParameter | None:
    match declaration.domain:
        case ir.RangeValue(lower=lower, upper=upper) if not _refers(lower) and not _refers(upper):
            low, high = values.number(lower), values.number(upper)
            if declaration.type.kind is ir.Kind.INTEGER or low == high:
                return None
            middle = 0.5 * (low + high)
            return OpenParameter(declaration, names.new(declaration.name), low, high, (), middle)
        case ir.Choices(elements=elements) if not any(map(_refers, elements)):
            numbers = [values.of(each) for each in elements]
            if any(isinstance(n, bool) or not isinstance(n, (int, float)) for n in numbers):
                return None
            choices = tuple(float(n) for n in numbers if isinstance(n, (int, float)))
            name = names.new(declaration.name)
            return OpenParameter(declaration, name, min(choices), max(choices), choices, choices[0])
    return None


def _refers(expression: ir.Expression) -> bool:
    return any(isinstance(part, ir.FieldRef) for part in ir.walk(expression))


def _within_constraints(
    scenario: ir.Scenario, found: Sequence[OpenParameter]
) -> tuple[OpenParameter, ...]:
    """Choose nominal values that agree with each other."""
    if not scenario.constraints or is_allowed(scenario, nominal_values(found)):
        return tuple(found)
    rows = allowed_rows(scenario, found)
    if not rows:
        return tuple(found)
    row = rows[len(rows) // 2]
    return tuple(
        OpenParameter(p.declaration, p.name, p.low, p.high, p.choices, row[p.declaration.name])
        for p in found
    )


def nominal_values(parameters: Sequence[OpenParameter]) -> dict[str, float]:
    """Return the nominal values by name in the scenario."""
    return {p.declaration.name: p.nominal for p in parameters}


def is_allowed(scenario: ir.Scenario, point: Point) -> bool:
    """Whether values agree with the constraints between them."""
    values = Values(scenario, point)
    try:
        return all(bool(values.of(each.expression)) for each in scenario.constraints)
    except Inexpressible:  # it is about something else, which is only known during the run
        return True


def allowed_rows(scenario: ir.Scenario, parameters: Sequence[OpenParameter]) -> list[Point]:
    """Return combinations of values that agree with the constraints."""
    count = STEPS
    while count > 1 and (count + 1) ** len(parameters) > MOST_COMBINATIONS:
        count -= 1
    names = [p.declaration.name for p in parameters]
    grids = [p.steps(count) for p in parameters]
    rows = (dict(zip(names, row, strict=True)) for row in product(*grids))
    return [row for row in rows if is_allowed(scenario, row)]


# --- is the document right for all values? ---


def unfaithful(
    document: Element, parameters: Sequence[OpenParameter], scenario: ir.Scenario, write: Write
) -> tuple[OpenParameter, ...]:
    """Return the parameters for whose other values the document says something else.

    If each of them alone is right and all together are not, they all are returned.
    """
    nominal = nominal_values(parameters)

    def holds(point: Point) -> bool:
        if not is_allowed(scenario, point):
            return True
        expected = write(point)
        shown = {p.name: point[p.declaration.name] for p in parameters}
        if expected is None:
            return False
        return all(
            _same(part, other, shown)
            for part, other in zip(_story(document), _story(expected), strict=True)
        )

    wrong = tuple(
        p
        for p in parameters
        if not all(holds({**nominal, p.declaration.name: value}) for value in p.probes())
    )
    if wrong or len(parameters) < 2:
        return wrong
    ends = [{p.declaration.name: p.probes()[index] for p in parameters} for index in (0, 1, -1)]
    return () if all(map(holds, ends)) else tuple(parameters)


def _story(document: Element) -> list[Element]:
    """Return the parts that say what happens."""
    return [part for part in document.children if part.name in ("Entities", "Storyboard")]


def _same(a: Element, b: Element, shown: Point) -> bool:
    """Whether two elements say the same once parameters have their values."""
    if a.name != b.name or len(a.children) != len(b.children):
        return False
    left, right = dict(a.attributes), dict(b.attributes)
    if left.keys() != right.keys():
        return False
    if not all(_same_text(left[key], right[key], shown) for key in left):
        return False
    return all(_same(x, y, shown) for x, y in zip(a.children, b.children, strict=True))


def _same_text(a: str, b: str, shown: Point) -> bool:
    if a == b:
        return True
    value, expected = _evaluated(a, shown), _evaluated(b, shown)
    if value is None or expected is None:
        return False
    return isclose(value, expected, rel_tol=1e-6, abs_tol=2e-6)


_TOKEN = re.compile(r"\s*(\$[A-Za-z_]\w*|\d+\.?\d*|[-+*/()])")


def _evaluated(text: str, shown: Point) -> float | None:
    """Return the number of an attribute; `None` if it is none."""
    if text.startswith("${"):
        return _Evaluation(_TOKEN.findall(text[2:-1]), shown).sum()
    if text.startswith("$"):
        return shown.get(text[1:])
    try:
        return float(text)
    except ValueError:
        return None


class _Evaluation:
    """Computes an expression as `Symbol` writes it."""

    def __init__(self, tokens: Sequence[str], shown: Point) -> None:
        self._tokens: Iterator[str] = iter([*tokens, ""])
        self._shown = shown
        self._next = next(self._tokens)

    def sum(self) -> float:
        value = self._product()
        while self._next in ("+", "-"):
            sign = self._take()
            other = self._product()
            value = value + other if sign == "+" else value - other
        return value

    def _product(self) -> float:
        value = self._atom()
        while self._next in ("*", "/"):
            sign = self._take()
            other = self._atom()
            value = value * other if sign == "*" else value / other
        return value

    def _atom(self) -> float:
        token = self._take()
        if token == "-":
            return -self._atom()
        if token == "(":
            value = self.sum()
            self._take()
            return value
        return self._shown[token[1:]] if token.startswith("$") else float(token)

    def _take(self) -> str:
        token, self._next = self._next, next(self._tokens, "")
        return token


# --- documents ---


def declaration(parameter: OpenParameter, version: XmlVersion) -> Element:
    """Return the declaration, from 1.1 on with its limits."""
    limits = None
    if version >= "1.1" and not parameter.choices:
        limits = element(
            "ConstraintGroup",
            element("ValueConstraint", rule="greaterOrEqual", value=parameter.low),
            element("ValueConstraint", rule="lessOrEqual", value=parameter.high),
        )
    return element(
        "ParameterDeclaration",
        limits,
        name=parameter.name,
        parameterType="double",
        value=parameter.nominal,
    )


def distribution(
    header: Element, parameters: Sequence[OpenParameter], scenario: ir.Scenario, file: str
) -> Element:
    """Return the document with the values that the parameters may have.

    Args:
        header: The `FileHeader`.
        parameters: Those of the document.
        scenario: The scenario; constraints between its parameters hold in every row.
        file: Name of the document of the scenario.
    """
    if scenario.constraints:
        rows = allowed_rows(scenario, parameters)
        given: list[Element] = [_table(parameters, rows)]
    else:
        given = [_single(parameter) for parameter in parameters]
    return element(
        "OpenSCENARIO",
        header,
        element(
            "ParameterValueDistribution",
            element("ScenarioFile", filepath=file),
            element("Deterministic", *given),
        ),
    )


def _single(parameter: OpenParameter) -> Element:
    if parameter.choices:
        values = element(
            "DistributionSet", *(element("Element", value=value) for value in parameter.choices)
        )
    else:
        values = element(
            "DistributionRange",
            element("Range", lowerLimit=parameter.low, upperLimit=parameter.high),
            stepWidth=floor((parameter.high - parameter.low) / STEPS * 1e9) / 1e9,  # reach the end
        )
    return element("DeterministicSingleParameterDistribution", values, parameterName=parameter.name)


def _table(parameters: Sequence[OpenParameter], rows: Sequence[Point]) -> Element:
    return element(
        "DeterministicMultiParameterDistribution",
        element(
            "ValueSetDistribution",
            *(
                element(
                    "ParameterValueSet",
                    *(
                        element(
                            "ParameterAssignment",
                            parameterRef=p.name,
                            value=row[p.declaration.name],
                        )
                        for p in parameters
                    ),
                )
                for row in rows
            ),
        ),
    )
