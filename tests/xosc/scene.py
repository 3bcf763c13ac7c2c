"""What actions at work share: the bodies on their map, and the time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from osc2tx_runtime.opendrive import RoadMap
from tests.xosc.bodies import Body, Pose
from tests.xosc.courses import Course, Node
from tests.xosc.distances import Ruler

STILL = 1e-9
GAP_REACHED = 0.05  # m
SIDES = {
    "trailingReferencedEntity": 1,
    "leadingReferencedEntity": -1,
    "leftToReferencedEntity": 1,
    "rightToReferencedEntity": -1,
}


@dataclass
class Running:
    """An action at work.

    Attributes:
        body: On what.
        domains: Which of its domains it controls.
        begun: When it began (s).
        length: Seconds that it takes; `None`: it ends by itself or never.
        speed: Course of the speed.
        offset: Course of the offset.
        way: Points of a polyline, with times where it has some.
        is_timed: These times count.
        points: Metres from its start to each of its points.
        gap: The action that keeps a distance.
        side: 1 if that is kept behind the other one or to its left, -1 on the other side.
        relative: The action that keeps a speed relative to that of another one.
        driven: Metres along the way so far.
        done: It is over.
    """

    body: Body
    domains: tuple[str, ...]
    begun: float
    length: float | None
    speed: Course | None = None
    offset: Course | None = None
    way: Sequence[tuple[float, Pose]] = ()
    is_timed: bool = False
    points: list[float] = field(default_factory=list)
    gap: Node | None = None
    side: int = 1
    relative: Node | None = None
    driven: float = 0.0
    done: bool = False


@dataclass
class Scene:
    """The bodies of a document on its map.

    Attributes:
        bodies: By name.
        map: The map.
        dt: Length of a step (s).
        time: Seconds since the start.
        ruler: Measures on the map.
    """

    bodies: Mapping[str, Body]
    map: RoadMap
    dt: float
    time: float = 0.0
    ruler: Ruler = field(init=False)

    def __post_init__(self) -> None:
        self.ruler = Ruler(self.map)

    def gap(self, body: Body, node: Node, kind: str) -> float:
        """Return how far the other one of an action on a distance is ahead, or to the left."""
        other = self.bodies[node.get("entityRef")]
        system = node.get("coordinateSystem", "entity")
        found = self.ruler.signed(body, other, kind, system)
        assert found is not None, f"there is no way from {body.name} to {other.name}"
        return found

    def side(self, body: Body, node: Node, kind: str) -> int:
        """Return on which side of the other one an action keeps its distance.

        In 1.0 it cannot say one: then it is that on which the body is.
        """
        told = node.get("displacement")
        if told is not None:
            return SIDES[told]
        is_ahead = self.gap(body, node, kind) > 0.0  # the other one, or to the left
        return 1 if is_ahead is (kind == "longitudinal") else -1
