"""Values for runs: documents with distributions become scenarios with open parameters.

What varies is an open parameter; `keep` says its range or its values. Deterministic distributions
say which rows there are: a table of them is what a campaign runs. Stochastic ones are drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import field
from itertools import islice, product

from osc2tx.importing.document import Refused
from osc2tx.importing.report import ImportReport
from osc2tx.xosc import Element
from osc2tx.xosc.arithmetic import evaluated
from osc2tx.xosc.player.courses import RULES
from osc2tx_shared.classes import dataclass

MOST_ROWS = 5000
MOST_VALUES = 10_000


@dataclass
class Open:
    """What a parameter may be.

    Attributes:
        values: Its values; empty: a range.
        low: Lower limit.
        high: Upper limit.
    """

    values: tuple[str, ...] = ()
    low: float = -math.inf
    high: float = math.inf


@dataclass
class Distribution:
    """Values for the runs of a scenario.

    Attributes:
        scenario: Path of its document.
        open: What each parameter may be, by its name in the document.
        axes: Rows of values that are combined with each other, of parameters that vary together.
        is_drawn: Whether values are drawn.
        runs: How many rows are drawn.
        seed: Seed of what is drawn.
        chosen: The first row that meets the constraints of the scenario; empty: none is known.
    """

    scenario: str
    open: dict[str, Open] = field(default_factory=dict)
    axes: list[list[Mapping[str, str]]] = field(default_factory=list)
    is_drawn: bool = False
    runs: int = 0
    seed: int = 0
    chosen: Mapping[str, str] = field(default_factory=dict)

    @property
    def size(self) -> int:
        """The number of rows."""
        return math.prod(len(axis) for axis in self.axes)

    @property
    def first(self) -> dict[str, str]:
        """Values of one run: a chosen row, else first ones of sets and lower limits of ranges."""
        if self.chosen:
            return dict(self.chosen)
        return {
            name: each.values[0] if each.values else repr(each.low)
            for name, each in self.open.items()
            if each.values or math.isfinite(each.low)
        }

    def rows(self) -> Iterator[Mapping[str, str]]:
        """Yield the rows of deterministic distributions, all combinations."""
        for parts in product(*self.axes):
            yield {name: value for part in parts for name, value in part.items()}

    def choose(self, scenario: Element) -> None:
        """Choose the first row that meets the constraints of the parameters of a scenario."""
        if not self.axes:
            return
        declarations = [
            node for node in scenario.walk() if node.tag == "ParameterDeclaration" and node.children
        ]
        declared = {
            node.get("name") or "": node.get("value") or ""
            for node in scenario.walk()
            if node.tag == "ParameterDeclaration"
        }
        for row in islice(self.rows(), MOST_VALUES):
            texts = {**declared, **row}
            if all(_is_allowed(node, texts) for node in declarations):
                self.chosen = row
                return


def _is_allowed(declaration: Element, texts: Mapping[str, str]) -> bool:
    """Whether the value of a parameter meets one of its groups of constraints, or has none."""
    values = {}
    for name, text in texts.items():
        try:
            values[name] = float(text)
        except ValueError:
            continue  # a text has no order
    own = values.get(declaration.get("name") or "")
    groups = [each for each in declaration.children if each.tag == "ConstraintGroup"]
    return own is None or not groups or any(_meets(own, each, values) for each in groups)


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


def read_distribution(root: Element, report: ImportReport) -> Distribution:
    """Return the values of a document with distributions.

    Raises:
        Refused: It names no scenario.
    """
    holder = next(
        (each for each in root.children if each.tag == "ParameterValueDistribution"), None
    )
    if holder is None:
        raise Refused("it has neither a storyboard nor distributions", root.place)
    files = [each.get("filepath") or "" for each in holder.children if each.tag == "ScenarioFile"]
    if not files or not files[0]:
        raise Refused("it names no scenario", holder.place)
    found = Distribution(files[0])
    for kind in holder.children:
        if kind.tag == "Deterministic":
            for each in kind.children:
                _deterministic(each, found, report)
        elif kind.tag == "Stochastic":
            found.is_drawn = True
            found.runs = int(float(kind.get("numberOfTestRuns") or 0))
            found.seed = int(float(kind.get("randomSeed") or 0))
            for each in kind.children:
                _stochastic(each, found, report)
    return found


def _deterministic(node: Element, found: Distribution, report: ImportReport) -> None:
    name = node.get("parameterName") or ""
    for each in node.children:
        if each.tag == "DistributionSet":
            values = tuple(element.get("value") or "" for element in each.children)
            found.open[name] = Open(values)
            found.axes.append([{name: value} for value in values])
        elif each.tag == "DistributionRange":
            values = tuple(_steps(each))
            low, high = _limits(each)
            found.open[name] = Open((), low, high)
            found.axes.append([{name: value} for value in values])
        elif each.tag == "ValueSetDistribution":
            rows = [
                {cell.get("parameterRef") or "": cell.get("value") or "" for cell in row.children}
                for row in each.children
            ]
            found.axes.append(list(rows))
            for key in dict.fromkeys(key for row in rows for key in row):
                found.open[key] = Open(tuple(dict.fromkeys(row[key] for row in rows if key in row)))
        else:
            report.add("left out", f"<{each.tag}>", "only sets and ranges are imported", each.place)


def _stochastic(node: Element, found: Distribution, report: ImportReport) -> None:
    name = node.get("parameterName") or ""
    for each in node.children:
        if each.tag in ("UniformDistribution", "NormalDistribution", "LogNormalDistribution"):
            low, high = _limits(each)
            found.open[name] = Open((), low, high)
            if each.tag != "UniformDistribution":
                reason = "values are drawn evenly from the range"
                report.add("approximated", f"<{each.tag}>", reason, each.place)
        elif each.tag == "ProbabilityDistributionSet":
            found.open[name] = Open(tuple(element.get("value") or "" for element in each.children))
            report.add("approximated", f"<{each.tag}>", "values are drawn evenly", each.place)
        else:
            report.add("left out", f"<{each.tag}>", "only ranges and sets are imported", each.place)


def _limits(node: Element) -> tuple[float, float]:
    range_ = next((each for each in node.children if each.tag == "Range"), None)
    if range_ is None:
        return -math.inf, math.inf
    return float(range_.get("lowerLimit") or "-inf"), float(range_.get("upperLimit") or "inf")


def _steps(node: Element) -> Iterator[str]:
    low, high = _limits(node)
    step = float(node.get("stepWidth") or 0.0)
    if not math.isfinite(low) or not math.isfinite(high) or step <= 0.0:
        raise Refused("a range without limits or steps", node.place)
    count = math.floor((high - low) / step + 1e-9) + 1
    if count > MOST_VALUES:
        raise Refused(f"a range of {count} values", node.place)
    for index in range(count):
        yield repr(round(low + index * step, 12))
