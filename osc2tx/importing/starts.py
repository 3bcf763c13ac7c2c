"""How the actors of a document begin."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import field

from osc2tx.importing.actions import Actions
from osc2tx.importing.cast import Actor, Cast
from osc2tx.importing.cursor import Node
from osc2tx.importing.effects import LATERAL, Effect
from osc2tx.importing.points import Spot
from osc2tx.importing.routes import REPLAYS, Routes
from osc2tx.importing.statements import Call, Statement, When, call, composed
from osc2tx.xosc.element import Unresolved
from osc2tx_shared.classes import dataclass

ROOM = 30.0  # m: so far apart are actors that do not touch


@dataclass
class Start:
    """How an entity begins.

    Attributes:
        spot: Where it is put, and the element that says that; `None`: nowhere.
        speed: What gives it its speed; `None`: it is at rest.
        route: What takes it along a route.
        path: What takes it along a path, at any speed.
        others: What else it does.
        references: The entities to which its actions refer.
    """

    spot: tuple[Spot, Node] | None = None
    speed: Statement | None = None
    route: Statement | None = None
    path: Statement | None = None
    others: list[Statement] = field(default_factory=list)
    references: set[str] = field(default_factory=set)

    @property
    def has_way(self) -> bool:
        """Whether the entity has a route or a path from the start on."""
        return self.route is not None or self.path is not None

    @property
    def is_at_point(self) -> bool:
        """Whether it is put at a point of the world."""
        return self.spot is not None and bool(self.spot[0].position)

    @property
    def is_placed(self) -> bool:
        """Whether it is put anywhere, or does anything."""
        return self.spot is not None or self.path is not None or bool(self.others)

    @property
    def moves(self) -> bool:
        """Whether it has a speed."""
        return self.speed is not None or self.has_way

    @property
    def on_foot(self) -> list[str]:
        """The modifiers of an actor that begins at a point, with a heading of its own."""
        assert self.spot is not None
        spot, _ = self.spot
        modifiers = [f"position(at_point: {spot.position}, project_on_route: false, at: start)"]
        if spot.yaw:
            modifiers.append(f"{spot.yaw[:-1]}, at: start)")
        if self.speed is not None:
            assert isinstance(self.speed.does, Call)
            modifiers.append(f"speed({self.speed.does.get('')})")
        return modifiers


class Starts:
    """How the actors of a document begin.

    Attributes:
        world: What concerns no actor.
        of: How each entity begins.
    """

    def __init__(self, storyboard: Node, actions: Actions, cast: Cast) -> None:
        self._cast, self._actions = cast, actions
        self._places, self._values = actions.readings.places, actions.readings.values
        self.world: list[Statement] = []
        self.of: defaultdict[str, Start] = defaultdict(Start)
        init = storyboard.find("Init")
        for holder in () if init is None else init.children("Actions"):
            for node in holder.children():
                if node.tag == "Private":
                    self._private(node)
                elif node.tag == "GlobalAction":
                    effects = actions.effects(node, (), at_start=True)
                    self.world += [each.statement for each in effects]
                else:
                    node.leave_out("actions of a user are for one tool")

    def _private(self, node: Node) -> None:
        said = self._values.text(node, "entityRef")
        if said not in self._cast.actors:
            node.leave_out(f"there is no entity {said}")
            return
        start, actor = self.of[said], self._cast.actors[said]
        for action in node.children("PrivateAction"):
            inner = next(action.children(), None)
            if inner is None:
                action.leave_out("it is empty")
                continue
            refs = (each.get("entityRef") for each in inner.element.walk())
            start.references.update(ref for ref in refs if ref is not None)
            if inner.tag == "TeleportAction":
                self._teleport(inner, start, actor)
            elif inner.tag == "RoutingAction" and inner.inner.tag == "AssignRouteAction":
                way = self._actions.routes.assigned(inner.inner, actor)
                start.route = way or start.route
            else:
                for effect in self._actions.effects(action, (said,), at_start=True):
                    self._take(effect, inner, start)

    def _teleport(self, node: Node, start: Start, actor: Actor) -> None:
        try:
            spot = self._places.spot(node.one("Position"), actor.name, at_start=True)
        except Unresolved as error:
            node.leave_out(error.reason)
            return
        if spot is not None:
            start.spot = (spot, node)
            if start.path is not None:
                node.approximate("the trajectory before it ends with it")
                start.path = None

    def _take(self, effect: Effect, node: Node, start: Start) -> None:
        """Take what an action does; an entity is at rest by itself."""
        statement = effect.statement
        verb = statement.does.action if isinstance(statement.does, Call) else ""
        if verb in REPLAYS and node.tag == "RoutingAction":
            self._begin_on(node, start)
        if effect.slots == {LATERAL} and statement.length is None:
            start.path = statement
        elif verb == "assign_speed":
            is_rest = [each.get("") for each in statement.calls] == ["0mps"]
            start.speed = None if is_rest else statement
        else:
            start.others.append(statement)

    def _begin_on(self, node: Node, start: Start) -> None:
        """Forget where an entity is put that a trajectory puts elsewhere at once."""
        way, spot = self._places.trajectory(node), start.spot
        put = None if spot is None else self._places.coordinates(spot[1].one("Position"))
        if way and spot is not None and put is not None and way[0][0] == 0.0:
            if math.dist(way[0][1][:2], put) < ROOM:
                return
            spot[1].idle("its trajectory begins elsewhere at the same time")
            start.spot = None

    def order(self, said: Sequence[str]) -> list[str]:
        """Return entities with those that others refer to first."""
        left, found = list(said), list[str]()
        while left:
            ready = [
                each for each in left if not (self.of[each].references - {each}) & set(left)
            ] or left[:1]
            found += ready
            left = [each for each in left if each not in ready]
        return found

    def starts(self, placed: Collection[str]) -> dict[str, tuple[str, int, float]]:
        """Return the lanes in which actors are put, with the s (m) along their roads.

        Of those that would be too near to others only the first one counts.

        Args:
            placed: Actors that the scenario puts beside others later.
        """
        taken: dict[str, tuple[str, int, float]] = {}
        for said, start in self.of.items():
            actor, spot = self._cast.actors[said], start.spot
            body = self._places.bodies.get(said)
            if spot is None or not spot[0].odr_point or body is None or body.place is None:
                continue
            near = (s for road, _, s in taken.values() if road == body.place.road)
            if actor.name not in placed and all(abs(s - body.place.s) > ROOM for s in near):
                taken[actor.name] = (body.place.road, body.place.lane, body.place.s)
        return taken

    def turns_alone(self, said: str) -> bool:
        """Whether an entity has a heading of its own, and no other one begins beside it."""
        spot = self.of[said].spot
        is_seen = any(said in each.references for name, each in self.of.items() if name != said)
        return spot is not None and bool(spot[0].yaw) and not is_seen

    def going_on(self, said: str) -> list[Statement]:
        """Return how an actor begins and goes on."""
        actor, start = self._cast.actors[said], self.of[said]
        if start.is_at_point and not start.others:
            does = actor.moves if start.moves else call(actor.name, "remain_stationary")
            return [Statement(does, modifiers=start.on_foot, length=math.inf)]
        return [*self.statements(said), *(self.lasting(said) or self.going(said))]

    def statements(self, said: str, then: Sequence[Statement] = ()) -> list[Statement]:
        """Return how an actor begins, at once.

        Args:
            said: The entity.
            then: What follows: a first wait in it ends the way up to there.
        """
        actor, start = self._cast.actors[said], self.of[said]
        is_wait = bool(then) and isinstance(then[0].does, When)
        if is_wait and not start.others and start.spot is not None:
            if start.is_at_point:
                return [Statement(actor.moves, modifiers=start.on_foot, length=math.inf)]
            return [*self.statements(said), *self.going(said)]
        found: list[Statement] = []
        at_once = [each for each in start.others if each.length == 0.0]
        calls = [each for statement in at_once for each in statement.calls]
        is_moved = any(each.action == "assign_position" for each in calls)
        if start.spot is not None and not is_moved:
            spot, node = start.spot
            if spot.yaw and not spot.turned:
                node.approximate("its heading at the start is that of its lane")
            found += [each.statement for each in Routes.moved(spot, actor)]
        return [*found, *([] if start.speed is None else [start.speed]), *at_once]

    def ways(self) -> list[Statement]:
        """Return what takes entities along routes from the start on."""
        starts = self.of.values()
        ways = [*(each.route for each in starts), *(each.path for each in starts)]
        return [each for each in ways if each is not None]

    def lasting(self, said: str) -> list[Statement]:
        """Return what an entity does from the start on, and goes on with."""
        others = [each for each in self.of[said].others if each.length != 0.0]
        if not others:
            return []
        last = self.going(said)
        found = composed("serial", [*others, *last])
        found.length = math.inf if last else found.length
        return [found]

    def going(self, said: str) -> list[Statement]:
        """Return what lets an entity go on as it does where it would not do so by itself."""
        actor, start = self._cast.actors[said], self.of[said]
        if start.path is None and (actor.is_free or start.route is not None):
            return []
        return [Statement(actor.goes_on, length=math.inf)]
