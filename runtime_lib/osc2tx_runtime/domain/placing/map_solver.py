"""Constraint solver: a segment of the map for each declared road and lane.

The result is the first choice in the order of the map for which all constraints hold, so it only
depends on scenario and map: a backtracking search over the parts in the order of their declaration,
each limited by the modifiers that mention parts already chosen.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from osc2tx_runtime.domain.map.crossings import Crossing
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart, RoadPath
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.modifiers.map.base import MapModifier
from osc2tx_runtime.domain.modifiers.map.constraints import differences, listed_members
from osc2tx_runtime.domain.modifiers.map.crossings import implied
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_shared.classes import dataclass

_MOST_CHOICES = 100_000


@dataclass(frozen=True, slots=True)
class Relation:
    """A modifier of the map, and its position in the scenario."""

    modifier: MapModifier
    source: str | None


class MapSolver:
    """The roads and lanes of one scenario on one map.

    Args:
        road_map: The map.
        parts: The declared parts, in order.
        relations: The relations that must hold.
    """

    def __init__(
        self, road_map: RoadMap, parts: Sequence[RoadPart], relations: Sequence[Relation]
    ) -> None:
        self._map_name = road_map.name
        self._graph = graph_of(road_map)
        relations = [*relations, *_implied(parts)]
        used = {id(part) for relation in relations for part in relation.modifier.parts().values()}
        used.update(id(part.within) for part in parts if part.within is not None)
        self._parts = [part for part in parts if part.kind != "compound_route" or id(part) in used]
        self._relations = relations
        self._chosen: dict[int, MapSegment] = {}
        self._choices = 0
        self._furthest = 0

    def solve(self) -> None:
        """Assigns each part its segment of the map.

        Raises:
            PlacementError: The map has no segments for which all constraints hold.
        """
        if not self._search(0):
            raise self._impossible()
        for part in self._parts:
            part.choose(self._chosen[id(part)])

    def _impossible(self) -> PlacementError:
        """The error: a modifier without segments, else the part at which the search ended."""
        for relation in self._relations:
            if next(relation.modifier.rows(self._graph, {}), None) is None:
                return PlacementError(
                    f"map {self._map_name} has nothing for which {relation.modifier.name} holds",
                    relation.source,
                )
        part = self._parts[self._furthest]
        names = [r.modifier.name for r in self._relations if part in r.modifier.parts().values()]
        alone = part.requirements or "its anchors hold"
        what = f"{' and '.join(dict.fromkeys(names))} hold" if names else alone
        sources = [r.source for r in self._relations if part in r.modifier.parts().values()]
        return PlacementError(
            f"map {self._map_name} has no {part.kind} for which {what}",
            part.source or (sources[0] if sources else None),
        )

    def _search(self, index: int) -> bool:
        if index == len(self._parts):
            return all(self._holds(relation) for relation in self._relations)
        self._furthest = max(self._furthest, index)
        part = self._parts[index]
        for segment in self._options(part):
            self._choices += 1
            if self._choices > _MOST_CHOICES:
                raise PlacementError(
                    f"map {self._map_name}: no segments for the declared roads were found in"
                    f" {_MOST_CHOICES} attempts; constrain each of them further"
                )
            self._chosen[id(part)] = segment
            if self._consistent(part) and self._search(index + 1):
                return True
            del self._chosen[id(part)]
        return False

    def _options(self, part: RoadPart) -> Iterator[MapSegment]:
        """Segments for a part, limited by the first modifier with known parts.

        Without one all candidates.
        """
        for relation in self._relations:
            parts = relation.modifier.parts()
            names = [name for name, other in parts.items() if other is part]
            known = self._known(relation) if names else {}
            if known or (names and relation.modifier.leads):
                found = relation.modifier.rows(self._graph, known)
                tried: set[MapSegment] = set()
                for row in found:  # evaluated only as far as needed
                    if row[names[0]] not in tried:
                        tried.add(row[names[0]])
                        yield row[names[0]]
                return
        yield from part.candidates(self._graph)

    def _known(self, relation: Relation) -> dict[str, MapSegment]:
        parts = relation.modifier.parts()
        return {
            name: self._chosen[id(part)] for name, part in parts.items() if id(part) in self._chosen
        }

    def _holds(self, relation: Relation) -> bool:
        rows = relation.modifier.rows(self._graph, self._known(relation))
        return next(rows, None) is not None

    def _consistent(self, part: RoadPart) -> bool:
        """Whether the constraints of a part hold, and all modifiers are still possible."""
        segment = self._chosen[id(part)]
        if not part.suits(self._graph, segment):
            return False
        inner = [other for other in self._parts if other.within is not None]
        for other in inner:
            if other is part or other.within is part:
                outer = None if other.within is None else self._chosen.get(id(other.within))
                own = self._chosen.get(id(other))
                if outer is not None and own is not None and not _inside(own, outer):
                    return False
        about = (r for r in self._relations if part in r.modifier.parts().values())
        return all(self._holds(relation) for relation in about)


def _implied(parts: Sequence[RoadPart]) -> Iterator[Relation]:
    """Constraints of parts on others: their members, lanes and positions."""
    for part in parts:
        said: list[MapModifier | None] = [*listed_members(part)]
        if isinstance(part, Crossing):
            said.append(implied(part))
        elif isinstance(part, RoadPath):
            said.extend(differences(part))
        yield from (Relation(each, part.source) for each in said if each is not None)


def _inside(inner: MapSegment, outer: MapSegment) -> bool:
    if inner.road != outer.road:
        return False
    if outer.kind == "road":
        return True
    return (inner.section, inner.forwards) == (outer.section, outer.forwards)
