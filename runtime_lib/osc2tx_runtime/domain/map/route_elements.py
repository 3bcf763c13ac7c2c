"""Bases of declared roads, lanes and routes: constraints, and values of the map.

A scenario constrains its roads (`number_of_lanes`, `lane_side`, ...); before the start the
`MapSolver` chooses for each of them a segment of the map that fulfils all constraints.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias, TypeVar

from osc2tx_runtime.domain.map.objects import MapObject
from osc2tx_runtime.domain.map.road_graph import RoadGraph, graph_of
from osc2tx_runtime.domain.map.route_axes import directionality_of, length_of, widths_of
from osc2tx_runtime.domain.map.segments import MapSegment, PartKind
from osc2tx_runtime.domain.points_and_poses import RouteAxis, RoutePoint
from osc2tx_runtime.enums import Directionality
from osc2tx_runtime.errors import ScenarioError

if TYPE_CHECKING:
    from osc2tx_runtime.language.values.parameters import Range

Required: TypeAlias = "float | Range[Any]"


def fulfils(
    required: Required | None,
    value: float,
    tolerance: float = 0.0,
    *,
    at_least: bool = False,
    at_most: bool = False,
) -> bool:
    """Whether a number of the map fulfils a requirement.

    Args:
        required: The required value; None: no requirement.
        value: The number.
        tolerance: Allowed difference from a plain number.
        at_least: A plain number is a lower bound,
        at_most: or an upper one.
    """
    if required is None:
        return True
    low, high = _bounds(required, at_least=at_least, at_most=at_most)
    return low - tolerance <= value <= high + tolerance


def stated(
    text: str, required: Required | None, *, at_least: bool = False, at_most: bool = False
) -> str:
    """The requirement in words, for `{}` of a text; empty without one."""
    if required is None:
        return ""
    low, high = _bounds(required, at_least=at_least, at_most=at_most)
    if low == high:
        return text.format(f"{low:g}")
    if high == math.inf:
        return text.format(f"at least {low:g}")
    return text.format(f"at most {high:g}" if low == -math.inf else f"{low:g} to {high:g}")


def _bounds(required: Required, *, at_least: bool, at_most: bool) -> tuple[float, float]:
    if isinstance(required, int | float):
        return -math.inf if at_most else required, math.inf if at_least else required
    return required.low, required.high


SAME = 0.01  # m between the required and the existing value

PartT = TypeVar("PartT", bound="RoadPart")


class RoadPart(MapObject, RouteAxis):
    """An element of the road network that a scenario declares.

    Args:
        anchors: Its position in the map file: the id or the name of its road, or `road:lane`.
        min_lanes: Least number of drivable lanes, or its range.
        max_lanes: Largest number of drivable lanes, or its range.
        length: Its length (m) or range of lengths.
        directionality: Directions of its lanes.
        within: A longer part that it belongs to.
        listed: Its elements, by the name of the member.
    """

    word = "route"
    kind: ClassVar[PartKind]

    def __init__(
        self,
        *,
        anchors: Sequence[str] = (),
        min_lanes: Required | None = None,
        max_lanes: Required | None = None,
        length: Required | None = None,
        directionality: Directionality | None = None,
        within: RoadPart | None = None,
        listed: Mapping[str, Sequence[RoadPart] | None] | None = None,
    ) -> None:
        super().__init__(None)
        self._anchors = tuple(anchors)
        self._least, self._most, self._long = min_lanes, max_lanes, length
        self._ways = directionality
        self.within = within
        members = (listed or {}).items()
        self.listed = {name: parts for name, parts in members if parts is not None}
        self._found: MapSegment | None = None

    # --- choosing -----------------------------------------------------------------------------

    @property
    def found(self) -> MapSegment:
        """The chosen segment of the map."""
        if self._found is None:
            raise ScenarioError(f"a {self.kind} is used before the map is known")
        return self._found

    def choose(self, segment: MapSegment) -> None:
        """Sets the chosen segment of the map."""
        self._found = segment

    @property
    def requirements(self) -> str:
        """Its own constraints on the map, besides its anchors."""
        requirements = (
            stated("there are {} lanes", self._least, at_least=True),
            stated("there are {} lanes", self._most, at_most=True),
            stated("there are {} m", self._long),
            "" if self._ways is None else f"directionality is {self._ways}",
        )
        return " and ".join(filter(None, requirements))

    def candidates(self, graph: RoadGraph) -> tuple[MapSegment, ...]:
        """Segments of the map to choose from, in order of trial."""
        return graph.all(self.kind)

    def suits(self, graph: RoadGraph, segment: MapSegment) -> bool:
        """Whether a segment fulfils the requirements of this part alone."""
        if not all(anchor in self.names_of(graph, segment) for anchor in self._anchors):
            return False
        if not fulfils(self._long, length_of(graph, segment) if self._long else 0.0, SAME):
            return False
        if self._ways not in (None, directionality_of(graph, segment)):
            return False
        if self._least is None and self._most is None:
            return True
        counts = widths_of(graph, segment)
        return fulfils(self._least, min(counts), at_least=True) and fulfils(
            self._most, max(counts), at_most=True
        )

    def names_of(self, graph: RoadGraph, segment: MapSegment) -> tuple[str, ...]:
        """The identifier of a segment in the map file."""
        road = graph.map.roads.get(segment.road)
        lane = () if segment.lane is None else (f"{segment.road}:{segment.lane}",)
        return (*lane, segment.road, *(() if road is None or not road.name else (road.name,)))

    # --- read from the map --------------------------------------------------------------------

    @property
    def graph(self) -> RoadGraph:
        """The map with its connections."""
        if self._context is None:
            raise ScenarioError(f"a {self.kind} is read before the scenario runs", self.source)
        return graph_of(self._context.world.map)

    def seen(self, kind: type[PartT], segments: Iterable[MapSegment]) -> tuple[PartT, ...]:
        """Other parts of the same map."""
        return tuple(self._as(kind(), segment) for segment in segments)

    def _as(self, part: PartT, segment: MapSegment) -> PartT:
        part.choose(segment)
        part._context = self._context
        return part


class Route(RoadPart):
    """An element with an axis to move along (DSL 8.12.5).

    The modifier in which it is used determines its kind; without one it is a road.
    """

    kind: ClassVar[PartKind] = "route"

    @property
    def length(self) -> float:
        """Length of its axis (m)."""
        return length_of(self.graph, self.found)

    @property
    def directionality(self) -> Directionality:
        """In which directions its lanes are used; `split` if they differ."""
        return directionality_of(self.graph, self.found)

    @property
    def min_lanes(self) -> int:
        """Least number of adjacent drivable lanes along it."""
        return min(widths_of(self.graph, self.found))

    @property
    def max_lanes(self) -> int:
        """Largest number of adjacent drivable lanes along it."""
        return max(widths_of(self.graph, self.found))

    @property
    def anchors(self) -> list[str]:
        """Its anchor in the map file: declared by the scenario, else the identifier in the file."""
        return list(self._anchors or self.names_of(self.graph, self.found))

    def start_point(self) -> RoutePoint:
        """Its start (DSL 8.12.5.1.1)."""
        return RoutePoint(self, 0.0, 0.0)

    def end_point(self) -> RoutePoint:
        """Its end (DSL 8.12.5.1.2)."""
        return RoutePoint(self, self.length, 0.0)
