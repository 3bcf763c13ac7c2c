"""The lane graph: successors and predecessors in direction of travel."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from .model import Junction, JunctionConnection, Lane, LaneSection, Link, Road

_Edge = tuple[Lane, Lane]


def lane_order(lane: Lane) -> tuple[tuple[int, int, str], int, int]:
    """Sort key of lanes: numeric road id, section, lane id."""
    return lane.road.order, lane.section.index, lane.id


def connect_lanes(roads: Mapping[str, Road], junctions: Mapping[str, Junction]) -> None:
    """Fills `successors` and `predecessors` of all lanes.

    Links to missing roads or lanes, or against the direction of traffic, are ignored: real maps
    have some, and a lane then ends there.
    """
    following: dict[Lane, dict[Lane, None]] = {}
    leading: dict[Lane, dict[Lane, None]] = {}
    for source, target in _edges(roads, junctions):
        following.setdefault(source, {})[target] = None
        leading.setdefault(target, {})[source] = None
    for source, targets in following.items():
        source.successors = tuple(sorted(targets, key=lane_order))
    for target, sources in leading.items():
        target.predecessors = tuple(sorted(sources, key=lane_order))


def linked_ends(lane: Lane, at_end: bool) -> Iterator[tuple[Road, float]]:
    """Roads that touch one end of the road of a lane, with the s of the end that touches it.

    Roads that continue `lane` itself come first.
    """
    section = lane.road.sections[-1 if at_end else 0]
    own = section.lanes.get(lane.id)
    lanes = [*([] if own is None else [own]), *section.lanes.values()]
    seen: dict[tuple[str, float], None] = {}
    for beside in lanes:
        ahead = (beside.direction > 0) == at_end
        for other in beside.successors if ahead else beside.predecessors:
            at_start = (other.direction > 0) == ahead
            s = other.section.begin if at_start else other.section.end
            if (other.road.id, s) not in seen:
                seen[other.road.id, s] = None
                yield other.road, s


def _edges(roads: Mapping[str, Road], junctions: Mapping[str, Junction]) -> Iterator[_Edge]:
    for road in roads.values():
        for section in road.sections:
            for lane in section.lanes.values():
                yield from _link_edges(lane, roads)
    for junction in junctions.values():
        for connection in junction.connections:
            yield from _connection_edges(connection, junction, roads)


def _link_edges(lane: Lane, roads: Mapping[str, Road]) -> Iterator[_Edge]:
    """Edges that the lane states for its own exit end."""
    road, index = lane.road, lane.section.index
    ids = lane.next_ids if lane.direction > 0 else lane.previous_ids
    inner = index + lane.direction
    if 0 <= inner < len(road.sections):
        targets = road.sections[inner]
        entry = "start" if lane.direction > 0 else "end"
    else:
        link = road.successor if lane.direction > 0 else road.predecessor
        if link is None or link.kind != "road" or link.id not in roads:
            return
        other = roads[link.id]
        targets, entry = _touched(other, road, link, at_end=lane.direction > 0)
    for lane_id in ids:
        target = targets.lanes.get(lane_id)
        if target is not None and _enters(target, entry):
            yield lane, target


def _connection_edges(
    connection: JunctionConnection, junction: Junction, roads: Mapping[str, Road]
) -> Iterator[_Edge]:
    """Edges of a junction connection, in whichever direction the lanes run."""
    incoming, connecting = roads.get(connection.incoming), roads.get(connection.connecting)
    if incoming is None or connecting is None:
        return
    at_end = connection.contact == "end"
    link = connecting.successor if at_end else connecting.predecessor
    if link is not None and link.s is not None and link.id == incoming.id:
        sources, leave = _touched(incoming, connecting, link, at_end=at_end)
    else:
        leave = _junction_end(incoming, junction.id, connecting, connection.contact)
        sources = _end_section(incoming, leave)
    targets = _end_section(connecting, connection.contact)
    for source_id, target_id in connection.links:
        source, target = sources.lanes.get(source_id), targets.lanes.get(target_id)
        if source is None or target is None:
            continue
        if _enters(target, connection.contact) and not _enters(source, leave):
            yield source, target
        elif _enters(source, leave) and not _enters(target, connection.contact):
            yield target, source


def _enters(lane: Lane, contact: str) -> bool:
    """True if traffic on the lane enters at that end of its road."""
    return (lane.direction > 0) == (contact != "end")


def _end_section(road: Road, contact: str) -> LaneSection:
    return road.sections[-1 if contact == "end" else 0]


def _touched(other: Road, road: Road, link: Link, *, at_end: bool) -> tuple[LaneSection, str]:
    """The section of a linked road at one end of a road, and its touching end."""
    if link.s is None:
        contact = link.contact or _contact(other, road)
        return _end_section(other, contact), contact
    onward = link.with_s == at_end  # else it leads here
    ends = [section.begin if onward else section.end for section in other.sections]
    gaps = [abs(end - link.s) for end in ends]
    return other.sections[gaps.index(min(gaps))], "start" if onward else "end"


def _junction_end(road: Road, junction: str, connecting: Road, contact: str) -> str:
    """The end of a road that touches a junction; by geometry if links do not determine it."""
    at_end = _names(road.successor, junction)
    at_start = _names(road.predecessor, junction)
    if at_end != at_start:
        return "end" if at_end else "start"
    x, y = _end_point(connecting, contact)
    distances = []
    for end in ("end", "start"):
        ex, ey = _end_point(road, end)
        distances.append((ex - x) ** 2 + (ey - y) ** 2)
    return "end" if distances[0] <= distances[1] else "start"


def _names(link: Link | None, junction: str) -> bool:
    return link is not None and link.kind == "junction" and link.id == junction


def _end_point(road: Road, contact: str) -> tuple[float, float]:
    x, y, _, _ = road.reference.at(road.length if contact == "end" else 0.0)
    return x, y


def _contact(other: Road, road: Road) -> str:
    """Determines a missing contact point: the end whose link refers to this road."""
    link = other.predecessor
    return "start" if link is not None and link.id == road.id else "end"
