"""OpenDRIVE text to lane sections and lanes."""

from __future__ import annotations

from copy import copy
from itertools import pairwise
from sys import intern

from lxml import etree

from .model import Lane, LaneSection
from .polynomials import Piecewise, Row
from .xml_reader import Attributes, source_line

NARROWEST = -0.05
"""Negative width (m) that counts as rounding in the map."""

_SIDES = ("left", "right")
_Span = tuple[float, float]


def read_sections(
    lanes: etree._Element, length: float, attributes: Attributes
) -> tuple[LaneSection, ...]:
    """All lane sections of a road, in order of s.

    A section of one side (`singleSide`) does not change the lanes of the other side, which come
    from an earlier element.

    Args:
        lanes: The element `lanes` of a road.
        length: Length of the road (m).
        attributes: Of the file.

    Raises:
        MapError: There is no section, or a lane cannot be read.
    """
    elements = [(attributes.number(e, "s"), e) for e in lanes.iterchildren("laneSection")]
    if not elements:
        raise attributes.error(lanes, "has no `laneSection`; a road needs at least one")
    elements.sort(key=lambda item: item[0])
    begins = [min(max(begin, 0.0), length) for begin, _ in elements]
    begins[0] = 0.0
    ends = [*begins[1:], length]
    found: list[list[Lane]] = [[] for _ in elements]
    for side in _SIDES:
        firsts = [i for i, (_, e) in enumerate(elements) if i == 0 or _says(e, side)]
        for first, after in pairwise([*firsts, len(elements)]):
            element = elements[first][1].find(side)
            if element is not None:
                span = begins[first], ends[after - 1]
                lanes_here = [
                    _lane(each, span, attributes) for each in element.iterchildren("lane")
                ]
                for i in range(first, after):
                    found[i].extend(_part(e, i == first, i == after - 1) for e in lanes_here)
    for (_, element), section in zip(elements, found, strict=True):
        # Edges are stacked from the centre outwards, so a repeated id would be an overlap.
        if len({lane.id for lane in section}) != len(section):
            raise attributes.error(element, "a lane id is used twice; make lane ids unique")
    return tuple(
        LaneSection(i, begins[i], ends[i], [lane for lane in found[i] if lane.id != 0])
        for i in range(len(elements))
    )


def read_reversed(lanes: etree._Element, attributes: Attributes) -> frozenset[int]:
    """Ids of the lanes of a road with traffic opposite to that of their side.

    Raises:
        MapError: The id of a lane is not a number.
    """
    elements: dict[str, list[etree._Element]] = {}
    for lane in lanes.iter("lane"):
        elements.setdefault(lane.get("id", ""), []).append(lane)
    found = set()
    for same in elements.values():
        kinds = {each.get("direction") == "reversed" for each in same}
        if kinds == {True}:
            found.add(attributes.integer(same[0], "id"))
        elif True in kinds:
            attributes.remark(same[0], "is reversed in some sections only: it is not reversed")
    return frozenset(found)


def _says(section: etree._Element, side: str) -> bool:
    """True if a section defines the lanes of a side."""
    one_side = section.get("singleSide") in ("true", "1")
    return not one_side or section.find(side) is not None


def _part(lane: Lane, is_first: bool, is_last: bool) -> Lane:
    """The part of a lane in one of the sections of its element."""
    if is_first and is_last:
        return lane
    part = copy(lane)
    part.previous_ids = lane.previous_ids if is_first else (lane.id,)
    part.next_ids = lane.next_ids if is_last else (lane.id,)
    return part


def _lane(element: etree._Element, span: _Span, attributes: Attributes) -> Lane:
    begin, end = span
    lane = Lane(
        attributes.integer(element, "id"),
        intern(element.get("type", "none")),
        source_line(element),
    )
    widths: list[tuple[float, Row]] = []
    borders: list[tuple[float, Row]] = []
    heights: list[tuple[float, float, float]] = []
    for child in element:
        tag = child.tag
        if tag == "width" or tag == "border":
            records = widths if tag == "width" else borders
            start = begin + attributes.number(child, "sOffset")
            records.append((start, attributes.cubic(child)))
        elif tag == "link":
            lane.previous_ids = _linked_ids(child, "predecessor", attributes)
            lane.next_ids = _linked_ids(child, "successor", attributes)
        elif tag == "height":
            inner, outer = (attributes.number(child, edge) for edge in ("inner", "outer"))
            heights.append((begin + attributes.number(child, "sOffset"), inner, outer))
    lane.width = attributes.piecewise(widths)
    if lane.width is not None and (narrowest := lane.width.extremes(begin, end)[0]) < NARROWEST:
        raise attributes.error(element, f"is {narrowest:g} m wide at one place; give a width")
    lane.border = attributes.piecewise(borders)
    if lane.width is None and lane.border is not None:
        _check_side(element, lane, span, attributes)
    lane.heights = _heights(heights)
    lane.level = element.get("level") in ("true", "1")
    if element.get("direction") == "both":
        attributes.remark(
            element, "has direction `both`: traffic runs as in the other lanes of its side"
        )
    return lane


def _check_side(element: etree._Element, lane: Lane, span: _Span, attributes: Attributes) -> None:
    """Reports a border on the other side of the road, which would fold the lane."""
    assert lane.border is not None
    low, high = lane.border.extremes(*span)
    beyond = high if lane.id < 0 else -low
    if beyond > -NARROWEST:
        side, other = ("right", "left") if lane.id < 0 else ("left", "right")
        raise attributes.error(
            element,
            f"is on the {side} of the road, its border {beyond:g} m to the {other} of the centre;"
            " t grows to the left",
        )


def _heights(records: list[tuple[float, float, float]]) -> tuple[Piecewise, Piecewise] | None:
    """Heights of both edges: linear from one record to the next."""
    if not any(inner or outer for _, inner, outer in records):
        return None
    records = sorted({record[0]: record for record in records}.values())
    starts = [start for start, _, _ in records]
    edges = []
    for edge in (1, 2):
        rows: list[Row] = []
        for here, onward in pairwise([*records, records[-1]]):
            span = onward[0] - here[0]
            slope = (onward[edge] - here[edge]) / span if span else 0.0
            rows.append((here[edge], slope, 0.0, 0.0))
        edges.append(Piecewise(starts, rows))
    return edges[0], edges[1]


def _linked_ids(link: etree._Element, name: str, attributes: Attributes) -> tuple[int, ...]:
    return tuple(attributes.integer(e, "id") for e in link.iterchildren(name))
