"""Whether two documents have the same meaning for given values of parameters.

`Performance` states limits of a vehicle, so it need not follow the parameters: constants cover all
their values. A reader sees one number, and no formula has to be computed before the vehicle exists.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from math import isclose
from typing import NamedTuple

from osc2tx.xosc import elements as xml
from osc2tx.xosc.arithmetic import Range, Shown, evaluated, range_of
from osc2tx.xosc.element import Element, text_of

WITHOUT_EFFECT = frozenset({"FileHeader", "ParameterDeclarations"})
"""Parts of a document without effect on a run."""


def story_of(document: Element) -> Element:
    """Return a document with the parts that have an effect on a run."""
    return document.with_children(*(p for p in document.children if p.tag not in WITHOUT_EFFECT))


class Place(NamedTuple):
    """An attribute of a document.

    Attributes:
        path: Indices of children, from the root down, as `story_of` has them.
        attribute: Its name.
    """

    path: tuple[int, ...]
    attribute: str


class _OtherShape(Exception):
    """Two documents have different elements, or differ in a part that cannot be a parameter."""


def differences(document: Element, other: Element, shown: Shown) -> frozenset[Place] | None:
    """Return the attributes in which a document differs from another one; `None`: in its elements.

    Args:
        document: A document with parameters.
        other: One without.
        shown: Values of the parameters.
    """
    try:
        found: list[Place] = []
        _compare(story_of(document), story_of(other), shown, (), found)
        return frozenset(found)
    except _OtherShape:
        return None


def undefined(document: Element, name: str, ranges: Mapping[str, Range]) -> frozenset[Place]:
    """Return the attributes with a parameter that divide by what may be 0 within the ranges."""
    mention = re.compile(rf"\${re.escape(name)}\b")
    return frozenset(_undefined(story_of(document), mention, ranges, ()))


def _undefined(
    node: Element, mention: re.Pattern[str], ranges: Mapping[str, Range], path: tuple[int, ...]
) -> Iterator[Place]:
    for key, text in node.attributes:
        if "/" in text and mention.search(text) and range_of(text, ranges) is None:
            yield Place(path, key)
    for index, child in enumerate(node.children):
        yield from _undefined(child, mention, ranges, (*path, index))


def _compare(
    a: Element, b: Element, shown: Shown, path: tuple[int, ...], found: list[Place]
) -> None:
    """Add the attributes in which two elements, and those below them, differ."""
    if type(a) is not type(b) or len(a.children) != len(b.children) or a.text != b.text:
        raise _OtherShape
    if a.attributes != b.attributes:
        found.extend(_unlike_attributes(a, b, shown, path))
    for index, (x, y) in enumerate(zip(a.children, b.children, strict=True)):
        _compare(x, y, shown, (*path, index), found)


def _unlike_attributes(
    a: Element, b: Element, shown: Shown, path: tuple[int, ...]
) -> Iterator[Place]:
    left, right = dict(a.attributes), dict(b.attributes)
    if left.keys() != right.keys():
        raise _OtherShape
    for key in left:
        if not _is_same(left[key], right[key], shown):
            if is_name(key):
                raise _OtherShape
            yield Place(path, key)


def is_name(attribute: str) -> bool:
    """Whether an attribute names an element, so that tools need it when they load a document."""
    return attribute == "name" or attribute.endswith("PartReference")


def _is_same(a: str, b: str, shown: Shown) -> bool:
    if a == b:
        return True
    value, expected = evaluated(a, shown), evaluated(b, shown)
    if value is None or expected is None:
        return False
    return isclose(value, expected, rel_tol=1e-6, abs_tol=2e-6)


def with_texts(document: Element, texts: Mapping[Place, str]) -> Element:
    """Return a document with other texts of attributes of its story."""
    beside = (part for part in document.children if part.tag in WITHOUT_EFFECT)
    story = _with_texts(story_of(document), texts, ())
    return document.with_children(*beside, *story.children)


def _with_texts(node: Element, texts: Mapping[Place, str], path: tuple[int, ...]) -> Element:
    attributes = {key: texts.get(Place(path, key), text) for key, text in node.attributes}
    children = (
        _with_texts(child, texts, (*path, index)) for index, child in enumerate(node.children)
    )
    return node.with_attributes(attributes).with_children(*children)


def with_covering_limits(document: Element, ranges: Mapping[str, Range]) -> Element:
    """Return a document in which limits of vehicles are the most that their formulas can be.

    A formula that may have no value within the ranges has that of the middle; the requests for
    other values are found by comparing documents for them.
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
