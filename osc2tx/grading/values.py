"""Values of open parameters for the runs that measure a document: the corners of their ranges."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element

Values = dict[str, str]
"""Texts of parameters of a document, by name."""

MOST_CORNERS = 4


def corners(distribution: Element | None) -> list[Values]:
    """Return the corners of the ranges of a document, `MOST_CORNERS` at most.

    All parameters are at their lower limit, all at their upper one, and alternately at one and the
    other. Of values that are listed together the first and the last ones count.

    Args:
        distribution: The document with the values of its open parameters.
    """
    if distribution is None:
        return []
    tables = [
        {each.parameterRef: each.value for each in row.all(xml.ParameterAssignment)}
        for row in distribution.below(xml.ParameterValueSet)
    ]
    ends = {
        each.parameterName: _ends(each.inner)
        for each in distribution.below(xml.DeterministicSingleParameterDistribution)
    }
    found: list[Values] = []
    half = MOST_CORNERS // 2
    for row in (*_combined(ends), *tables[:half], *tables[half:][-half:]):
        if row and row not in found:
            found.append(row)
    return found[:MOST_CORNERS]


def _ends(values: Element) -> tuple[str, str]:
    """Return the first and the last value of a distribution."""
    if isinstance(values, xml.DistributionRange):
        limits = values.one(xml.Range)
        return limits.said("lowerLimit"), limits.said("upperLimit")
    texts = [each.said("value") for each in values.children]
    return texts[0], texts[-1]


def _combined(ends: dict[str, tuple[str, str]]) -> Iterator[Values]:
    for even, odd in ((0, 0), (1, 1), (0, 1), (1, 0)):
        yield {
            name: values[odd if index % 2 else even]
            for index, (name, values) in enumerate(ends.items())
        }
