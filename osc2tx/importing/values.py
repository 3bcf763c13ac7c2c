"""Parameters and expressions of a document as typed ones with units.

Attributes say what dimension they have, so expressions say which ones their parameters have:
`${$v / 3.6}` where a speed stands makes `$v` a speed in kph. A parameter with several dimensions
is a plain number, which gets its unit where it is used.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from math import isfinite
from typing import NamedTuple, TypeAlias

from osc2tx.importing.cursor import Node
from osc2tx.importing.document import Document
from osc2tx.importing.names import Names, snake
from osc2tx.xosc.arithmetic import CONSTANTS
from osc2tx.xosc.element import Element, Unresolved
from osc2tx.xosc.schema import attributes_of
from osc2tx_shared.classes import dataclass


class Dimension(NamedTuple):
    """Exponents of metre, second and radian."""

    m: int
    s: int
    rad: int

    def __mul__(self, other: Dimension) -> Dimension:  # type: ignore[override]
        return Dimension(self.m + other.m, self.s + other.s, self.rad + other.rad)

    def __truediv__(self, other: Dimension) -> Dimension:
        return Dimension(self.m - other.m, self.s - other.s, self.rad - other.rad)


NUMBER, LENGTH, TIME = Dimension(0, 0, 0), Dimension(1, 0, 0), Dimension(0, 1, 0)
SPEED, ACCELERATION = Dimension(1, -1, 0), Dimension(1, -2, 0)
JERK, ANGLE = Dimension(1, -3, 0), Dimension(0, 0, 1)

UNITS: Mapping[Dimension, tuple[tuple[str, float], ...]] = {
    LENGTH: (("m", 1.0),),
    TIME: (("s", 1.0),),
    SPEED: (("mps", 1.0), ("kph", 1.0 / 3.6)),
    ACCELERATION: (("mpss", 1.0),),
    JERK: (("mpspsps", 1.0),),
    ANGLE: (("deg", 0.017453292519943295), ("rad", 1.0)),
}
"""Units of the language that people write, with their SI values; the first is the usual one."""

TYPES = {
    LENGTH: "length",
    TIME: "time",
    SPEED: "speed",
    ACCELERATION: "acceleration",
    JERK: "jerk",
    ANGLE: "angle",
    NUMBER: "float",
}
OF_SCHEMA = {
    "m": LENGTH,
    "s": TIME,
    "m/s": SPEED,
    "m/s²": ACCELERATION,
    "m/s^2": ACCELERATION,
    "m/s³": JERK,
    "rad": ANGLE,
}
SUM, PRODUCT, ATOM = 1, 2, 3
DIGITS = 8

_TOKEN = re.compile(r"\s*(\$?[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+*/(),%])")


class Untyped(Exception):
    """An expression that has no form in the language; its value has."""


@dataclass(frozen=True, slots=True)
class Number:
    """A number of an expression."""

    value: float


@dataclass(frozen=True, slots=True)
class Name:
    """A parameter of an expression."""

    name: str


@dataclass(frozen=True, slots=True)
class Operation:
    """Two operands of an expression with their sign."""

    sign: str
    left: Expression
    right: Expression


Expression: TypeAlias = Number | Name | Operation


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value of the document.

    Attributes:
        text: The expression of the language, with units.
        value: Its nominal value, in SI units.
        is_open: Whether parameters give it.
        binding: How tightly its outermost operator binds.
    """

    text: str
    value: float
    is_open: bool = False
    binding: int = ATOM

    def within(self, binding: int) -> str:
        """Return its text as an operand of an operator."""
        is_loose = self.binding < binding or (binding > SUM and self.text.startswith("-"))
        return f"({self.text})" if is_loose else self.text


def literal(value: float, dimension: Dimension) -> str:
    """Return a number with the unit in which it is shortest."""
    if abs(value) < 1e-12:
        value = 0.0
    units = UNITS.get(dimension, (("", 1.0),))
    shown = [(_short(value / factor), unit) for unit, factor in units]
    fits = [
        (len(text.rstrip("0").lstrip("-")), index)
        for index, (text, unit) in enumerate(shown)
        if abs(float(text) * units[index][1] - value) <= 1e-9 * max(abs(value), 1e-3)
    ]
    index = min(fits, default=(0, 0))[1]
    text, unit = shown[index]
    return f"{text}{unit}" if unit else text if "." in text else f"{text}.0"


def _short(value: float) -> str:
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def parsed(text: str) -> Expression:
    """Return the expression of an attribute.

    Raises:
        Untyped: It has none of sums, products, numbers and parameters.
    """
    if text.startswith("${") and text.endswith("}"):
        return _Parser(text[2:-1]).run()
    if text.startswith("$"):
        return Name(text[1:])
    try:
        return Number(float(text))
    except ValueError:
        raise Untyped(text) from None


class _Parser:
    """Recursive descent over sums and products."""

    def __init__(self, text: str) -> None:
        self._tokens = _TOKEN.findall(text)
        if "".join(self._tokens) != re.sub(r"\s", "", text):
            raise Untyped(text)
        self._at = 0
        self._depth = 0

    def run(self) -> Expression:
        found = self._sum()
        if self._at < len(self._tokens):
            raise Untyped(self._next)
        return found

    @property
    def _next(self) -> str:
        return self._tokens[self._at] if self._at < len(self._tokens) else ""

    def _sum(self) -> Expression:
        value = self._product()
        while self._next in ("+", "-"):
            sign = self._take()
            value = _operation(sign, value, self._product())
        return value

    def _product(self) -> Expression:
        value = self._atom()
        while self._next in ("*", "/"):
            sign = self._take()
            value = _operation(sign, value, self._atom())
        return value

    def _take(self) -> str:
        token = self._next
        self._at += 1
        return token

    def _atom(self) -> Expression:
        self._depth += 1
        token = self._take()
        if self._depth > 50:
            raise Untyped("too deep")
        try:
            if token in ("-", "+"):
                inner = self._atom()
                return inner if token == "+" else _operation("-", Number(0.0), inner)
            if token == "(":
                inner = self._sum()
                if self._take() != ")":
                    raise Untyped("(")
                return inner
            if token.startswith("$"):
                return Name(token[1:])
            if token in CONSTANTS:
                return Number(CONSTANTS[token])
            if token[:1].isdigit() or token[:1] == ".":
                return Number(float(token))
            raise Untyped(token)
        finally:
            self._depth -= 1


def _operation(sign: str, left: Expression, right: Expression) -> Expression:
    """Return an operation, computed if both operands are numbers."""
    if isinstance(left, Number) and isinstance(right, Number):
        a, b = left.value, right.value
        if sign == "/" and b == 0.0:
            raise Untyped("division by zero")
        computed = {"+": a + b, "-": a - b, "*": a * b}.get(sign)
        return Number(a / b if computed is None else computed)
    return Operation(sign, left, right)


def _names(node: Expression) -> Iterator[str]:
    if isinstance(node, Name):
        yield node.name
    elif isinstance(node, Operation):
        yield from _names(node.left)
        yield from _names(node.right)


def _is_hourly(node: Expression) -> bool:
    """Whether an expression divides kilometres per hour by 3.6."""
    return (
        isinstance(node, Operation)
        and node.sign == "/"
        and isinstance(node.right, Number)
        and abs(node.right.value - 3.6) < 1e-9
    )


@dataclass
class Parameter:
    """A parameter of the document.

    Attributes:
        name: Its name in the scenario.
        kind: Its type in the document.
        dimension: What its uses say that it is.
        is_hourly: Whether its number counts kilometres per hour.
        expression: What gives it; `None` for texts and truth values.
        is_used: Whether the scenario reads it.
    """

    name: str
    kind: str
    dimension: Dimension = NUMBER
    is_hourly: bool = False
    expression: Expression | None = None
    is_used: bool = False

    @property
    def unit(self) -> tuple[str, float]:
        """The unit of its number, with its SI value."""
        if self.is_hourly:
            return "kph", 1.0 / 3.6
        if self.dimension == ANGLE:
            return "rad", 1.0
        return UNITS.get(self.dimension, (("", 1.0),))[0]


class Values:
    """The parameters of a document, and its expressions over them.

    Attributes:
        parameters: By their names in the document.
    """

    def __init__(self, document: Document, names: Names) -> None:
        self._document = document
        self.parameters: dict[str, Parameter] = {}
        self._declare(names)
        self._infer()

    def _declare(self, names: Names) -> None:
        for node in self._document.root.children:
            for each in node.children if node.tag == "ParameterDeclarations" else ():
                said = each.get("name") or ""
                kind = (each.get("parameterType") or "").lower()
                expression = None
                if kind in ("double", "int", "integer", "unsignedint", "unsignedshort"):
                    try:
                        expression = parsed(each.get("value") or "")
                    except Untyped:
                        expression = None
                base = snake(re.sub(r"_(kph|mps|mps2|mpss|m|s|deg|rad|kmh)$", "", said))
                name = names.new(said, kind="parameter", base=base)
                self.parameters[said] = Parameter(name, kind, expression=expression)

    # --- inference --------------------------------------------------------------------------------

    def _infer(self) -> None:
        votes: dict[str, set[tuple[Dimension, bool]]] = defaultdict(set)
        for node in self._document.root.walk():
            self._collect(node, votes)
        for said, parameter in reversed(self.parameters.items()):
            found = votes[said]
            if len(found) == 1 and parameter.kind == "double":
                parameter.dimension, parameter.is_hourly = next(iter(found))
            if parameter.expression is not None and parameter.dimension != NUMBER:
                _vote(parameter.expression, parameter.dimension, parameter.is_hourly, votes)

    def _collect(self, node: Element, votes: dict[str, set[tuple[Dimension, bool]]]) -> None:
        if not any(text.startswith("$") for _, text in node.attributes):
            return
        parts = attributes_of(node.tag) if not node.tag.startswith("Parameter") else {}
        for name, text in node.attributes:
            if not text.startswith("$") or name not in parts:
                continue
            dimension = dimension_of(node, name)
            if dimension is None:
                continue
            try:
                _vote(parsed(text), dimension, False, votes)
            except Untyped:
                continue

    # --- values -----------------------------------------------------------------------------------

    def quantity(
        self, node: Node, name: str, dimension: Dimension, default: float = 0.0
    ) -> Quantity:
        """Return the value of an attribute; one that has no form here at its nominal value.

        Raises:
            Unresolved: It has no value.
        """
        text = node.text(name)
        if text is None:
            return Quantity(literal(default, dimension), default)
        value = self.nominal(node, name)
        try:
            return self._typed(parsed(text.strip()), dimension, value)
        except Untyped:
            node.approximate(f"`{text}` has no form with units, so {name} keeps its nominal value")
            return Quantity(literal(value, dimension), value)

    def nominal(self, node: Node, name: str, default: float = 0.0) -> float:
        """Return the nominal value of an attribute, in SI units.

        Raises:
            Unresolved: It has none.
        """
        text = node.text(name)
        if text is None:
            return default
        try:
            value = float(self._document.text_at(text.strip()))
        except ValueError:
            raise Unresolved(f"{name}={text!r} of <{node.tag}> has no value", node.place) from None
        if not isfinite(value) and not text.strip().upper().endswith("INF"):
            raise Unresolved(f"{name}={text!r} of <{node.tag}> has no value", node.place)
        return value

    def fixed(self, node: Node, name: str, default: float = 0.0) -> float:
        """Return a value that the scenario cannot leave open."""
        text = node.text(name)
        if text is not None and text.startswith("$"):
            node.approximate(f"{name} keeps the nominal value of `{text}`")
        return self.nominal(node, name, default)

    def text(self, node: Node, name: str) -> str:
        """Return a text that the scenario cannot leave open.

        Raises:
            Unresolved: It is not there.
        """
        said = node.said(name)
        if said.startswith("$"):
            node.approximate(f"{name} keeps the nominal value of `{said}`")
        return self._document.text_at(said)

    def of_parameter(self, parameter: Parameter) -> str:
        """Return the value of a declaration."""
        assert parameter.expression is not None
        if isinstance(parameter.expression, Number):
            return self.in_unit(parameter.expression.value, parameter)
        said = next(key for key, each in self.parameters.items() if each is parameter)
        value = float(self._document.parameters[said])
        if parameter.is_hourly:
            return self._hourly(parameter.expression).text
        return self._typed(parameter.expression, parameter.dimension, value).text

    def in_unit(self, number: float, parameter: Parameter) -> str:
        """Return a number of the document in the unit of a parameter."""
        unit, _ = parameter.unit
        if parameter.kind != "double":
            return str(round(number))
        if not parameter.is_hourly:
            return literal(number, parameter.dimension)
        return f"{_short(number)}{unit}"

    def _typed(self, node: Expression, wanted: Dimension, value: float) -> Quantity:
        if isinstance(node, Number):
            return Quantity(literal(node.value, wanted), value)
        found = self._written(node, wanted)
        for name in _names(node):
            self.parameters[name].is_used = True
        return Quantity(found.text, value, True, found.binding)

    def _written(self, node: Expression, wanted: Dimension) -> Quantity:
        if isinstance(node, Number):
            return Quantity(literal(node.value, wanted), 0.0)
        if isinstance(node, Name):
            return self._named(node, wanted)
        if _is_hourly(node) and self._counts_hourly(node.left):
            if wanted != SPEED:
                raise Untyped("kph")
            return self._hourly(node.left)
        if node.sign in "+-":
            if node.sign == "-" and node.left == Number(0.0):
                return Quantity(
                    f"-{self._written(node.right, wanted).within(PRODUCT)}", 0.0, True, PRODUCT
                )
            left, right = self._written(node.left, wanted), self._written(node.right, wanted)
            return _joined(left, node.sign, right, SUM)
        return self._scaled(node, wanted)

    def _named(self, node: Name, wanted: Dimension) -> Quantity:
        parameter = self.parameters.get(node.name)
        if parameter is None or parameter.expression is None or parameter.is_hourly:
            raise Untyped(node.name)
        if parameter.dimension == wanted:
            return Quantity(parameter.name, 0.0)
        if parameter.dimension == NUMBER:
            unit = UNITS[wanted][-1 if wanted == ANGLE else 0][0] if wanted in UNITS else None
            if unit is not None:
                return Quantity(f"{parameter.name} * 1{unit}", 0.0, True, PRODUCT)
        raise Untyped(node.name)

    def _scaled(self, node: Operation, wanted: Dimension) -> Quantity:
        of_left, of_right = self._dimension(node.left), self._dimension(node.right)
        if of_left is None and of_right is None:
            raise Untyped("two numbers")
        if node.sign == "*":
            left = wanted / of_right if of_left is None and of_right is not None else of_left
            assert left is not None
            right = wanted / left
        else:
            left = wanted * of_right if of_left is None and of_right is not None else of_left
            assert left is not None
            right = left / wanted
        for asked, known in ((left, of_left), (right, of_right)):
            if known is not None and known != asked:
                return self._from_number(node, wanted)
            if asked not in TYPES:
                raise Untyped("no unit")
        return _joined(
            self._written(node.left, left), node.sign, self._written(node.right, right), PRODUCT
        )

    def _from_number(self, node: Operation, wanted: Dimension) -> Quantity:
        """Return a plain number as a quantity: `factor * 1m`."""
        if wanted == NUMBER or self._dimension(node) != NUMBER or wanted not in UNITS:
            raise Untyped("dimensions")
        unit = UNITS[wanted][-1 if wanted == ANGLE else 0][0]
        return _joined(self._written(node, NUMBER), "*", Quantity(f"1{unit}", 0.0), PRODUCT)

    def _dimension(self, node: Expression) -> Dimension | None:
        """Return the dimension of an expression; `None` for one that is what is needed."""
        if isinstance(node, Number):
            return None
        if isinstance(node, Name):
            parameter = self.parameters.get(node.name)
            if parameter is None or parameter.is_hourly:
                raise Untyped(node.name)
            return parameter.dimension
        if _is_hourly(node) and self._counts_hourly(node.left):
            return SPEED
        left, right = self._dimension(node.left), self._dimension(node.right)
        if node.sign in "+-":
            return right if left is None else left
        if left is None or right is None:
            known = left if right is None else right
            assert known is not None
            return known if node.sign == "*" or right is None else NUMBER / known
        return left * right if node.sign == "*" else left / right

    def _counts_hourly(self, node: Expression) -> bool:
        found = [self.parameters.get(name) for name in _names(node)]
        return bool(found) and all(each is not None and each.is_hourly for each in found)

    def _hourly(self, node: Expression) -> Quantity:
        """Return kilometres per hour as a speed."""
        if isinstance(node, Number):
            return Quantity(f"{_short(node.value)}kph", 0.0)
        if isinstance(node, Name):
            parameter = self.parameters[node.name]
            if not parameter.is_hourly:
                raise Untyped(node.name)
            parameter.is_used = True
            return Quantity(parameter.name, 0.0)
        if node.sign == "-" and node.left == Number(0.0):
            return Quantity(f"-{self._hourly(node.right).within(PRODUCT)}", 0.0, True, PRODUCT)
        if node.sign in "+-":
            return _joined(self._hourly(node.left), node.sign, self._hourly(node.right), SUM)
        if isinstance(node.right, Number):
            factor = Quantity(_short(node.right.value), 0.0)
            return _joined(self._hourly(node.left), node.sign, factor, PRODUCT)
        if isinstance(node.left, Number) and node.sign == "*":
            factor = Quantity(_short(node.left.value), 0.0)
            return _joined(factor, "*", self._hourly(node.right), PRODUCT)
        raise Untyped("kph")


def _joined(left: Quantity, sign: str, right: Quantity, binding: int) -> Quantity:
    bound = right.within(binding + (sign in "-/"))
    return Quantity(f"{left.within(binding)} {sign} {bound}", 0.0, True, binding)


def dimension_of(node: Element, name: str) -> Dimension | None:
    """Return the dimension of an attribute; `None` if the schema says none."""
    part = attributes_of(node.tag).get(name)
    if part is None or part.type != "Double":
        return None
    if node.tag.endswith("Dynamics") and name == "value":
        rate = ACCELERATION if node.tag == "SpeedActionDynamics" else SPEED
        by = {"time": TIME, "distance": LENGTH, "rate": rate}
        return by.get(node.get("dynamicsDimension") or "")
    if node.tag == "RelativeTargetSpeed":
        return SPEED if node.get("speedTargetValueType") != "factor" else NUMBER
    return OF_SCHEMA.get(part.unit) if part.unit else None


def _vote(
    node: Expression,
    dimension: Dimension,
    is_hourly: bool,
    votes: dict[str, set[tuple[Dimension, bool]]],
) -> None:
    """Note what an expression of a dimension says about its parameters."""
    if isinstance(node, Name):
        votes[node.name].add((dimension, is_hourly))
    elif isinstance(node, Operation):
        if dimension == SPEED and not is_hourly and _is_hourly(node):
            _vote(node.left, dimension, True, votes)
        elif node.sign in "+-":
            _vote(node.left, dimension, is_hourly, votes)
            _vote(node.right, dimension, is_hourly, votes)
        else:
            _vote_in_product(node, dimension, is_hourly, votes)


def _vote_in_product(
    node: Operation,
    dimension: Dimension,
    is_hourly: bool,
    votes: dict[str, set[tuple[Dimension, bool]]],
) -> None:
    """A number times something is of its dimension, unless that is a speed by itself."""
    for side, other in ((node.left, node.right), (node.right, node.left)):
        if _is_hourly(side):
            _vote(side, SPEED, False, votes)
        elif isinstance(other, Number) and (node.sign == "*" or side is node.left):
            _vote(side, dimension, is_hourly, votes)
