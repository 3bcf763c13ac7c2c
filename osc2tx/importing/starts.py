"""How the actors of a document begin."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

from osc2tx.importing.actions import Actions
from osc2tx.importing.cast import Cast
from osc2tx.importing.cursor import Node
from osc2tx.importing.effects import LATERAL
from osc2tx.importing.places import Places
from osc2tx.importing.points import Spot
from osc2tx.importing.routes import REPLAYS, Routes
from osc2tx.importing.statements import Call, Statement, When, call, composed
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Unresolved

ROOM = 30.0  # m: so far apart are actors that do not touch


class Starts:
    """How the actors of a document begin.

    Attributes:
        world: What concerns no actor.
    """

    def __init__(
        self, storyboard: Node, values: Values, places: Places, actions: Actions, cast: Cast
    ) -> None:
        self._cast = cast
        self._actions = actions
        self.world: list[Statement] = []
        self._spots: dict[str, tuple[Spot, Node]] = {}
        self._speeds: dict[str, Statement] = {}
        self._ways: dict[str, Statement] = {}
        self._paths: dict[str, Statement] = {}
        self._others: dict[str, list[Statement]] = {}
        self._references: dict[str, set[str]] = {}
        init = storyboard.find("Init")
        for holder in () if init is None else init.children("Actions"):
            for node in holder.children():
                if node.tag == "Private":
                    self._private(node, values, places)
                elif node.tag == "GlobalAction":
                    self.world += [
                        each.statement for each in actions.effects(node, (), at_start=True)
                    ]
                else:
                    node.leave_out("actions of a user are for one tool")

    def _private(self, node: Node, values: Values, places: Places) -> None:
        said = values.text(node, "entityRef")
        actor = self._cast.actors.get(said)
        if actor is None:
            node.leave_out(f"there is no entity {said}")
            return
        for action in node.children("PrivateAction"):
            inner = next(action.children(), None)
            if inner is None:
                action.leave_out("it is empty")
                continue
            self._references.setdefault(said, set()).update(
                ref for each in inner.element.walk() if (ref := each.get("entityRef")) is not None
            )
            if inner.tag == "TeleportAction":
                try:
                    spot = places.spot(inner.one("Position"), actor.name, at_start=True)
                except Unresolved as error:
                    inner.leave_out(error.reason)
                    spot = None
                if spot is not None:
                    self._spots[said] = (spot, inner)
                    if self._paths.pop(said, None) is not None:
                        inner.approximate("the trajectory before it ends with it")
                continue
            if inner.tag == "RoutingAction" and inner.inner.tag == "AssignRouteAction":
                way = self._actions.along_route(inner.inner, said, actor)
                if way is not None:
                    self._ways[said] = way
                continue
            for effect in self._actions.effects(action, (said,), at_start=True):
                does = effect.statement.does
                verb = does.action if isinstance(does, Call) else ""
                if verb in REPLAYS and inner.tag == "RoutingAction":
                    self._begin_on(inner, said, places)
                if effect.slots == {LATERAL} and effect.statement.length is None:
                    self._paths[said] = effect.statement
                elif verb == "assign_speed":
                    self._set_speed(said, effect.statement)
                else:
                    self._others.setdefault(said, []).append(effect.statement)

    def _set_speed(self, said: str, statement: Statement) -> None:
        """Note the speed of an entity; it is at rest by itself."""
        self._speeds.pop(said, None)
        if [each.get("") for each in statement.calls] != ["0mps"]:
            self._speeds[said] = statement

    def _begin_on(self, node: Node, said: str, places: Places) -> None:
        """Forget where an entity is put that a trajectory puts elsewhere at once."""
        way, spot = places.trajectory(node), self._spots.get(said)
        put = None if spot is None else places.coordinates(spot[1].one("Position"))
        if way and spot is not None and put is not None and way[0][0] == 0.0:
            if math.dist(way[0][1][:2], put) < ROOM:
                return
            spot[1].idle("its trajectory begins elsewhere at the same time")
            del self._spots[said]

    def order(self, said: Sequence[str]) -> list[str]:
        """Return entities with those that others refer to first."""
        left, found = list(said), list[str]()
        while left:
            ready = [
                each
                for each in left
                if not (self._references.get(each, set()) - {each}) & set(left)
            ] or left[:1]
            found += ready
            left = [each for each in left if each not in ready]
        return found

    def _on_foot(self, said: str) -> list[str]:
        """Return the modifiers of an actor that begins at a point, with a heading of its own."""
        spot, _ = self._spots[said]
        modifiers = [f"position(at_point: {spot.position}, project_on_route: false, at: start)"]
        if spot.yaw:
            modifiers.append(_at_start(spot.yaw))
        speed = self._speeds.get(said)
        if speed is not None:
            assert isinstance(speed.does, Call)
            modifiers.append(f"speed({speed.does.get('')})")
        return modifiers

    def places(self, said: str) -> bool:
        """Whether an entity is put anywhere, or does anything."""
        return said in self._spots or said in self._paths or bool(self._others.get(said))

    def starts(self, places: Places, placed: Collection[str]) -> dict[str, tuple[str, int, float]]:
        """Return the lanes in which actors are put, with the s (m) along their roads.

        Of those that would be too near to others only the first one counts.

        Args:
            places: Where actors are.
            placed: Actors that the scenario puts beside others later.
        """
        found = {
            said: places.bodies[said].place
            for said, (spot, _) in self._spots.items()
            if said in places.bodies and spot.odr_point
        }
        taken: dict[str, tuple[str, int, float]] = {}
        for said, place in found.items():
            if place is None or self._cast.actors[said].name in placed:
                continue
            near = (s for road, _, s in taken.values() if road == place.road)
            if all(abs(s - place.s) > ROOM for s in near):
                taken[self._cast.actors[said].name] = (place.road, place.lane, place.s)
        return taken

    def turns_alone(self, said: str) -> bool:
        """Whether an entity has a heading of its own, and no other one begins beside it."""
        found = self._spots.get(said)
        others = (refs for name, refs in self._references.items() if name != said)
        return found is not None and bool(found[0].yaw) and not any(said in refs for refs in others)

    def _is_at_point(self, said: str) -> bool:
        found = self._spots.get(said)
        return found is not None and bool(found[0].position)

    def going_on(self, said: str) -> list[Statement]:
        """Return how an actor begins and goes on."""
        actor = self._cast.actors[said]
        if self._is_at_point(said) and not self._others.get(said):
            modifiers = self._on_foot(said)
            stands = said not in self._speeds and not self.has_way(said)
            does = call(actor.name, "remain_stationary") if stands else actor.moves
            return [Statement(does, modifiers=modifiers, length=math.inf)]
        return [*self.statements(said), *(self.lasting(said) or self.going(said))]

    def statements(self, said: str, then: list[Statement] | None = None) -> list[Statement]:
        """Return how an actor begins, at once.

        Args:
            said: The entity.
            then: What follows: a first wait in it ends the way up to there.
        """
        actor = self._cast.actors[said]
        others = self._others.get(said, [])
        is_wait = bool(then) and then is not None and isinstance(then[0].does, When)
        if is_wait and not others and said in self._spots:
            if self._is_at_point(said):
                modifiers = self._on_foot(said)
                return [Statement(actor.moves, modifiers=modifiers, length=math.inf)]
            return [*self.statements(said), *self.going(said)]
        found: list[Statement] = []
        at_once = [each for each in others if each.length == 0.0]
        calls = [each for statement in at_once for each in statement.calls]
        is_moved = any(each.action == "assign_position" for each in calls)
        if said in self._spots and not is_moved:
            spot, node = self._spots[said]
            if spot.yaw and not spot.turned:
                node.approximate("its heading at the start is that of its lane")
            found += [each.statement for each in Routes.moved(spot, actor)]
        if said in self._speeds:
            found.append(self._speeds[said])
        return [*found, *at_once]

    def ways(self) -> list[Statement]:
        """Return what takes entities along routes from the start on."""
        return [*self._ways.values(), *self._paths.values()]

    def has_way(self, said: str) -> bool:
        """Whether an entity has a route from the start on."""
        return said in self._ways or said in self._paths

    def has_path(self, said: str) -> bool:
        """Whether an entity is on a path from the start on, at any speed."""
        return said in self._paths

    def lasting(self, said: str) -> list[Statement]:
        """Return what an entity does from the start on, and goes on with."""
        others = [each for each in self._others.get(said, []) if each.length != 0.0]
        if not others:
            return []
        last = self.going(said)
        found = composed("serial", [*others, *last])
        found.length = math.inf if last else found.length
        return [found]

    def moves(self, said: str) -> bool:
        """Whether an entity has a speed at the start."""
        return said in self._speeds or self.has_way(said)

    def going(self, said: str) -> list[Statement]:
        """Return what lets an entity go on as it does where it would not do so by itself."""
        actor = self._cast.actors[said]
        return (
            []
            if said not in self._paths and (actor.is_free or said in self._ways)
            else [Statement(actor.goes_on, length=math.inf)]
        )


def _at_start(modifier: str) -> str:
    return f"{modifier[:-1]}, at: start)"
