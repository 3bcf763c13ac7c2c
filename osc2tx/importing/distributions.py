"""Values for runs: documents with distributions become scenarios with open parameters.

What varies is an open parameter; `keep` says its range or its values. Deterministic distributions
say which rows there are: a table of them is what a campaign runs. Stochastic ones are drawn.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import field
from itertools import chain, islice, product
from types import MappingProxyType

from osc2tx.importing.substitution import read_in, values_in
from osc2tx.xosc import Element, Place
from osc2tx.xosc.arithmetic import evaluated
from osc2tx.xosc.player.courses import RULES
from osc2tx_shared.classes import dataclass

MOST_ROWS = 5000
MOST_COMBINATIONS = 100_000


@dataclass
class Open:
    """What a parameter may be.

    Attributes:
        values: Its values; empty: a range.
        low: Lower limit.
        high: Upper limit.
        place: Where that stands.
    """

    values: tuple[str, ...] = ()
    low: float = -math.inf
    high: float = math.inf
    place: Place | None = None

    @property
    def is_open(self) -> bool:
        """Whether there is more than one value."""
        return len(set(self.values)) != 1

    def allows(self, text: str) -> bool:
        """Whether a parameter may have a value."""
        if self.values:
            return any(_is_same(text, each) for each in self.values)
        try:
            return self.low <= float(text) <= self.high
        except ValueError:
            return False


def _has(row: Mapping[str, str], wanted: Mapping[str, str]) -> bool:
    return all(_is_same(text, wanted[name]) for name, text in row.items() if name in wanted)


def _is_same(one: str, other: str) -> bool:
    """Whether texts are the same value."""
    try:
        return float(one) == float(other)
    except ValueError:
        return one == other


NOTHING: Mapping[str, Open] = {}
"""Nothing that varies."""


def merged(one: Mapping[str, Open], other: Mapping[str, Open]) -> dict[str, Open]:
    """Return what parameters may be by one of two distributions."""
    found = dict(one)
    for name, each in other.items():
        mine = found.get(name, each)
        is_listed = bool(mine.values and each.values)
        values = tuple(dict.fromkeys((*mine.values, *each.values))) if is_listed else ()
        found[name] = Open(values, place=mine.place)
    return found


@dataclass
class Distribution:
    """Values for the runs of a scenario.

    Attributes:
        scenario: Path of its document.
        place: Where that is named.
        header: Comments at the beginning of its file.
        open: What each parameter may be, by its name in the document.
        axes: Rows of values that are combined with each other, of parameters that vary together.
        is_drawn: Whether values are drawn.
        runs: How many rows are drawn.
        seed: Seed of what is drawn.
        chosen: A row that meets the constraints of the scenario, one with the values that this has
            itself if there is one; empty: none is known.
        declared: Texts of the parameters of the scenario.
        constraints: The constraints of its parameters.
        kept: Parameters that have the values of the scenario in the first run, if these occur.
    """

    scenario: str
    place: Place | None = None
    header: list[str] = field(default_factory=list)
    open: dict[str, Open] = field(default_factory=dict)
    axes: list[list[Mapping[str, str]]] = field(default_factory=list)
    is_drawn: bool = False
    runs: int = 0
    seed: int = 0
    chosen: Mapping[str, str] = field(default_factory=dict)
    declared: Mapping[str, str] = field(default_factory=dict)
    constraints: list[_Constraint] = field(default_factory=list)
    kept: Collection[str] = ()

    @property
    def size(self) -> int:
        """The number of rows."""
        return math.prod(len(axis) for axis in self.axes)

    @property
    def first(self) -> dict[str, str]:
        """Values of one run: a chosen row, else first ones of sets and lower limits of ranges."""
        if self.chosen:
            return dict(self.chosen)
        found = {
            name: each.values[0] if each.values else repr(each.low)
            for name, each in self.open.items()
            if each.values or math.isfinite(each.low)
        }
        own = {name: self.declared[name] for name in self.kept if name in self.declared}
        return found | {name: text for name, text in own.items() if self.open[name].allows(text)}

    def unvaried(self, used: Collection[str]) -> Iterator[tuple[str, Open]]:
        """Yield what varies, but not in a scenario in which some parameters are open."""
        for name, each in self.open.items():
            if name not in used and each.is_open:
                yield name, each

    def constrain(self, scenario: Element, kept: Collection[str] = ()) -> None:
        """Leave out the rows that the parameters of a scenario do not allow; choose the first.

        Args:
            scenario: The scenario.
            kept: Parameters whose values the chosen row takes from the scenario, if one does.
        """
        self.kept = kept
        declarations = [node for node in scenario.walk() if node.tag == "ParameterDeclaration"]
        self.declared = values_in(declarations)
        self.constraints = [_Constraint(node) for node in declarations if node.children]
        if self.axes:
            own = [
                {name: self.declared[name] for name in names if name in self.declared}
                for names in (self.open, kept)
            ]
            self.chosen = next(chain(*map(self.rows, own), self.rows()), {})

    def rows(self, wanted: Mapping[str, str] = MappingProxyType({})) -> Iterator[Mapping[str, str]]:
        """Yield the rows of deterministic distributions: all combinations that are allowed.

        Args:
            wanted: Values that some parameters have to have.
        """
        axes = [[part for part in axis if _has(part, wanted)] for axis in self.axes]
        for parts in islice(product(*axes), MOST_COMBINATIONS):
            row = {name: value for part in parts for name, value in part.items()}
            texts = {**self.declared, **row}
            if all(each.allows(texts) for each in self.constraints):
                yield row


class _Constraint:
    """The constraints of a parameter; the result for the same values is kept."""

    def __init__(self, declaration: Element) -> None:
        self._name = declaration.get("name") or ""
        groups = [each for each in declaration.children if each.tag == "ConstraintGroup"]
        self._groups = groups
        limits = (each.get("value") or "" for group in groups for each in group.children)
        self._names = sorted({self._name, *(name for text in limits for name in read_in(text))})
        self._known: dict[tuple[str | None, ...], bool] = {}

    def allows(self, texts: Mapping[str, str]) -> bool:
        """Whether the value meets one of the groups of constraints, or there are none."""
        key = tuple(texts.get(name) for name in self._names)
        if key not in self._known:
            self._known[key] = self._meets(
                {name: texts[name] for name in self._names if name in texts}
            )
        return self._known[key]

    def _meets(self, texts: Mapping[str, str]) -> bool:
        values = {}
        for name, text in texts.items():
            try:
                values[name] = float(text)
            except ValueError:
                continue  # a text has no order
        own = values.get(self._name)
        return own is None or not self._groups or any(_meets(own, g, values) for g in self._groups)


def _meets(own: float, group: Element, values: Mapping[str, float]) -> bool:
    """Whether a number meets constraints; of others the scenario says what they cannot be."""
    for each in group.children:
        rule = RULES.get(each.get("rule") or "")
        limit = evaluated(each.get("value") or "", values)
        if rule is not None and limit is not None and not rule(own, limit):
            return False
    return True


def meets(declaration: Element, text: str) -> bool:
    """Whether a number meets the constraints of a parameter, all of whose limits are numbers."""
    groups = [each.children for each in declaration.children if each.tag == "ConstraintGroup"]

    def is_within(limit: Element) -> bool:
        return RULES[limit.get("rule") or ""](float(text), float(limit.get("value") or ""))

    try:
        return any(all(map(is_within, group)) for group in groups)
    except (KeyError, ValueError):
        return False
