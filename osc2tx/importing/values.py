"""Parameters and expressions of a document as typed ones with units.

Attributes say what dimension they have, so expressions say which ones their parameters have:
`${$v / 3.6}` where a speed stands makes `$v` a speed in kph. A parameter with several dimensions
is a plain number, which gets its unit where it is used.
"""

from __future__ import annotations

import re
from collections import defaultdict
from math import isfinite

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import (
    ANGLE,
    NUMBER,
    PRODUCT,
    SPEED,
    SUM,
    TYPES,
    UNITS,
    Dimension,
    Quantity,
    literal,
    short,
)
from osc2tx.importing.document import Document
from osc2tx.importing.expressions import (
    Expression,
    Name,
    Number,
    Operation,
    Untyped,
    is_per_hour,
    names_in,
    parsed,
)
from osc2tx.importing.inference import Votes, uses_in, vote
from osc2tx.importing.names import Names, snake
from osc2tx.xosc.element import Unresolved
from osc2tx_shared.classes import dataclass


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
        uses = uses_in(self._document.root)
        votes: Votes = defaultdict(set)
        before = -1
        while (count := sum(map(len, votes.values()))) > before:
            before = count
            for expression, dimension in uses:
                vote(expression, dimension, False, votes)
            self._take(votes)

    def _take(self, votes: Votes) -> None:
        """Take what votes say, and let the expressions of parameters vote for others."""
        for said, parameter in reversed(self.parameters.items()):
            found = votes[said]
            if len(found) == 1 and parameter.kind == "double":
                parameter.dimension, parameter.is_hourly = next(iter(found))
            if parameter.expression is not None and parameter.dimension != NUMBER:
                vote(parameter.expression, parameter.dimension, parameter.is_hourly, votes)

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
        return f"{short(number)}{unit}"

    def _typed(self, node: Expression, wanted: Dimension, value: float) -> Quantity:
        if isinstance(node, Number):
            return Quantity(literal(node.value, wanted), value)
        found = self._written(node, wanted)
        for name in names_in(node):
            self.parameters[name].is_used = True
        return Quantity(found.text, value, True, found.binding)

    def _written(self, node: Expression, wanted: Dimension) -> Quantity:
        if isinstance(node, Number):
            return Quantity(literal(node.value, wanted), 0.0)
        if isinstance(node, Name):
            return self._named(node, wanted)
        if is_per_hour(node) and self._counts_hourly(node.left):
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
        if is_per_hour(node) and self._counts_hourly(node.left):
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
        found = [self.parameters.get(name) for name in names_in(node)]
        return bool(found) and all(each is not None and each.is_hourly for each in found)

    def _hourly(self, node: Expression) -> Quantity:
        """Return kilometres per hour as a speed."""
        if isinstance(node, Number):
            return Quantity(f"{short(node.value)}kph", 0.0)
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
            factor = Quantity(short(node.right.value), 0.0)
            return _joined(self._hourly(node.left), node.sign, factor, PRODUCT)
        if isinstance(node.left, Number) and node.sign == "*":
            factor = Quantity(short(node.left.value), 0.0)
            return _joined(factor, "*", self._hourly(node.right), PRODUCT)
        raise Untyped("kph")


def _joined(left: Quantity, sign: str, right: Quantity, binding: int) -> Quantity:
    bound = right.within(binding + (sign in "-/"))
    return Quantity(f"{left.within(binding)} {sign} {bound}", 0.0, True, binding)
