"""Conditions that no other actor is near."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, PRODUCT, SUM, literal
from osc2tx.importing.effects import Reader, Readings
from osc2tx.importing.expressions import joined_by
from osc2tx.importing.place_conditions import ANYWHERE, boxes
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.distances import asked

CLEARANCE = "RelativeClearanceCondition"
MANY = 20  # lanes: no road has more


class Clearances(Reader):
    """Reads clearances.

    Attributes:
        cleared: Who is ahead of whom by the clearances of the group at hand: 1 ahead, -1 behind.
        sides: Those of them whose distances count with a clearance.
    """

    def __init__(self, readings: Readings) -> None:
        super().__init__(readings)
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

    def expression(self, node: Node, actor: Actor) -> str | None:
        """Return the condition that no other actor is near, ahead or behind."""
        named = [self._actor(each) for each in node.children("EntityRef")]
        others = {each.said: each for each in named or self._actors.values()}
        if not named:
            del others[actor.said]
        side, mode = _side_of(self._places.resolved(node)), boxes(node, "freeSpace")
        lanes = list(node.children("RelativeLaneRange"))
        is_narrow = any(
            abs(self._values.nominal(each, end, MANY)) < MANY
            for each in lanes
            for end in ("from", "to")
        )
        aside = self._aside(actor, lanes) if is_narrow else None
        all_count = node.is_true("oppositeLanes")
        if aside is not None:
            also = "" if all_count else ", and those of oncoming traffic count"
            node.approximate(f"lanes beside the actor are as wide as its first one{also}")
        elif is_narrow or not all_count:
            node.approximate("a clearance is that of all lanes")
        texts = []
        for other in others.values():
            if (actor.said, other.said) in self.sides:
                continue
            lane_of = [body and body.place for body in map(self._body, (actor, other))]
            roads = [lane and lane.road for lane in lane_of]
            # along roads there is no distance where none leads to the other one
            is_along = roads[0] is not None and roads[0] == roads[1]
            method = "road_distance" if is_along else "object_distance"
            measure = f"{actor.name}.{method}({other.name}, longitudinal{mode})"
            ahead = self._values.quantity(node, "distanceForward", LENGTH)
            behind = self._values.quantity(node, "distanceBackward", LENGTH)
            is_behind = (
                f"{measure} < -{behind.within(PRODUCT)}" if behind.value else f"{measure} < 0m"
            )
            is_ahead = f"{measure} > {ahead.within(SUM)}"
            text = {-1: is_behind, 1: is_ahead}.get(side, f"{is_behind} or {is_ahead}")
            if aside is not None and is_along:
                across = f"{actor.name}.road_distance({other.name}, lateral)"
                text += f" or {across} < {aside[0]} or {across} > {aside[1]}"
            texts.append(text)
        node.use_all()
        return joined_by("and", texts) if texts else "true"

    def _aside(self, actor: Actor, lanes: Sequence[Node]) -> tuple[str, str] | None:
        """Return how far to the right and to the left a range of lanes reaches."""
        at = self._on_road(actor)
        if at is None or len(lanes) != 1:
            return None
        width = at.map.lane_width(at.place.road, at.place.lane, at.place.s)
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
