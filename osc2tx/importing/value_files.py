"""Documents with distributions: which values they give the parameters of a scenario."""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx.importing.cursor import Ledger, Node
from osc2tx.importing.declarations import header_of
from osc2tx.importing.distributions import Distribution, Open
from osc2tx.importing.document import Refused
from osc2tx.importing.report import ImportReport
from osc2tx.xosc import Element

MOST_VALUES = 10_000


def read_distribution(root: Element, report: ImportReport) -> Distribution:
    """Return the values of a document with distributions; what is not used of it is reported.

    Raises:
        Refused: It names no scenario.
    """
    ledger = Ledger(report)
    node = ledger.track(root, report.source)
    holder = node.find("ParameterValueDistribution")
    if holder is None:
        raise Refused("it has neither a storyboard nor distributions", root.place)
    file = holder.find("ScenarioFile")
    path = None if file is None else file.text("filepath")
    if file is None or not path:
        raise Refused("it names no scenario", holder.place)
    found = Distribution(path, file.place)
    if (header := node.find("FileHeader")) is not None:
        found.header = header_of(header, "")
    for kind in holder.children("Deterministic"):
        for each in kind.children():
            _distribution(each, found, "sets and ranges")
    for kind in holder.children("Stochastic"):
        found.is_drawn = True
        found.runs = _whole(kind, "numberOfTestRuns")
        found.seed = _whole(kind, "randomSeed")
        for each in kind.children():
            _distribution(each, found, "ranges and sets")
    ledger.close()
    return found


def _whole(node: Node, name: str) -> int:
    try:
        return int(float(node.text(name) or 0))
    except (ValueError, OverflowError):
        raise Refused(f"{name} of <{node.tag}> is no number", node.place) from None


def _distribution(node: Node, found: Distribution, only: str) -> None:
    """Take what a parameter may be, or what several together may be."""
    name = node.text("parameterName") or ""
    for each in node.children():
        match each.tag:
            case "DistributionSet" | "ProbabilityDistributionSet":
                values = tuple(element.text("value") or "" for element in each.children("Element"))
                found.open[name] = Open(values, place=node.place)
                if each.tag == "DistributionSet":
                    found.axes.append([{name: value} for value in values])
                else:
                    each.approximate("values are drawn evenly")
            case "DistributionRange":
                found.open[name] = Open((), *_limits(each), node.place)
                found.axes.append([{name: value} for value in _steps(each)])
            case "UniformDistribution" | "NormalDistribution" | "LogNormalDistribution":
                found.open[name] = Open((), *_limits(each), node.place)
                if each.tag != "UniformDistribution":
                    each.approximate("values are drawn evenly from the range")
            case "ValueSetDistribution":
                _value_sets(each, found)
            case _:
                each.leave_out(f"only {only} are imported")


def _value_sets(node: Node, found: Distribution) -> None:
    rows = [
        {
            cell.text("parameterRef") or "": cell.text("value") or ""
            for cell in row.children("ParameterAssignment")
        }
        for row in node.children("ParameterValueSet")
    ]
    found.axes.append(list(rows))
    for key in dict.fromkeys(key for row in rows for key in row):
        texts = tuple(dict.fromkeys(row[key] for row in rows if key in row))
        found.open[key] = Open(texts, place=node.place)


def _limits(node: Node) -> tuple[float, float]:
    range_ = node.find("Range")
    if range_ is None:
        return -math.inf, math.inf
    return _limit(range_, "lowerLimit", -math.inf), _limit(range_, "upperLimit", math.inf)


def _limit(node: Node, name: str, default: float) -> float:
    text = node.text(name)
    try:
        return float(text) if text else default
    except ValueError:
        raise Refused(f"{name}={text!r} of <{node.tag}> is no number", node.place) from None


def _steps(node: Node) -> Iterator[str]:
    low, high = _limits(node)
    step = _limit(node, "stepWidth", 0.0)
    if not math.isfinite(low) or not math.isfinite(high) or not step > 0.0:
        raise Refused("a range without limits or steps", node.place)
    count = (high - low) / step
    if not count < MOST_VALUES:
        raise Refused(f"a range of {count:.0f} values", node.place)
    for index in range(math.floor(count + 1e-9) + 1):
        yield repr(round(low + index * step, 12))
