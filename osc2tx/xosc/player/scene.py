"""The state that running actions share: the bodies on their map, and the time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import Body
from osc2tx.xosc.player.distances import Ruler
from osc2tx.xosc.player.errors import Unplayable
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_shared.classes import dataclass

STILL = 1e-9
GAP_REACHED = 0.05  # m
SIDES = {
    "trailingReferencedEntity": 1,
    "leadingReferencedEntity": -1,
    "leftToReferencedEntity": 1,
    "rightToReferencedEntity": -1,
}


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

    def gap(self, body: Body, node: Element, kind: str) -> float:
        """Return how far the reference of an action on a distance is ahead, or to the left."""
        other = self.bodies[node.said("entityRef")]
        system = node.get("coordinateSystem") or "entity"
        found = self.ruler.signed(body, other, kind, system)
        if found is None:
            raise Unplayable(f"there is no way from {body.name} to {other.name}")
        return found

    def side(self, body: Body, node: Element, kind: str) -> int:
        """Return the side of the reference on which an action keeps its distance.

        If none is stated, as in 1.0, or any, it is the present side of the body.
        """
        told = node.get("displacement")
        if told is not None and told != "any":
            return SIDES[told]
        is_ahead = self.gap(body, node, kind) > 0.0  # the reference, or to the left
        return 1 if is_ahead is (kind == "longitudinal") else -1
