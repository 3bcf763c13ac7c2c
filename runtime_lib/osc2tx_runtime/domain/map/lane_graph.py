"""Roads, lane sections and lanes of a map as segments, with successors and neighbours."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from osc2tx_runtime.domain.map.lane_types import LaneKind, kind_of_lane
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.opendrive import DRIVING, Lane, LaneKey, LanePosition, RoadMap
from osc2tx_runtime.opendrive.lane_line import lane_line

_INSIDE = 1e-6  # m from the end of a lane section, to be in it


class LaneGraph:
    """Roads, lane sections and lanes of a map, with their successors.

    Only lanes for vehicles count; `other_lanes` has the others.

    Args:
        road_map: The map.
    """

    def __init__(self, road_map: RoadMap) -> None:
        self.map = road_map

    # --- segments ----------------------------------------------------------------------------

    @cached_property
    def roads(self) -> tuple[MapSegment, ...]:
        """Roads outside of junctions."""
        driven = dict.fromkeys(section.road for section in self.sections)
        return tuple(MapSegment("road", road) for road in driven)

    @cached_property
    def sections(self) -> tuple[MapSegment, ...]:
        """Lane sections outside of junctions, those that run with s first."""
        return tuple(
            MapSegment("lane_section", road.id, section.index, forwards=forwards)
            for road in self.map.roads.values()
            if road.junction is None
            for section in road.sections
            for forwards in (True, False)
            if self._ids(road.id, section.index, forwards)
        )

    @cached_property
    def paths(self) -> tuple[MapSegment, ...]:
        """These sections as far as they have default start positions, the longest first."""
        starts = {
            (p.road, self.map.roads[p.road].section_at(p.s).index, direction > 0)
            for p in self.map.spawn_points()
            for direction in (self.map.travel_direction(p.road, p.lane),)
        }
        usable = (s for s in self.sections if (s.road, s.section, s.forwards) in starts)
        return tuple(sorted(usable, key=self.length, reverse=True))

    def sections_of_road(self, road: str, *, forwards: bool) -> tuple[MapSegment, ...]:
        """Lane sections of one direction of a road that have drivable lanes, in order of s."""
        return tuple(
            MapSegment("lane_section", road, section.index, forwards=forwards)
            for section in self.map.roads[road].sections
            if self._ids(road, section.index, forwards)
        )

    def length(self, section: MapSegment) -> float:
        """Length of a lane section (m)."""
        found = self.map.roads[section.road].sections[section.section or 0]
        return found.end - found.begin

    @cached_property
    def lanes(self) -> tuple[MapSegment, ...]:
        """Lanes of these sections."""
        return tuple(lane for section in self.sections for lane in self.lanes_of(section))

    @cached_property
    def other_lanes(self) -> tuple[MapSegment, ...]:
        """Lanes outside junctions that are not for vehicles, by road and from the right."""
        return tuple(
            self.segment_of(LaneKey(road.id, section.index, lane.id))
            for road in self.map.roads.values()
            if road.junction is None
            for section in road.sections
            for lane in section.lanes.values()
            if lane.type not in DRIVING
        )

    @cached_property
    def compound_lanes(self) -> tuple[MapSegment, ...]:
        """Lanes over whole roads."""
        found = []
        for lane in self.lanes:
            if any(before.road == lane.road for before in self.before(lane)):
                continue
            chain = [lane]
            while onward := [n for n in self.after(chain[-1]) if n.road == lane.road]:
                chain.append(onward[0])
            parts = tuple(chain)
            found.append(
                MapSegment("compound_lane", lane.road, None, lane.lane, lane.forwards, parts)
            )
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

    def lanes_of(self, segment: MapSegment) -> tuple[MapSegment, ...]:
        """Lanes of a segment; of its first section if it has several."""
        match segment.kind:
            case "lane":
                return (segment,)
            case "compound_lane" | "compound_route":
                return self.lanes_of(segment.parts[0])
            case "junction":
                return ()
        index = 0 if segment.section is None else segment.section
        directions = (True, False) if segment.kind == "road" else (segment.forwards,)
        return tuple(
            MapSegment("lane", segment.road, index, lane, forwards)
            for forwards in directions
            for lane in self._ids(segment.road, index, forwards)
        )

    def chains_of(self, road: MapSegment) -> tuple[tuple[MapSegment, ...], ...]:
        """Drivable lanes over a whole road, each with its successors on the road.

        Those in the direction of the road come first.
        """
        chains = [lane.parts for lane in self.compound_lanes if lane.road == road.road]
        return tuple(sorted(chains, key=lambda chain: chain[0].forwards != road.forwards))

    def sections_of(self, segment: MapSegment) -> tuple[MapSegment, ...]:
        """Whole cross-sections, or sections of one direction, that a segment runs through."""
        if segment.parts:
            return tuple(each for part in segment.parts for each in self.sections_of(part))
        if segment.kind != "road":
            return (segment,)
        return tuple(
            MapSegment("road", segment.road, section.index)
            for section in self.map.roads[segment.road].sections
        )

    def begin(self, segment: MapSegment) -> LanePosition:
        """Start of a segment; on the outermost lane with a successor if it has several."""
        return next(self.beginnings(segment))

    def beginnings(self, segment: MapSegment) -> Iterator[LanePosition]:
        """Starts of a segment: on each of its lanes with a successor, from the right."""
        lanes = self._directed(segment.parts[0]) if segment.parts else self.lanes_of(segment)
        onward = [each.road for each in segment.parts[1:2]]
        for first in [each for each in lanes if self._leads_to(each, onward)] or lanes:
            assert first.lane is not None and first.section is not None
            section = self.map.roads[first.road].sections[first.section]
            s = section.begin if first.forwards else max(section.end - _INSIDE, section.begin)
            yield LanePosition(first.road, first.lane, s)

    def _directed(self, part: MapSegment) -> tuple[MapSegment, ...]:
        """Lanes at the start of a part of a route, in its direction."""
        index = part.section
        if index is None:
            index = 0 if part.forwards else len(self.map.roads[part.road].sections) - 1
        section = MapSegment("lane_section", part.road, index, forwards=part.forwards)
        return (part,) if part.kind == "lane" else self.lanes_of(section)

    def _leads_to(self, lane: MapSegment, roads: list[str]) -> bool:
        """Whether a lane leads to one of the roads without a lane change."""
        reached, seen = [lane], {lane}
        for each in reached:
            for after in self.after(each):
                if after.road in roads:
                    return True
                if after.road == lane.road and after not in seen:
                    seen.add(after)
                    reached.append(after)
        return not roads

    def end(self, segment: MapSegment) -> LanePosition:
        """End of a segment; on its outermost lane if it has several."""
        if segment.parts:
            return self.end(segment.parts[-1])
        index = segment.section
        if index is None:
            index = len(self.map.roads[segment.road].sections) - 1 if segment.forwards else 0
            segment = MapSegment("lane_section", segment.road, index, forwards=segment.forwards)
        lane = self.lanes_of(segment)[0].lane
        section = self.map.roads[segment.road].sections[index]
        assert lane is not None
        s = max(section.end - _INSIDE, section.begin) if segment.forwards else section.begin
        return LanePosition(segment.road, lane, s)

    def seen_from(self, segment: MapSegment, place: LanePosition | None) -> MapSegment:
        """A road in the direction of an actor on it; other segments are unchanged."""
        if segment.kind != "road" or place is None or place.road != segment.road:
            return segment
        forwards = self.map.travel_direction(place.road, place.lane) > 0
        return MapSegment("road", segment.road, forwards=forwards)

    # --- neighbours ---------------------------------------------------------------------------

    def key(self, lane: MapSegment) -> LaneKey:
        """The lane in the map."""
        assert lane.lane is not None and lane.section is not None
        return LaneKey(lane.road, lane.section, lane.lane)

    def along(self, lane: MapSegment, s: float) -> float:
        """Metres along the centre line of a lane, in its direction, at a road coordinate (m)."""
        line = lane_line(self.lane(lane))
        along = line.length_at(s)
        return along if lane.forwards else line.length - along

    def s_at(self, lane: MapSegment, along: float) -> float | None:
        """Road coordinate (m) at a distance along a lane; None beyond its end."""
        line = lane_line(self.lane(lane))
        if not 0.0 <= along <= line.length:
            return None
        return line.s_at(along if lane.forwards else line.length - along)

    def lane(self, lane: MapSegment) -> Lane:
        """The lane of the map, with its geometry."""
        section = self.map.roads[lane.road].sections[lane.section or 0]
        if not section.ready:
            section.prepare()
        assert lane.lane is not None
        return section.lanes[lane.lane]

    def width_of(self, lane: MapSegment) -> float:
        """Width (m) of a lane at its start."""
        found = self.lane(lane)
        section = found.section
        return found.width_at(section.begin if lane.forwards else section.end)

    def kind_of(self, lane: MapSegment) -> LaneKind:
        """The type of a lane."""
        return kind_of_lane(self.lane(lane).type)

    def segment_of(self, key: LaneKey) -> MapSegment:
        """The segment that a lane of the map is."""
        forwards = self.map.travel_direction(key.road, key.lane) > 0
        return MapSegment("lane", key.road, key.section, key.lane, forwards)

    def after(self, lane: MapSegment) -> tuple[MapSegment, ...]:
        """Lanes that follow a lane."""
        return tuple(self.segment_of(key) for key in self.map.successors(self.key(lane)))

    def before(self, lane: MapSegment) -> tuple[MapSegment, ...]:
        """Lanes that lead to a lane."""
        return tuple(self.segment_of(key) for key in self.map.predecessors(self.key(lane)))

    def heading(self, lane: MapSegment, *, at_end: bool) -> float:
        """Heading (rad) of a lane at its start or end."""
        assert lane.lane is not None and lane.section is not None
        section = self.map.roads[lane.road].sections[lane.section]
        last = lane.forwards == at_end
        s = max(section.end - _INSIDE, section.begin) if last else section.begin
        return self.map.pose(LanePosition(lane.road, lane.lane, s)).h
