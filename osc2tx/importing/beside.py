"""Places that are told by another actor: in its lane or beside it, so far ahead or behind."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, PRODUCT, Quantity, literal, total
from osc2tx.importing.document import Document
from osc2tx.importing.ground import Ground, teleports
from osc2tx.importing.points import Spot, heading_of, lane_beside, odr_point
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import Pose
from osc2tx_runtime.opendrive import LanePosition, MapError

SAME = 0.001  # m: so near are places that are the same


class Beside:
    """Reads places beside other actors."""

    def __init__(
        self, ground: Ground, document: Document, values: Values, actors: Mapping[str, str]
    ) -> None:
        self._ground, self._document = ground, document
        self._values, self._actors = values, actors

    def in_lanes(self, node: Node, *, at_start: bool) -> Spot | None:
        """Return a place in lanes and metres beside another actor."""
        said = node.said("entityRef")
        reference = self._actors.get(said)
        if reference is None or node.find("Orientation") is not None:
            return None
        lanes = int(self._values.nominal(node, "dLane"))
        if abs(self._values.nominal(node, "offset")) > 1e-9 or self._values.varies(node, "offset"):
            return None
        direction, road_map = 1, self._ground.map
        if road_map is not None and at_start:
            body, found = self._ground.bodies.get(said), self._ground.static_of(node)
            if body is None or body.pose is None or found is None:
                return None
            theirs, ours = body.in_lane(road_map), found[0]
            if not isinstance(ours, LanePosition) or theirs.road != ours.road or body.along < 0:
                return None
            direction = road_map.travel_direction(*theirs[:2])
            if direction != road_map.travel_direction(*ours[:2]):
                return None
            if self._is_shorter(node, theirs, ours):
                return None
        along = "dsLane" if node.has("dsLane") else "ds"
        ahead = self._values.quantity(node, along, LENGTH)
        side = "ahead_of" if direction > 0 or along == "dsLane" else "behind"
        if not ahead.is_open and ahead.value < 0.0:
            ahead = Quantity(literal(-ahead.value, LENGTH), -ahead.value)
            side = {"ahead_of": "behind", "behind": "ahead_of"}[side]
        modifiers = [
            self._beside_lane(node, reference, lanes),
            f"position({ahead.text}, {side}: {reference})",
        ]
        return Spot(modifiers=modifiers)

    def _is_shorter(self, node: Node, from_: LanePosition, to: LanePosition) -> bool:
        """Whether a distance along the road is another one than along the lane: in a bend."""
        assert self._ground.map is not None
        ds = self._values.nominal(node, "ds")
        if node.has("dsLane") or not math.isfinite(ds):
            return False
        direction = self._ground.map.travel_direction(from_.road, from_.lane)
        there = self._ground.map.advance(from_._replace(offset=0.0), ds * direction).position
        return there.road != to.road or abs(there.s - to.s) > SAME

    def in_road(self, node: Node) -> Spot | None:
        """Return a place on the road of another actor, whose own place says where that is."""
        said = node.said("entityRef")
        at, found = self._ground.on_road(said), self._ground.static_of(node)
        start = self._start_of(said)
        if at is None or found is None or start is None or start.tag != "LanePosition":
            return None
        place, heading = found
        if not isinstance(place, LanePosition):
            return None
        s = self._values.quantity(node.other(start), "s", LENGTH)
        along = "dsLane" if node.has("dsLane") else "ds"
        ahead = self._values.quantity(node, along, LENGTH)
        direction = at.direction * at.body.along
        sign = 1 if along == "ds" else direction
        if place.road != at.place.road or abs(s.value + sign * ahead.value - place.s) > 1e-6:
            return None
        if (node.text("dLane") or "0").startswith("$"):
            node.approximate(f"dLane keeps the nominal value of `{node.text('dLane')}`")
        offset = self._values.quantity(node, "offset", LENGTH)
        t = offset.text if direction > 0 else f"-{offset.within(PRODUCT)}"
        way = total(LENGTH, (1, s), (sign, ahead)).text
        if not (s.is_open or ahead.is_open):
            way = literal(place.s, LENGTH)
        return Spot(
            odr_point(place.road, str(place.lane), way, t),
            yaw="" if heading is None else heading_of(heading),
        )

    def along_road(self, node: Node) -> tuple[LanePosition, str, float] | None:
        """Return a place along the road of another actor: its lane, its s as a text, its heading.

        `None`: it is not known, or its way across the road varies.
        """
        said = node.said("entityRef")
        here, found = self._ground.on_road(said), self._ground.static_of(node)
        start = self._start_of(said)
        if here is None or found is None or start is None or start.tag != "LanePosition":
            return None
        if (node.element.get("dt") or "").startswith("$"):
            return None
        s = self._values.quantity(node.other(start), "s", LENGTH)
        ahead = self._values.quantity(node, "ds", LENGTH)
        across = here.place.offset + self._values.nominal(node, "dt") * here.direction
        place = here.place._replace(s=s.value + ahead.value, offset=across)
        try:
            at, pose = here.map.pose(place), self._ground.pose_of(found[0])
        except (MapError, LookupError):
            return None
        if math.hypot(at.x - pose.x, at.y - pose.y) > SAME:
            return None
        heading = found[0].h if found[1] is None and isinstance(found[0], Pose) else found[1]
        assert heading is not None
        return place, total(LENGTH, (1, s), (1, ahead)).text, heading

    def at_gap(
        self, node: Node, said: str, reference: str, gap: Quantity, *, ahead: bool
    ) -> Spot | None:
        """Return the place along the road of another entity, as far aside as it was put before.

        Args:
            node: The action that says the gap.
            said: The entity.
            reference: The other one, in the same lane.
            gap: How far the entity is ahead or behind, along the road.
            ahead: Whether it is ahead.
        """
        at, start, own = self._ground.on_road(said), self._start_of(reference), self._start_of(said)
        if at is None or start is None or own is None or start.tag != "LanePosition":
            return None
        s = self._values.quantity(node.other(start), "s", LENGTH)
        offset = self._values.quantity(node.other(own), "offset", LENGTH)
        direction = at.direction * at.body.along
        is_left = own.tag == "LanePosition" or direction > 0
        t = offset.text if is_left else f"-{offset.within(PRODUCT)}"
        way = total(LENGTH, (1, s), (direction if ahead else -direction, gap))
        return Spot(odr_point(at.place.road, str(at.place.lane), way.text, t))

    def varies_aside(self, said: str) -> bool:
        """Whether an entity is put into its lane with an offset that varies from run to run."""
        start = self._start_of(said)
        given = None if start is None else start.get("offset")
        return given is not None and self._values.varies_in(given)

    def _start_of(self, said: str) -> Element | None:
        """Return the element of the place at which an entity is put at the start."""
        return next(
            (
                position.inner
                for private in self._document.tagged("Private")
                if private.get("entityRef") == said
                for position in teleports(private)
            ),
            None,
        )

    def _beside_lane(self, node: Node, reference: str, lanes: int) -> str:
        text = node.text("dLane") or "0"
        parameter = self._values.parameters.get(text[1:]) if text.startswith("$") else None
        if (
            parameter is not None
            and lanes != 0
            and parameter.kind != "double"
            and parameter.expression is not None
        ):
            parameter.is_used = True
            p = parameter.name
            if {abs(each) for each in self._values.allowed(parameter) or ()} == {1.0}:
                return f"lane(side_of: {reference}, side: {p} > 0 ? left : right)"
            return f"lane({p} > 0 ? {p} : -{p}, side_of: {reference}, side: {p} > 0 ? left : right)"
        if text.startswith("$"):
            node.approximate(f"dLane keeps the nominal value of `{text}`")
        return lane_beside(reference, lanes)
