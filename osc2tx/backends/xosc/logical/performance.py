"""Performance of vehicles in a document with parameters: constants that cover all their values.

`Performance` states what a vehicle can do at most, so it need not follow the parameters: a reader
sees one number, and no formula has to be computed before the vehicle exists.
"""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.backends.xosc.logical.comparison import Place, story_of, with_texts
from osc2tx.xosc import elements as xml
from osc2tx.xosc.arithmetic import Range, evaluated, range_of
from osc2tx.xosc.element import Element, text_of


def with_covering_limits(document: Element, ranges: Mapping[str, Range]) -> Element:
    """Return a document in which limits of vehicles are the most that their formulas can be.

    A formula that may have no value within the ranges has that of the middle; what is asked for
    other values is found by comparing documents for them.
    """
    middles = {name: 0.5 * (found.low + found.high) for name, found in ranges.items()}
    if isinstance(document, xml.Performance):
        texts = {}
        for key, text in document.attributes:
            found = range_of(text, ranges) if text.startswith("$") else None
            most = evaluated(text, middles) if found is None else found.high
            texts[key] = text if most is None or not text.startswith("$") else text_of(most)
        return document.with_attributes(texts)
    return document.with_children(*(with_covering_limits(e, ranges) for e in document.children))


class Limits:
    """The limits of vehicles that other values of the parameters need.

    Args:
        document: The document with parameters.
    """

    def __init__(self, document: Element) -> None:
        self._story = story_of(document)
        self._most: dict[Place, float] = {}

    def taken_from(self, places: frozenset[Place], other: Element) -> frozenset[Place]:
        """Return the attributes that are no limits; limits are raised to those of a document."""
        story, limits = story_of(other), set()
        for place in places:
            node = _at(self._story, place)
            if isinstance(node, xml.Performance):
                limits.add(place)
                own, needed = (
                    float(each.said(place.attribute)) for each in (node, _at(story, place))
                )
                self._most[place] = max(self._most.get(place, own), needed)
        return places - limits

    def raised(self, document: Element) -> Element:
        """Return the document with the limits."""
        return with_texts(document, {place: text_of(most) for place, most in self._most.items()})


def _at(node: Element, place: Place) -> Element:
    for index in place.path:
        node = node.children[index]
    return node
