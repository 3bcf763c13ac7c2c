"""Expressions of a document as typed ones with units.

A parameter with several dimensions is a plain number, which gets its unit where it is used.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isfinite
from pathlib import Path

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import (
    ANGLE,
    HOURLY,
    NUMBER,
    PRODUCT,
    SPEED,
    TYPES,
    UNITS,
    Dimension,
    Quantity,
    literal,
    total,
)
from osc2tx.importing.distributions import Open
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
    substituted,
    without_sign,
)
from osc2tx.importing.names import Names
from osc2tx.importing.parameters import Parameter, Parameters
from osc2tx.importing.substitution import read_in
from osc2tx.xosc.element import Unresolved
from osc2tx_shared.classes import replace


class Values:
    """The values of a document, expressions over its parameters.

    Attributes:
        document: The document.
        parameters: By their names there.
        aliases: Parameters that are others in another unit, with these.
        allowed: Gives the only values that a parameter may have; `None`: others are possible.
    """

    def __init__(
        self, document: Document, names: Names, open_: Mapping[str, Open] | None = None
    ) -> None:
        self.document = document
        self._open = open_ or {}
        found = Parameters(document, names, self._open)
        self.parameters, self.aliases = found.by_name, found.aliases
        self.allowed = found.allowed

    def parsed(self, text: str) -> Expression:
        """Return the expression of an attribute over parameters that are declared.

        Raises:
            Untyped: It has none.
        """
        return substituted(parsed(text.strip()), self.aliases)

    def entry(self, reference: Node, instead: str = "") -> tuple[Node, Path] | None:
        """Return the entry that a `CatalogReference` names, and its file.

        `None`, with a finding: there is none; `instead` tells what stands for it, if anything does.
        """
        said = self.text(reference, "entryName")
        self.text(reference, "catalogName")
        for each in reference.children("ParameterAssignments"):
            each.use_all()
        found = self.document.entry(reference.element)
        if found is None:
            reason = f"there is no entry {said} in the catalogs"
            if instead:
                reference.approximate(f"{reason}; {instead}")
            else:
                reference.leave_out(reason)
            return None
        return reference.entry(found[0], found[1].name), found[1]

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
            return self._typed(self.parsed(text), dimension, value)
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
            value = float(self.document.text_at(text.strip()))
        except ValueError:
            raise Unresolved(f"{name}={text!r} of <{node.tag}> has no value", node.place) from None
        if not isfinite(value) and not text.strip().upper().endswith("INF"):
            raise Unresolved(f"{name}={text!r} of <{node.tag}> has no value", node.place)
        return value

    def varies(self, node: Node, name: str) -> bool:
        """Whether the value of an attribute varies from run to run."""
        return self.varies_in(node.element.get(name) or "")

    def varies_in(self, text: str) -> bool:
        """Whether the value of a text varies from run to run."""
        found: set[str] = set()
        left = read_in(text)
        while left:
            found |= left
            given = (self.document.declared.get(each, "") for each in left)
            left = {name for text in given for name in read_in(text)} - found
        return not found.isdisjoint(self._open)

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
        return self.document.text_at(said)

    def of_parameter(self, parameter: Parameter) -> str:
        """Return the value of a declaration."""
        assert parameter.expression is not None
        return self._in_its_unit(parameter.expression, parameter)

    def as_parameter(self, text: str, parameter: Parameter) -> str:
        """Return a limit of a parameter.

        Raises:
            Untyped: It has no form in the language.
        """
        return self._in_its_unit(self.parsed(text), parameter)

    def _in_its_unit(self, node: Expression, parameter: Parameter) -> str:
        """Return what gives a parameter, or a limit of it."""
        if isinstance(node, Number):
            return self.in_unit(node.value, parameter)
        return self._typed(node, parameter.dimension, 0.0).text

    def in_unit(self, number: float, parameter: Parameter) -> str:
        """Return a number of the document in the unit of a parameter."""
        if parameter.kind != "double":
            return str(round(number))
        return literal(number, parameter.dimension)

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
        if is_per_hour(node) and self._has_hourly_unit(node.left):
            if wanted != SPEED:
                raise Untyped("kph")
            return self._written(node.left, HOURLY)
        if node.sign in "+-":
            if node.sign == "-" and node.left == Number(0.0):
                return Quantity(
                    f"-{self._written(node.right, wanted).within(PRODUCT)}", 0.0, True, PRODUCT
                )
            return total(wanted, *self._summands(node, 1, wanted))
        return self._scaled(node, wanted)

    def _summands(
        self, node: Expression, sign: int, wanted: Dimension
    ) -> Iterator[tuple[int, Quantity]]:
        """Yield what a sum adds up, with signs."""
        bare = without_sign(node)
        if bare is not None:
            yield from self._summands(bare, -sign, wanted)
        elif isinstance(node, Number):
            yield sign, Quantity(literal(node.value, wanted), node.value)
        elif isinstance(node, Operation) and node.sign in "+-":
            yield from self._summands(node.left, sign, wanted)
            if node.sign == "+" or not isinstance(node.right, Operation):
                yield from self._summands(
                    node.right, sign * (1 if node.sign == "+" else -1), wanted
                )
            else:  # stays in its brackets
                yield -sign, replace(self._written(node.right, wanted), is_open=True)
        else:
            found = self._written(node, wanted)
            yield sign, Quantity(found.text, 0.0, True, found.binding)

    def _named(self, node: Name, wanted: Dimension) -> Quantity:
        parameter = self.parameters.get(node.name)
        if parameter is None or parameter.expression is None:
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
            if parameter is None:
                raise Untyped(node.name)
            return parameter.dimension
        if is_per_hour(node) and self._has_hourly_unit(node.left):
            return SPEED
        left, right = self._dimension(node.left), self._dimension(node.right)
        if node.sign in "+-":
            return right if left is None else left
        if left is None or right is None:
            known = left if right is None else right
            assert known is not None
            return known if node.sign == "*" or right is None else NUMBER / known
        return left * right if node.sign == "*" else left / right

    def _has_hourly_unit(self, node: Expression) -> bool:
        found = [self.parameters.get(name) for name in names_in(node)]
        return bool(found) and all(each is not None and each.dimension == HOURLY for each in found)


def _joined(left: Quantity, sign: str, right: Quantity, binding: int) -> Quantity:
    bound = right.within(binding + (sign in "-/"))
    return Quantity(f"{left.within(binding)} {sign} {bound}", 0.0, True, binding)
