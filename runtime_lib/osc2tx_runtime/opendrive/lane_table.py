"""Lookup of roads and lanes by id, with error messages."""

from __future__ import annotations

from collections.abc import Mapping

from .errors import MapError
from .model import Lane, LaneKey, Road


class LaneTable:
    """The roads and lanes of a map by id.

    Args:
        roads: Roads by id.
        file: Of the map, for messages.
    """

    __slots__ = ("_file", "_recent", "_roads")

    def __init__(self, roads: Mapping[str, Road], file: str) -> None:
        self._roads = roads
        self._file = file
        self._recent: dict[tuple[str, int], Lane] = {}  # sections of the last look-ups

    def road(self, road: str) -> Road:
        """A road.

        Raises:
            MapError: It does not exist.
        """
        found = self._roads.get(road)
        if found is None:
            raise MapError(self._file, f"there is no road `{road}`; road ids differ between maps")
        return found

    def at(self, road: str, lane: int, s: float) -> tuple[Lane, float]:
        """Lane at s, and s limited to the road.

        Raises:
            MapError: It does not exist.
        """
        recent = self._recent.get((road, lane))
        if recent is not None and recent.section.begin <= s < recent.section.end:
            return recent, s
        found = self._roads.get(road) or self.road(road)
        s = 0.0 if s < 0.0 else min(s, found.length)
        section = found.section_at(s)
        result = section.lanes.get(lane)
        if result is None:
            known = ", ".join(str(lane_id) for lane_id in section.lanes)
            raise MapError(
                self._file, f"road `{road}` has no lane {lane} at s = {s:.3f} m; it has {known}"
            )
        self._recent[road, lane] = result
        return result, s

    def keyed(self, key: LaneKey) -> Lane:
        """Lane of a section.

        Raises:
            MapError: It does not exist.
        """
        sections = self.road(key.road).sections
        lane = sections[key.section].lanes.get(key.lane) if key.section < len(sections) else None
        if lane is None:
            raise MapError(
                self._file,
                f"road `{key.road}` has no lane {key.lane} in section {key.section}",
            )
        if not lane.section.ready:
            lane.section.prepare()
        return lane
