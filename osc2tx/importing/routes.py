"""Actions that put actors elsewhere, or on ways of their own."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from osc2tx.importing.cast import Actor
from osc2tx.importing.courses import SPARSE, of_curve
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, TIME, Quantity, literal
from osc2tx.importing.effects import BOTH, LATERAL, Effect, Reader
from osc2tx.importing.points import Spot
from osc2tx.importing.statements import Call, Statement, call
from osc2tx.xosc import Element
from osc2tx.xosc import elements as xml
from osc2tx.xosc.player.bodies import Body, Pose
from osc2tx.xosc.player.shapes import CHORD, Way
from osc2tx_shared.classes import replace

ORIGIN = Pose(0.0, 0.0, 0.0)
REPLAYS = ("replay_path", "replay_trajectory")
"""Actions of an actor that is on a course at once, wherever it was before."""


class Routes(Reader):
    """Reads teleports, routes and trajectories."""

    def teleport(self, node: Node, actor: Actor) -> Iterator[Effect]:
        """Return what a teleport in the run does."""
        spot = self._places.spot(node.one("Position"), actor.name, at_start=False)
        self._lanes[actor.said] = None
        self._offsets[actor.said] = 0.0
        if spot is not None:
            if spot.yaw and not spot.turned:
                node.approximate("its heading is that of its lane")
            yield from self.moved(spot, actor)

    @staticmethod
    def moved(spot: Spot, actor: Actor) -> Iterator[Effect]:
        """Return what puts an actor at a place at once."""
        put = spot.assigned_to(actor.name)
        yield Effect(Statement(put, modifiers=spot.modifiers, length=0.0), actor.name, BOTH)
        if spot.turned:
            turn = call(actor.name, "assign_orientation", spot.turned)
            yield Effect(Statement(turn, length=0.0), actor.name, BOTH)

    def assigned(self, node: Node, actor: Actor) -> Statement | None:
        """Return what takes an actor along a route."""
        stops = self._places.courses.stops_of(node)
        body = self._body(actor)
        if body is not None and body.place is not None:
            stops = [body.place, *stops]
        stops = [*stops[:1], *stops[-1:]]  # it takes the shortest way to the last one
        if len(stops) != 2 or not self._places.courses.is_way(stops):
            node.leave_out("no route along lanes leads to its end")
            return None
        node.use_all()
        stops[1] = self._places.courses.reached(*stops)
        if self._places.courses.leads_on(*stops):
            return None  # it goes there by itself
        way = self._places.points.route(stops, actor.name)
        return Statement(actor.moves, modifiers=[f"along({way})"])

    def effects(self, node: Node, actor: Actor, *, at_start: bool) -> Iterator[Effect]:
        """Return what a routing action does."""
        if node.tag == "AssignRouteAction":
            statement = self.assigned(node, actor)
            if statement is not None:
                yield Effect(statement, actor.name, frozenset((LATERAL,)))
            return
        if node.tag == "AcquirePositionAction":
            spot = self._places.spot(node.one("Position"), actor.name, at_start=False)
            if spot is None or not spot.odr_point:
                return
            node.approximate("the path to the position is up to the simulator")
            told = {"target_odr": spot.odr_point, "on_road_network": "true"}
            yield Effect(Statement(call(actor.name, "change_position", **told)), actor.name, BOTH)
            return
        if node.tag == "FollowTrajectoryAction":
            yield from self._trajectory(node, actor, at_start=at_start)
            return
        node.leave_out("the language has no such action")

    def _trajectory(self, node: Node, actor: Actor, *, at_start: bool) -> Iterator[Effect]:
        timed, said = _timing(node) is not None, actor.said
        way, own = self._places.trajectory(node), self._places.courses.offsets(node, said)
        is_from_actor = way is None
        way = self._places.trajectory(node, ORIGIN) if way is None else way
        if way is None:
            node.leave_out("the trajectory is not known before the run")
            return
        way = self._since_its_start(node, self._thinned(node, way, timed=timed))
        reference, on_road = said, list[str]()
        if is_from_actor:
            own = [(x, y) for _, (x, y, _) in way]
        elif not at_start and (not own or None in own) and own[:1] != [(0.0, 0.0)]:
            reference = self._reference(node) or ""
            if reference:
                body = self._places.bodies[reference]
                if reference not in self._lanes:  # it has been in its lane since the start
                    on_road = self._places.courses.along_road(node, body)
                own = [] if on_road else self._seen_from(body, way)
        if self._places.courses.is_nominal(node):
            node.approximate("the trajectory is that of its nominal values")
        stamps = [literal(round(time, 6), TIME) for time, _ in way] if timed else []
        offset = self._values.quantity(node, "initialDistanceOffset", LENGTH)
        from_here = [each for each in own if each is not None]
        is_whole = not offset.is_open and offset.value == 0.0
        if on_road and is_whole:
            made = self._places.points.relative_on_road(_shape(stamps), on_road, stamps, actor.name)
            follows = self._from_there(made, stamps, actor, reference, "road_relative")
        elif own and len(from_here) == len(own) and is_whole:
            made = self._places.points.relative(_shape(stamps), from_here, stamps, actor.name)
            beside = reference or said
            follows = self._from_there(made, stamps, actor, beside, "object_relative")
        else:
            # behind a corner where the actor is, the way there is its matter
            comes_to_it = own[:1] == [(0.0, 0.0)] and len(own) == len(way) and not timed
            poses = [pose for _, pose in way][int(comes_to_it and len(own) > 2) :]
            follows = self._absolute(node, poses, stamps, offset, actor)
            if len(poses) < len(way):
                follows = replace(follows, action=f"follow_{_shape(stamps)}")
        self._note(node, timed=timed)
        length = way[-1][0] if timed else None
        slots = BOTH if timed else frozenset((LATERAL,))
        yield Effect(Statement(follows, length=length), actor.name, slots)
        self._lanes[said] = None

    def _since_its_start(self, node: Node, way: Way) -> Way:
        """Return the corners with times since the trajectory begins, not the run."""
        timing = _timing(node)
        if timing is None:
            return way
        scale = self._values.nominal(node.other(timing), "scale", 1.0)
        offset = self._values.nominal(node.other(timing), "offset")
        begin = self._readings.begin
        if begin > 0.0 and timing.get("domainAbsoluteRelative") == "absolute":
            node.approximate(f"it is taken to begin after {begin:g} s, as far as times say it")
            offset -= begin
        return [(time * scale + offset, pose) for time, pose in way]

    @staticmethod
    def _note(node: Node, *, timed: bool) -> None:
        """Note what of a trajectory has no part in where it leads, and take the rest."""
        for trajectory in map(node.other, node.element.below(xml.Trajectory)):
            trajectory.idle("nothing refers to it by its name", "name")
            if trajectory.is_true("closed"):
                trajectory.approximate("a closed trajectory is followed once")
            else:
                trajectory.idle("it is not closed", "closed")
        for vertex in () if timed else map(node.other, node.element.below(xml.Vertex)):
            vertex.idle("times do not count without `Timing`", "time")
        node.use_all()

    def _thinned(self, node: Node, way: Way, *, timed: bool) -> Way:
        """Return the corners of a trajectory; of a curve as many as it needs."""
        if any(each.tag == "Polyline" for each in self._places.resolved(node).walk()):
            return way
        off = CHORD if timed else CHORD + SPARSE
        node.approximate(f"the curve is a polyline with chords {off:g} m from it at most")
        return way if timed else of_curve(way)

    def _reference(self, node: Node) -> str | None:
        """Return the entity beside which all of a trajectory leads, in the run."""
        walk = self._places.resolved(node).walk()
        positions = [each for each in walk if each.tag in ("Position", "PositionStart")]
        refs = [each.inner.get("entityRef") or "" for each in positions]
        named = sorted(set(refs) - {""})
        body = self._places.bodies.get(named[0]) if len(named) == 1 and all(refs) else None
        if body is not None and body.pose is not None and named[0] in self._actors:
            node.approximate(f"it leads where it would from the place at which {named[0]} starts")
            return named[0]
        if named:
            node.approximate(f"the places beside {' and '.join(named)} are those at the start")
        return None

    @staticmethod
    def _seen_from(body: Body, way: Way) -> list[tuple[float, float] | None]:
        """Return how far (m) corners are ahead and left of an entity."""
        x, y, h = body.here
        cos, sin = math.cos(h), math.sin(h)
        seen = [(pose.x - x, pose.y - y) for _, pose in way]
        return [(round(dx * cos + dy * sin, 6), round(dy * cos - dx * sin, 6)) for dx, dy in seen]

    def _from_there(
        self, made: str, stamps: Sequence[str], actor: Actor, reference: str, transform: str
    ) -> Call:
        """Return the invocation for a trajectory from where its actor, or another one, is."""
        told = {"relative": made, "reference": self._actors[reference].name}
        return call(actor.name, f"replay_{_shape(stamps)}", **told, transform=transform)

    def _absolute(
        self,
        node: Node,
        poses: Sequence[Pose],
        stamps: Sequence[str],
        offset: Quantity,
        actor: Actor,
    ) -> Call:
        """Return the invocation for a trajectory in the world."""
        kind, on_road = "_odr_points", ", on_road_network: false"
        points = self._places.courses.corners(node)
        if len(points) != len(poses):
            points = self._places.courses.on_map(poses)
        if len(points) != len(poses):
            points = [self._places.points.pose(pose.x, pose.y, actor.name) for pose in poses]
            kind = on_road = ""
        told = f"points: [{', '.join(points)}], interpolation: straight_line{on_road}"
        if stamps:
            told = f"{told}, time_stamps: [{', '.join(stamps)}]"
            way = f"road.create_trajectory{kind}({told})"
            return call(actor.name, "replay_trajectory", absolute=way)
        begin = {"start_offset": offset.text} if offset.is_open or offset.value else {}
        way = f"road.create_path{kind}({told})"
        return call(actor.name, "replay_path", absolute=way, **begin)


def _timing(node: Node) -> Element | None:
    """Return what relates the times of a trajectory to those of the run."""
    reference = node.element.find(xml.TimeReference)
    return None if reference is None else reference.find(xml.Timing)


def _shape(stamps: Sequence[str]) -> str:
    return "trajectory" if stamps else "path"
