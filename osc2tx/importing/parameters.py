"""The parameters of a document, with the dimensions that their uses give them.

Attributes say what dimension they have, so expressions say which ones their parameters have:
`${$v / 3.6}` where a speed stands makes `$v` a speed in kph.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping

from osc2tx.importing.dimensions import (
    ACCELERATION,
    ANGLE,
    HOURLY,
    LENGTH,
    NUMBER,
    OF_SCHEMA,
    SPEED,
    TIME,
    UNITS,
    Dimension,
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
    parsed,
    substituted,
    without_sign,
)
from osc2tx.importing.names import Names, shortened, snake
from osc2tx.xosc.element import Element
from osc2tx.xosc.schema import attributes_of
from osc2tx_shared.classes import dataclass

_UNIT = re.compile(r"_(kph|mps|mps2|mpss|m|s|deg|rad|kmh)$")


@dataclass
class Parameter:
    """A parameter of the document.

    Attributes:
        name: Its name in the scenario.
        kind: Its type in the document.
        dimension: What its uses say that it is.
        expression: What gives it; `None` for texts and truth values.
        is_used: Whether the scenario reads it.
    """

    name: str
    kind: str
    dimension: Dimension = NUMBER
    expression: Expression | None = None
    is_used: bool = False

    @property
    def unit(self) -> tuple[str, float]:
        """The unit of its number, with its SI value."""
        if self.dimension == HOURLY:
            return "kph", 1.0 / 3.6
        if self.dimension == ANGLE:
            return "rad", 1.0
        return UNITS.get(self.dimension, (("", 1.0),))[0]


class Parameters:
    """The parameters of a document.

    Attributes:
        by_name: By their names in the document.
        aliases: Those that are others in another unit, with these.
    """

    def __init__(self, document: Document, names: Names, open_: Mapping[str, Open]) -> None:
        self._document, self._open = document, open_
        self.by_name: dict[str, Parameter] = {}
        self.aliases: dict[str, Expression] = {}
        self._declare(names)
        self._infer()
        self._find_aliases()

    def _declare(self, names: Names) -> None:
        declared = self._declarations
        actors = (snake(each.get("name") or "") for each in self._document.tagged("ScenarioObject"))
        bases = [snake(_UNIT.sub("", each.get("name") or "")) for each in declared]
        for each, base in zip(declared, shortened(bases, actors), strict=True):
            said = each.get("name") or ""
            kind = (each.get("parameterType") or "").lower()
            expression = None
            if kind in ("double", "int", "integer", "unsignedint", "unsignedshort"):
                try:
                    expression = parsed(each.get("value") or "")
                except Untyped:
                    expression = None
            name = names.new(said, kind="parameter", base=base)
            self.by_name[said] = Parameter(name, kind, expression=expression)

    @property
    def _declarations(self) -> list[Element]:
        holders = self._document.root.children
        return [
            each
            for holder in holders
            for each in (holder.children if holder.tag == "ParameterDeclarations" else ())
        ]

    # --- inference --------------------------------------------------------------------------------

    def _infer(self) -> None:
        uses = uses_in(self._document.root)
        votes: Votes = defaultdict(set)
        before = -1
        while (count := sum(map(len, votes.values()))) > before:
            before = count
            for expression, dimension in uses:
                vote(expression, dimension, votes)
            self._take(votes)

    def _take(self, votes: Votes) -> None:
        """Take what votes say, and let the expressions of parameters vote for others."""
        for said, parameter in reversed(self.by_name.items()):
            found = votes[said]
            if len(found) == 1 and parameter.kind == "double":
                (parameter.dimension,) = found
            if parameter.expression is not None and parameter.dimension != NUMBER:
                vote(parameter.expression, parameter.dimension, votes)

    def _find_aliases(self) -> None:
        """Find the parameters that only say others once more, in another unit or with a sign."""
        declared = {each.get("name") or "": each for each in self._declarations}
        for said, parameter in self.by_name.items():
            node = parameter.expression
            if said in self._open or node is None or declared[said].children:
                continue
            node = substituted(node, self.aliases)
            bare = without_sign(node) or node
            is_hourly = is_per_hour(bare)
            inner = bare.left if is_hourly and isinstance(bare, Operation) else bare
            other = self.by_name.get(inner.name) if isinstance(inner, Name) else None
            if other is None or other.kind != parameter.kind:
                continue
            if other.dimension == (HOURLY if is_hourly else parameter.dimension):
                self.aliases[said] = node
        for parameter in self.by_name.values():
            if parameter.expression is not None:
                parameter.expression = substituted(parameter.expression, self.aliases)

    def allowed(self, parameter: Parameter) -> set[float] | None:
        """Return the only values that a parameter may have; `None`: others are possible."""
        said = next(key for key, each in self.by_name.items() if each is parameter)
        if said in self._open:
            values = self._open[said].values
            return {float(each) for each in values} if values else None
        groups = [
            [(each.get("rule"), each.get("value") or "") for each in group.children]
            for node in self._document.tagged("ParameterDeclaration")
            for group in (node.children if node.get("name") == said else ())
        ]
        try:
            found = [float(text) for ((rule, text),) in groups if rule == "equalTo"]
        except ValueError:  # several limits together, or an expression
            return None
        return set(found) if found and len(found) == len(groups) else None


Votes = dict[str, set[Dimension]]
"""What the uses of parameters say, by their names."""


def uses_in(root: Element) -> list[tuple[Expression, Dimension]]:
    """Return the expressions of attributes that the schema gives a dimension."""
    given = [node for node in root.walk() if "$" in [text[:1] for _, text in node.attributes]]
    return [each for node in given for each in _uses_at(node)]


def _uses_at(node: Element) -> Iterator[tuple[Expression, Dimension]]:
    parts = attributes_of(node.tag) if not node.tag.startswith("Parameter") else {}
    for name, text in node.attributes:
        dimension = dimension_of(node, name) if text.startswith("$") and name in parts else None
        if dimension is None:
            continue
        try:
            yield parsed(text), dimension
        except Untyped:
            continue


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


def vote(node: Expression, dimension: Dimension, votes: Votes) -> None:
    """Note what an expression of a dimension says about its parameters."""
    if isinstance(node, Name):
        votes[node.name].add(dimension)
    elif isinstance(node, Operation):
        if dimension == SPEED and is_per_hour(node):
            vote(node.left, HOURLY, votes)
        elif node.sign in "+-":
            vote(node.left, dimension, votes)
            vote(node.right, dimension, votes)
        else:
            _vote_in_product(node, dimension, votes)


def _vote_in_product(node: Operation, dimension: Dimension, votes: Votes) -> None:
    """A number times something is of its dimension, unless that is a speed by itself.

    Of two factors the one whose dimension is known says that of the other one.
    """
    left, right = known(node.left, votes), known(node.right, votes)
    if left is None and right is not None:
        vote(node.left, dimension / right if node.sign == "*" else dimension * right, votes)
    elif right is None and left is not None:
        vote(node.right, dimension / left if node.sign == "*" else left / dimension, votes)
    for side, other in ((node.left, node.right), (node.right, node.left)):
        if is_per_hour(side):
            vote(side, SPEED, votes)
        elif isinstance(other, Number) and (node.sign == "*" or side is node.left):
            vote(side, dimension, votes)


def known(node: Expression, votes: Votes) -> Dimension | None:
    """Return the dimension that votes give an expression; `None`: none, or several."""
    if isinstance(node, Number):
        return None
    if isinstance(node, Name):
        found = votes.get(node.name, set())
        return next(iter(found)) if len(found) == 1 and HOURLY not in found else None
    if is_per_hour(node):
        return SPEED
    left, right = known(node.left, votes), known(node.right, votes)
    if node.sign in "+-":
        return right if left is None else left
    if isinstance(node.right, Number):
        return left
    if left is None or right is None:
        return right if isinstance(node.left, Number) and node.sign == "*" else None
    return left * right if node.sign == "*" else left / right
