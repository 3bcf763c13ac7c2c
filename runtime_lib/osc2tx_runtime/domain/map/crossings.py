"""Declared crossings, on crosswalks of the map or at other positions (DSL 8.12.11)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.roads_and_lanes import Lane, Route
from osc2tx_runtime.domain.map.route_elements import Required, fulfils, stated
from osc2tx_runtime.domain.map.segments import CrossingLine, MapSegment
from osc2tx_runtime.enums import CrossingElevation, CrossingMarking, CrossingUse
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import Crosswalk
from osc2tx_shared.classes import dataclass

_SAME = 0.1  # m between a required width and that of a crosswalk
_ON_ROAD = 0.01  # m above the road


@dataclass(frozen=True, slots=True)
class CrossingType:
    """The type of a crossing; None: not stated.

    Attributes:
        marking: Its marking on the road.
        use: Its users.
        elevation: Its height above the road.
    """

    marking: CrossingMarking | None = None
    use: CrossingUse | None = None
    elevation: CrossingElevation | None = None


# Subtype of a crosswalk in OpenDRIVE -> marking and use.
_SUBTYPES: Mapping[str, tuple[CrossingMarking | None, CrossingUse]] = {
    "": (None, "pedestrian"),
    "pedestrian": ("marked", "pedestrian"),
    "zebra": ("zebra", "pedestrian"),
    "bicycle": ("marked", "bicycle"),
    "virtual": ("unmarked", "pedestrian"),
}


def type_of(crosswalk: Crosswalk) -> CrossingType:
    """The type of a crosswalk in the map."""
    marking, use = _SUBTYPES.get(crosswalk.subtype, ("other", "other"))
    level: CrossingElevation | None = "road_level" if crosswalk.lift < _ON_ROAD else None
    return CrossingType(marking, use, level)


class Crossing(Route):
    """A straight path across lanes: a crosswalk of the map, or stated by `crossing_connects`.

    Args:
        start_lane: Lane in whose middle it begins.
        end_lane: Lane in whose middle it ends.
        start_s_coord: Metres along the start lane at which it begins.
        end_s_coord: Metres along the end lane at which it ends.
        width: Its width (m) or range of widths; also that of a crossing without crosswalk.
        crossing_type: Its type.
        anchors: Id or name of the crosswalk in the map.
        length: Its length (m) or range of lengths.
    """

    kind = "crossing"

    def __init__(
        self,
        *,
        start_lane: Lane | None = None,
        end_lane: Lane | None = None,
        start_s_coord: float | None = None,
        end_s_coord: float | None = None,
        width: Required | None = None,
        crossing_type: CrossingType | None = None,
        anchors: Sequence[str] = (),
        length: Required | None = None,
    ) -> None:
        super().__init__(anchors=anchors, length=length)
        self.wanted_lanes = (start_lane, end_lane)
        self.wanted_s = (start_s_coord, end_s_coord)
        self._width = width
        self._type = crossing_type or CrossingType()

    @property
    def requirements(self) -> str:
        """Its constraints on the map."""
        asked = (
            ("marking", self._type.marking),
            ("use", self._type.use),
            ("elevation", self._type.elevation),
        )
        own = [f"{name} is {value}" for name, value in asked if value is not None]
        own += [stated("width is {} m", self._width), super().requirements]
        return " and ".join(filter(None, own))

    def names_of(self, graph: RoadGraph, segment: MapSegment) -> tuple[str, ...]:
        """Id and name of its crosswalk."""
        found = _crosswalk(graph, segment)
        return () if found is None else (found.id, *filter(None, [found.name]))

    def suits(self, graph: RoadGraph, segment: MapSegment) -> bool:
        """Whether its crosswalk fulfils the requirements; without a crosswalk none may exist."""
        found = _crosswalk(graph, segment)
        if found is None:
            is_free = not self._anchors and self._type == CrossingType()
            return is_free and super().suits(graph, segment)
        known, asked = type_of(found), self._type
        pairs = (
            (asked.marking, known.marking),
            (asked.use, known.use),
            (asked.elevation, known.elevation),
        )
        if any(one is not None and one != other for one, other in pairs):
            return False
        if not fulfils(self._width, found.width, _SAME):
            return False
        return super().suits(graph, segment)

    @property
    def line(self) -> CrossingLine:
        """Its centre line."""
        line = self.found.line
        assert line is not None
        return line

    # --- read from the map --------------------------------------------------------------------

    @property
    def start_lane(self) -> Lane:
        """Lane in whose middle it begins."""
        return self._as(Lane(), self.found.parts[0])

    @property
    def end_lane(self) -> Lane:
        """Lane in whose middle it ends."""
        return self._as(Lane(), self.found.parts[1])

    @property
    def start_s_coord(self) -> float:
        """Metres along the first lane at which it begins."""
        return self.line.start_s

    @property
    def end_s_coord(self) -> float:
        """Metres along the other lane at which it ends."""
        return self.line.end_s

    @property
    def width(self) -> float:
        """Its width (m): of the crosswalk, else as stated in the scenario.

        Raises:
            ScenarioError: It is not stated.
        """
        if self.stated_width is None:
            raise ScenarioError(f"the width of {self.found} is not stated", self.source)
        return self.stated_width

    @property
    def stated_width(self) -> float | None:
        """Its width (m); None if it is not stated."""
        if self.line.width is not None:
            return self.line.width
        return self._width if isinstance(self._width, int | float) else None

    @property
    def crossing_type(self) -> KnownCrossingType:
        """Its type in the map."""
        found = _crosswalk(self.graph, self.found)
        return KnownCrossingType(CrossingType() if found is None else type_of(found), self)


class KnownCrossingType:
    """The type of a crossing, for reading.

    Args:
        known: The values of the map.
        crossing: The crossing.
    """

    def __init__(self, known: CrossingType, crossing: Crossing) -> None:
        self._known = known
        self._crossing = crossing

    def _missing(self, member: str) -> ScenarioError:
        return ScenarioError(
            f"the map does not state the {member} of {self._crossing.found}", self._crossing.source
        )

    @property
    def marking(self) -> CrossingMarking:
        """Its marking on the road."""
        if self._known.marking is None:
            raise self._missing("marking")
        return self._known.marking

    @property
    def use(self) -> CrossingUse:
        """Its users."""
        if self._known.use is None:
            raise self._missing("use")
        return self._known.use

    @property
    def elevation(self) -> CrossingElevation:
        """Its height above the road."""
        if self._known.elevation is None:
            raise self._missing("elevation")
        return self._known.elevation


def _crosswalk(graph: RoadGraph, segment: MapSegment) -> Crosswalk | None:
    """The crosswalk of the map on which a crossing lies."""
    line = segment.line
    walks = graph.map.crosswalks()
    return next((w for w in walks if line is not None and w.id == line.crosswalk), None)
