"""The parameters of a document, with the dimensions that their uses give them.

Attributes say what dimension they have, so expressions say which ones their parameters have:
`${$v / 3.6}` where a speed stands makes `$v` a speed in kph.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping

from osc2tx.importing.dimensions import ANGLE, NUMBER, UNITS, Dimension
from osc2tx.importing.distributions import Open
from osc2tx.importing.document import Document
from osc2tx.importing.expressions import (
    Expression,
    Name,
    Operation,
    Untyped,
    is_per_hour,
    parsed,
    substituted,
    without_sign,
)
from osc2tx.importing.inference import Votes, uses_in, vote
from osc2tx.importing.names import Names, shortened, snake
from osc2tx.xosc import Element
from osc2tx_shared.classes import dataclass

_UNIT = re.compile(r"_(kph|mps|mps2|mpss|m|s|deg|rad|kmh)$")


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
                vote(expression, dimension, False, votes)
            self._take(votes)

    def _take(self, votes: Votes) -> None:
        """Take what votes say, and let the expressions of parameters vote for others."""
        for said, parameter in reversed(self.by_name.items()):
            found = votes[said]
            if len(found) == 1 and parameter.kind == "double":
                parameter.dimension, parameter.is_hourly = next(iter(found))
            if parameter.expression is not None and parameter.dimension != NUMBER:
                vote(parameter.expression, parameter.dimension, parameter.is_hourly, votes)

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
            if parameter.dimension == other.dimension and other.is_hourly == is_hourly:
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
