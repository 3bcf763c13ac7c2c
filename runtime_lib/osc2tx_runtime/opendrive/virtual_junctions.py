"""Roads that branch off within another road (OpenDRIVE 12.7): that road is cut into sections there.

The lanes of a section lead to lanes of sections, so a branch within a section would have no
predecessor. A cut has no other effect: widths and all other profiles are given over s of the road.
"""

from __future__ import annotations

from collections.abc import Iterable
from copy import copy
from itertools import pairwise

from osc2tx_shared.classes import replace

from .model import Lane, LaneSection, Road

_SHORT = 0.01
"""Distance (m) from the end of a section within which a branch begins at the end."""


def cut_where_roads_branch_off(roads: dict[str, Road]) -> None:
    """Replace roads from which others branch off between their ends."""
    places: dict[str, set[float]] = {}
    for road in roads.values():
        for link in (road.predecessor, road.successor):
            if link is not None and link.s is not None and link.id in roads:
                places.setdefault(link.id, set()).add(link.s)
    for name, found in places.items():
        road = roads[name]
        pieces = [piece for section in road.sections for piece in _pieces(section, found)]
        sections = [
            LaneSection(i, begin, end, lanes) for i, (begin, end, lanes) in enumerate(pieces)
        ]
        roads[name] = replace(road, sections=tuple(sections))


def _pieces(section: LaneSection, places: Iterable[float]) -> list[tuple[float, float, list[Lane]]]:
    begin, end = section.begin, section.end
    inner = sorted(s for s in places if begin + _SHORT < s < end - _SHORT)
    found = []
    for low, high in pairwise([begin, *inner, end]):
        lanes = [copy(lane) for lane in section.lanes.values()]
        for lane in lanes:
            lane.previous_ids = lane.previous_ids if low == begin else (lane.id,)
            lane.next_ids = lane.next_ids if high == end else (lane.id,)
        found.append((low, high, lanes))
    return found
