"""Passages through junctions, from lane to lane."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from osc2tx_runtime.domain.routes.map_segments import MapSegment
from osc2tx_runtime.opendrive.angles import wrap

if TYPE_CHECKING:
    from osc2tx_runtime.domain.routes.lane_graph import LaneGraph

__all__ = ["Passage", "arms_of", "passages_of"]


class Passage(NamedTuple):
    """A way through a junction, from lane to lane.

    Attributes:
        junction: The junction.
        in_lane: Lane that enters it.
        via: Lane in it.
        out_lane: Lane that leaves it.
        turn: Change of heading (rad), to the left positive, in (-pi, pi].
    """

    junction: MapSegment
    in_lane: MapSegment
    via: MapSegment
    out_lane: MapSegment
    turn: float

    @property
    def route(self) -> MapSegment:
        """In-road, junction and out-road as one route."""
        roads = (self.in_lane, self.via, self.out_lane)
        parts = tuple(MapSegment("road", r.road, forwards=r.forwards) for r in roads)
        return MapSegment("compound_route", parts[0].road, parts=parts)


def passages_of(graph: LaneGraph) -> tuple[Passage, ...]:
    """All ways through the junctions of a map, by the lanes that enter them."""
    found = []
    for lane in graph.lanes:
        for via in graph.after(lane):
            junction = graph.map.roads[via.road].junction
            if junction is None:
                continue
            inside = MapSegment("junction", junction)
            for out in graph.after(via):
                if graph.map.roads[out.road].junction is None:
                    turn = graph.heading(out, at_end=False) - graph.heading(lane, at_end=True)
                    turn = wrap(turn)
                    found.append(Passage(inside, lane, via, out, turn))
    return tuple(found)


def arms_of(
    graph: LaneGraph, passages: Sequence[Passage], junction: MapSegment
) -> Iterator[tuple[float, str]]:
    """Roads that meet in a junction: direction in which they leave it (rad), and their id."""
    seen: dict[str, float] = {}
    for passage in passages:
        if passage.junction != junction:
            continue
        entry = graph.heading(passage.in_lane, at_end=True) + math.pi
        seen.setdefault(passage.in_lane.road, entry)
        seen.setdefault(passage.out_lane.road, graph.heading(passage.out_lane, at_end=False))
    for road, heading in seen.items():
        yield heading % math.tau, road
