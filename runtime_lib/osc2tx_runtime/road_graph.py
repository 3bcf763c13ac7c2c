"""What a map has to offer for declared roads and lanes, in a fixed order."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

from osc2tx_runtime.opendrive import DRIVING, LaneKey, LanePosition, RoadMap
from osc2tx_runtime.road_parts import PartKind, Stretch

__all__ = ["Passage", "RoadGraph"]

_INSIDE = 1e-6  # m from the end of a lane section, to be in it


class Passage(NamedTuple):
    """A way through a junction, from lane to lane.

    Attributes:
        junction: The junction.
        in_lane: Lane that enters it.
        via: Lane in it.
        out_lane: Lane that leaves it.
        turn: Change of heading (rad), to the left positive, in (-pi, pi].
    """

    junction: Stretch
    in_lane: Stretch
    via: Stretch
    out_lane: Stretch
    turn: float


class RoadGraph:
    """Stretches of a map and how they hang together; only lanes that vehicles drive on count.

    Args:
        road_map: The map.
    """

    def __init__(self, road_map: RoadMap) -> None:
        self.map = road_map

    # --- stretches ----------------------------------------------------------------------------

    def all(self, kind: PartKind) -> tuple[Stretch, ...]:
        """All stretches of a kind: by numbers of road and section, lanes from the right."""
        match kind:
            case "road":
                return self.roads
            case "lane_section":
                return self.sections
            case "lane":
                return self.lanes
            case "compound_lane":
                return self.compound_lanes
            case "path":
                return self.paths
            case "junction":
                return tuple(Stretch("junction", each) for each in self.map.junctions)
            case _:
                return tuple(dict.fromkeys(self._result(passage) for passage in self.passages))

    @cached_property
    def roads(self) -> tuple[Stretch, ...]:
        """Roads outside of junctions."""
        driven = dict.fromkeys(section.road for section in self.sections)
        return tuple(Stretch("road", road) for road in driven)

    @cached_property
    def sections(self) -> tuple[Stretch, ...]:
        """Lane sections outside of junctions, those that run with s first."""
        return tuple(
            Stretch("lane_section", road.id, section.index, forwards=forwards)
            for road in self.map.roads.values()
            if road.junction is None
            for section in road.sections
            for forwards in (True, False)
            if self._ids(road.id, section.index, forwards)
        )

    @cached_property
    def paths(self) -> tuple[Stretch, ...]:
        """Those of these sections that have default start places, the longest first."""
        starts = {
            (p.road, self.map.roads[p.road].section_at(p.s).index, direction > 0)
            for p in self.map.spawn_points()
            for direction in (self.map.travel_direction(p.road, p.lane),)
        }
        usable = (s for s in self.sections if (s.road, s.section, s.forwards) in starts)
        return tuple(sorted(usable, key=self.length, reverse=True))

    def length(self, section: Stretch) -> float:
        """Length of a lane section (m)."""
        found = self.map.roads[section.road].sections[section.section or 0]
        return found.end - found.begin

    @cached_property
    def lanes(self) -> tuple[Stretch, ...]:
        """Lanes of these sections."""
        return tuple(lane for section in self.sections for lane in self.lanes_of(section))

    @cached_property
    def compound_lanes(self) -> tuple[Stretch, ...]:
        """Lanes over whole roads."""
        found = []
        for lane in self.lanes:
            if any(before.road == lane.road for before in self.before(lane)):
                continue
            chain = [lane]
            while onward := [n for n in self.after(chain[-1]) if n.road == lane.road]:
                chain.append(onward[0])
            parts = tuple(chain)
            found.append(Stretch("compound_lane", lane.road, None, lane.lane, lane.forwards, parts))
        return tuple(found)

    def _ids(self, road: str, section: int, forwards: bool) -> tuple[int, ...]:
        """Drivable lanes of a direction, from the right in direction of travel."""
        found = self.map.roads[road].sections[section]
        if not found.ready:
            found.prepare()
        direction = 1 if forwards else -1
        ids = sorted(
            lane.id
            for lane in found.lanes.values()
            if lane.type in DRIVING and lane.direction == direction
        )
        return tuple(ids if forwards else reversed(ids))

    def lanes_of(self, stretch: Stretch) -> tuple[Stretch, ...]:
        """Lanes of a stretch: of its first section, where it has several."""
        match stretch.kind:
            case "lane":
                return (stretch,)
            case "compound_lane" | "compound_route":
                return self.lanes_of(stretch.parts[0])
            case "junction":
                return ()
        index = 0 if stretch.section is None else stretch.section
        directions = (True, False) if stretch.kind == "road" else (stretch.forwards,)
        return tuple(
            Stretch("lane", stretch.road, index, lane, forwards)
            for forwards in directions
            for lane in self._ids(stretch.road, index, forwards)
        )

    def sections_of(self, stretch: Stretch) -> tuple[Stretch, ...]:
        """Whole cross-sections, or sections of one direction, that a stretch runs through."""
        if stretch.parts:
            return tuple(each for part in stretch.parts for each in self.sections_of(part))
        if stretch.kind != "road":
            return (stretch,)
        return tuple(
            Stretch("road", stretch.road, section.index)
            for section in self.map.roads[stretch.road].sections
        )

    def begin(self, stretch: Stretch) -> LanePosition:
        """Where a stretch begins; on the outermost lane that leads on where it has several."""
        lanes = self._directed(stretch.parts[0]) if stretch.parts else self.lanes_of(stretch)
        onward = [each.road for each in stretch.parts[1:2]]
        leading = (each for each in lanes if self._leads_to(each, onward))
        first = next(leading, lanes[0])
        assert first.lane is not None and first.section is not None
        section = self.map.roads[first.road].sections[first.section]
        s = section.begin if first.forwards else max(section.end - _INSIDE, section.begin)
        return LanePosition(first.road, first.lane, s)

    def _directed(self, part: Stretch) -> tuple[Stretch, ...]:
        """Lanes at the begin of a part of a route, in its direction."""
        index = part.section
        if index is None:
            index = 0 if part.forwards else len(self.map.roads[part.road].sections) - 1
        section = Stretch("lane_section", part.road, index, forwards=part.forwards)
        return (part,) if part.kind == "lane" else self.lanes_of(section)

    def _leads_to(self, lane: Stretch, roads: list[str]) -> bool:
        """Whether one can go from a lane to one of the roads without changing lanes."""
        reached, seen = [lane], {lane}
        for each in reached:
            for after in self.after(each):
                if after.road in roads:
                    return True
                if after.road == lane.road and after not in seen:
                    seen.add(after)
                    reached.append(after)
        return not roads

    def end(self, stretch: Stretch) -> LanePosition:
        """Where a stretch ends; on its outermost lane where it has several."""
        if stretch.parts:
            return self.end(stretch.parts[-1])
        index = stretch.section
        if index is None:
            index = len(self.map.roads[stretch.road].sections) - 1 if stretch.forwards else 0
            stretch = Stretch("lane_section", stretch.road, index, forwards=stretch.forwards)
        lane = self.lanes_of(stretch)[0].lane
        section = self.map.roads[stretch.road].sections[index]
        assert lane is not None
        s = max(section.end - _INSIDE, section.begin) if stretch.forwards else section.begin
        return LanePosition(stretch.road, lane, s)

    def seen_from(self, stretch: Stretch, place: LanePosition | None) -> Stretch:
        """A road in the direction of who is on it; everything else as it is."""
        if stretch.kind != "road" or place is None or place.road != stretch.road:
            return stretch
        forwards = self.map.travel_direction(place.road, place.lane) > 0
        return Stretch("road", stretch.road, forwards=forwards)

    # --- neighbours ---------------------------------------------------------------------------

    def key(self, lane: Stretch) -> LaneKey:
        """The lane in the map."""
        assert lane.lane is not None and lane.section is not None
        return LaneKey(lane.road, lane.section, lane.lane)

    def _stretch(self, key: LaneKey) -> Stretch:
        forwards = self.map.travel_direction(key.road, key.lane) > 0
        return Stretch("lane", key.road, key.section, key.lane, forwards)

    def after(self, lane: Stretch) -> tuple[Stretch, ...]:
        """Lanes that follow a lane."""
        return tuple(self._stretch(key) for key in self.map.successors(self.key(lane)))

    def before(self, lane: Stretch) -> tuple[Stretch, ...]:
        """Lanes that lead to a lane."""
        return tuple(self._stretch(key) for key in self.map.predecessors(self.key(lane)))

    # --- junctions ----------------------------------------------------------------------------

    @cached_property
    def passages(self) -> tuple[Passage, ...]:
        """Ways through junctions."""
        found = []
        for lane in self.lanes:
            for via in self.after(lane):
                junction = self.map.roads[via.road].junction
                if junction is None:
                    continue
                inside = Stretch("junction", junction)
                for out in self.after(via):
                    if self.map.roads[out.road].junction is None:
                        turn = self._turn(lane, out)
                        found.append(Passage(inside, lane, via, out, turn))
        return tuple(found)

    def _turn(self, entry: Stretch, exit_: Stretch) -> float:
        turn = self._heading(exit_, at_end=False) - self._heading(entry, at_end=True)
        return math.pi - (math.pi - turn) % math.tau

    def _heading(self, lane: Stretch, *, at_end: bool) -> float:
        assert lane.lane is not None and lane.section is not None
        section = self.map.roads[lane.road].sections[lane.section]
        last = lane.forwards == at_end
        s = max(section.end - _INSIDE, section.begin) if last else section.begin
        return self.map.pose(LanePosition(lane.road, lane.lane, s)).h

    def _result(self, passage: Passage) -> Stretch:
        """In-road, junction and out-road as one route."""
        roads = (passage.in_lane, passage.via, passage.out_lane)
        parts = tuple(Stretch("road", r.road, forwards=r.forwards) for r in roads)
        return Stretch("compound_route", parts[0].road, parts=parts)

    def route_of(self, passage: Passage) -> Stretch:
        """The whole way of a passage."""
        return self._result(passage)

    def arms(self, junction: Stretch) -> Iterator[tuple[float, str]]:
        """Roads that meet in a junction: direction in which they leave it (rad), and their id."""
        seen: dict[str, float] = {}
        for passage in self.passages:
            if passage.junction != junction:
                continue
            seen.setdefault(
                passage.in_lane.road, self._heading(passage.in_lane, at_end=True) + math.pi
            )
            seen.setdefault(passage.out_lane.road, self._heading(passage.out_lane, at_end=False))
        for road, heading in seen.items():
            yield heading % math.tau, road
