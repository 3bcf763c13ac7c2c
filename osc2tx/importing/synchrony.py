"""Synchronized actors: what one does when another one, the master, is at some distance."""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, SPEED, TIME, Quantity, literal
from osc2tx.importing.effects import LONGITUDINAL, Effect, Reader
from osc2tx.importing.statements import Call, Statement, When, call, composed
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.synchrony import Plan, final_of, plan, way_left
from osc2tx_runtime.opendrive import LanePosition, MapError

EVEN = 0.01  # m/s: a speed nearer than this to the present one is no change


class Synchrony(Reader):
    """Reads synchronizations.

    An actor begins to change its speed when the master is at the distance that it drives in the
    meantime, at the speed it has then. How far both have to go is known from their starts.
    """

    def effects(self, node: Node, actor: Actor) -> Iterator[Effect]:
        """Return what a synchronization does."""
        final = node.find("FinalSpeed")
        speed = None if final is None else next(final.children("AbsoluteSpeed"), None)
        target = None if speed is None else self._values.quantity(speed, "value", SPEED)
        found = self._planned(node, actor)
        node.use_all()
        if found is None:
            node.leave_out("when both come to their places is not known before the run")
            return
        node.approximate(
            "the course of the speed is up to the tool; here the acceleration is constant"
        )
        steps, last = found
        end = target or Quantity(literal(round(last, 6), SPEED), last)
        statement = self._statement(steps, actor, node, end)
        self._speeds[actor.said] = end
        yield Effect(statement, actor.name, frozenset((LONGITUDINAL,)))

    def _planned(self, node: Node, actor: Actor) -> tuple[Plan, float] | None:
        """Return the plan at nominal values, and the final speed (m/s)."""
        action, road_map = self._places.resolved(node), self._places.map
        body = self._body(actor)
        master = self._places.bodies.get(action.get("masterEntityRef") or "")
        if body is None or master is None or road_map is None:
            return None
        speeds = [self._speeds.get(each.name) for each in (body, master)]
        body.v, master.v = (0.0 if each is None else each.value for each in speeds)
        try:
            place = self._places.known(action.one(xml.TargetPosition))
            their_place = self._places.known(action.one(xml.TargetPositionMaster))
            if place is None or their_place is None or abs(master.v) <= EVEN:
                return None
            own, theirs = way_left(body, place, road_map), way_left(master, their_place, road_map)
            theirs = theirs * math.copysign(1.0, master.v) - abs(master.v) * self._readings.begin
            own -= body.v * self._readings.begin
            final, steady = final_of(action, body.v, master)
        except (Unplayable, Unresolved, MapError, LookupError):
            return None
        if own <= 0.0 or theirs <= 0.0:
            return None
        return plan(own, theirs / abs(master.v), body.v, final, steady), final

    def _statement(self, steps: Plan, actor: Actor, node: Node, end: Quantity) -> Statement:
        """Return what the actor does."""

        def change(target: str, duration: str) -> Call:
            told = {"target": target, "rate_profile": "constant", "duration": duration}
            return call(actor.name, "change_speed", **told)

        members: list[Statement] = []
        if steps.through is not None and abs(steps.through - end.value) > EVEN:
            half = literal(round(0.5 * steps.change, 6), TIME)
            middle = literal(round(steps.through, 6), SPEED)
            members.append(Statement(change(middle, half)))
            members.append(Statement(change(end.text, half)))
        elif steps.through is None and steps.change > 0.0:
            if steps.hold > 0.0:
                until = When(self._is_near(node, steps))
                members.append(Statement(actor.goes_on, until=[until]))
            time = literal(round(steps.change, 6), TIME)
            members.append(Statement(change(end.text, time)))
        elif steps.through is not None:
            members.append(self._held(actor, steps.change))
        if steps.steady > 0.0:
            members.append(self._held(actor, steps.steady))
        return composed("serial", members)

    @staticmethod
    def _held(actor: Actor, time: float) -> Statement:
        duration = literal(round(time, 6), TIME)
        return Statement(call(actor.name, "keep_speed", duration=duration), length=time)

    def _is_near(self, node: Node, steps: Plan) -> str:
        """Return the condition that the master is at the distance of the change."""
        action = self._places.resolved(node)
        actor = self._actors[action.said("masterEntityRef")]
        master, body, at = actor.name, self._places.bodies[actor.said], self._on_road(actor)
        place = self._places.known(action.one(xml.TargetPositionMaster))
        ahead = literal(round(steps.change + steps.steady, 6), TIME)
        if isinstance(place, LanePosition) and at is not None and place.road == at.place.road:
            direction = at.direction * body.along * (1 if body.v >= 0.0 else -1)
            s = literal(place.s, LENGTH)
            given = node.one("TargetPositionMaster").inner
            if given.tag == "LanePosition" and self._values.varies(given, "s"):
                s = self._values.quantity(given, "s", LENGTH).text
            speed = f"{master}.speed" if body.v >= 0.0 else f"(-1) * {master}.speed"
            if direction > 0:
                return f"{master}.get_s_coord() >= {s} - {ahead} * {speed}"
            return f"{master}.get_s_coord() <= {s} + {ahead} * {speed}"
        here = self._places.ahead_of_start(body, (self._readings.begin + steps.hold) * body.v)
        assert place is not None
        there = self._places.pose_of(place)
        near = literal(round(math.dist(here[:2], there[:2]), 3), LENGTH)
        height = self._places.height(*there[:2])
        point = self._places.points.goal(*there[:2], height, master)
        return f"{master}.distance_to_xyz_point({point}, euclidean) <= {near}"
