"""Conditions that no other actor is near."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, PRODUCT, SUM, literal
from osc2tx.importing.expressions import joined_by
from osc2tx.importing.place_conditions import ANYWHERE
from osc2tx.importing.places import Places
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.distances import asked

CLEARANCE = "RelativeClearanceCondition"
MANY = 20  # lanes: no road has more


class Clearances:
    """Reads clearances.

    Attributes:
        cleared: Who is ahead of whom by the clearances of the group at hand: 1 ahead, -1 behind.
        sides: Those of them whose distances count with a clearance.
    """

    def __init__(
        self,
        values: Values,
        places: Places,
        actors: Mapping[str, Actor],
        name_of: Callable[[Node], str],
    ) -> None:
        self._values, self._places, self._actors = values, places, actors
        self._name_of = name_of
        self.cleared: dict[tuple[str, str], int] = {}
        self.sides: dict[tuple[str, str], int] = {}

    def begin_group(self, group: Sequence[Node]) -> None:
        """Note who is ahead of whom, where a distance of both and a clearance count together."""
        found = [(_pair(each), self._places.resolved(each).below(Element)) for each in group]
        nodes = [(pair, node) for pair, below in found for node in below if pair is not None]
        sides = {pair: _side_of(node) for pair, node in nodes if node.tag == CLEARANCE}
        self.cleared = {pair: side for pair, side in sides.items() if side}
        far = {
            pair
            for pair, node in nodes
            if node.tag in ("RelativeDistanceCondition", "TimeHeadwayCondition")
            and asked(node)[0] == "longitudinal"
            and node.said("rule").startswith("greater")
        }
        self.sides = {pair: side for pair, side in self.cleared.items() if pair in far}

    def expression(self, node: Node, said: str, a: str) -> str | None:
        """Return the condition that no other actor is near, ahead or behind."""
        refs = list(node.children("EntityRef"))
        others = {self._values.text(each, "entityRef"): self._name_of(each) for each in refs}
        if not others:
            others = {key: each.name for key, each in self._actors.items() if each.name != a}
        side = _side_of(self._places.resolved(node))
        free = (node.text("freeSpace") or "false").lower() in ("true", "1")
        lanes = list(node.children("RelativeLaneRange"))
        is_narrow = any(
            abs(self._values.nominal(each, end, MANY)) < MANY
            for each in lanes
            for end in ("from", "to")
        )
        aside = self._aside(said, lanes) if is_narrow else None
        all_count = (node.text("oppositeLanes") or "false").lower() in ("true", "1")
        if aside is not None:
            also = "" if all_count else ", and those of oncoming traffic count"
            node.approximate(f"lanes beside the actor are as wide as its first one{also}")
        elif is_narrow or not all_count:
            node.approximate("a clearance is that of all lanes")
        texts = []
        for key, b in others.items():
            if (said, key) in self.sides:
                continue
            bodies = [self._places.bodies.get(each) for each in (said, key)]
            roads = [
                None if each is None or each.place is None else each.place.road for each in bodies
            ]
            # along roads there is no distance where none leads to the other one
            is_along = roads[0] is not None and roads[0] == roads[1]
            method = "road_distance" if is_along else "object_distance"
            mode = ", bounding_boxes" if free else ""
            measure = f"{a}.{method}({b}, longitudinal{mode})"
            ahead = self._values.quantity(node, "distanceForward", LENGTH)
            behind = self._values.quantity(node, "distanceBackward", LENGTH)
            is_behind = (
                f"{measure} < -{behind.within(PRODUCT)}" if behind.value else f"{measure} < 0m"
            )
            is_ahead = f"{measure} > {ahead.within(SUM)}"
            text = {-1: is_behind, 1: is_ahead}.get(side, f"{is_behind} or {is_ahead}")
            if aside is not None and is_along:
                across = f"{a}.road_distance({b}, lateral)"
                text += f" or {across} < {aside[0]} or {across} > {aside[1]}"
            texts.append(text)
        node.use_all()
        return joined_by("and", texts) if texts else "true"

    def _aside(self, said: str, lanes: Sequence[Node]) -> tuple[str, str] | None:
        """Return how far to the right and to the left a range of lanes reaches."""
        body, road_map = self._places.bodies.get(said), self._places.map
        if body is None or body.place is None or road_map is None or len(lanes) != 1:
            return None
        width = road_map.lane_width(body.place.road, body.place.lane, body.place.s)
        ends = (self._values.nominal(lanes[0], name, MANY) for name in ("from", "to"))
        low, high = sorted(ends)
        right, left = (low - 0.5) * width, (high + 0.5) * width
        return literal(round(right, 3), LENGTH), literal(round(left, 3), LENGTH)


def _pair(condition: Node) -> tuple[str, str] | None:
    """Return the entity of a condition and the other one in it; `None`: there are others."""
    refs = [ref for each in condition.element.walk() if (ref := each.get("entityRef"))]
    return (refs[0], refs[1]) if len(refs) == 2 else None


def _side_of(clearance: Element) -> int:
    """Return 1 where a clearance is met by those ahead, -1: by those behind; 0: far from both."""
    ahead, behind = (
        float(clearance.get(name) or 0.0) for name in ("distanceForward", "distanceBackward")
    )
    if ahead >= ANYWHERE and behind == 0.0:
        return -1
    return 1 if behind >= ANYWHERE and ahead == 0.0 else 0
