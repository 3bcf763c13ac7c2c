"""Actions that put actors elsewhere, or on ways of their own."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.importing.cast import Actor
from osc2tx.importing.courses import SPARSE, sparse
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, TIME, literal
from osc2tx.importing.effects import BOTH, LATERAL, Effect, Reader
from osc2tx.importing.points import Spot
from osc2tx.importing.program import Statement
from osc2tx.xosc.player.shapes import CHORD


class Routes(Reader):
    """Reads teleports, routes and trajectories."""

    def teleport(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
        """Return what a teleport in the run does."""
        spot = self._places.spot(node.one("Position"), actor.name, at_start=False)
        self._lanes[said] = None
        self._offsets[said] = 0.0
        if spot is not None:
            if spot.yaw:
                node.approximate("it looks along its lane")
            yield from self.moved(spot, actor)

    @staticmethod
    def moved(spot: Spot, actor: Actor) -> Iterator[Effect]:
        """Return what puts an actor at a place at once."""
        call = f"{actor.name}.assign_position({spot.argument})"
        statement = Statement(call, modifiers=list(spot.modifiers), length=0.0)
        yield Effect(statement, actor.name, BOTH)

    def assigned(self, node: Node, said: str, actor: Actor) -> Statement | None:
        """Return what takes an actor along a route."""
        stops = self._places.courses.stops_of(node)
        body = self._places.bodies.get(said)
        if body is not None and body.place is not None:
            stops = [body.place, *stops]
        stops = [*stops[:1], *stops[-1:]]  # it takes the shortest way to the last one
        if len(stops) != 2 or not self._places.courses.is_way(stops):
            node.leave_out("no way along lanes leads to the end of the route")
            return None
        node.use_all()
        if self._places.courses.leads_on(*stops):
            return None  # it goes there by itself
        way = self._places.points.route(stops, actor.name)
        return Statement(f"{actor.verb}()", modifiers=[f"along({way})"])

    def effects(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
        """Return what a routing action does."""
        if node.tag == "AssignRouteAction":
            statement = self.assigned(node, said, actor)
            if statement is not None:
                yield Effect(statement, actor.name, frozenset((LATERAL,)))
            return
        if node.tag == "AcquirePositionAction":
            spot = self._places.spot(node.one("Position"), actor.name, at_start=False)
            if spot is None or not spot.odr_point:
                return
            node.approximate("the way to the place is that of the world")
            target = f"target_odr: {spot.odr_point}"
            yield Effect(
                Statement(f"{actor.name}.change_position({target}, on_road_network: true)"),
                actor.name,
                BOTH,
            )
            return
        if node.tag == "FollowTrajectoryAction":
            yield from self._trajectory(node, said, actor)
            return
        node.leave_out("the language has no such action")

    def _trajectory(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
        way = self._places.trajectory(node)
        if way is None:
            node.leave_out("the trajectory is not known before the run")
            return
        if any(text.startswith("$") for each in node.element.walk() for _, text in each.attributes):
            node.approximate("the trajectory is that of its nominal values")
        is_curve = not any(each.tag == "Polyline" for each in self._places.resolved(node).walk())
        timed = any(each.tag == "Timing" for each in node.element.walk())
        times, poses = [time for time, _ in way], [pose for _, pose in way]
        if is_curve:
            poses = poses if timed else sparse(poses)
            off = CHORD if timed else CHORD + SPARSE
            node.approximate(f"the curve is a polyline with chords {off:g} m from it at most")
        kind, on_road = "_odr_points", ", on_road_network: false"
        points = self._places.courses.corners(node)
        if len(points) != len(poses):
            points = self._places.courses.on_map(poses)
        if len(points) != len(poses):
            points = [self._places.points.pose(pose.x, pose.y, actor.name) for pose in poses]
            kind = on_road = ""
        offset = self._values.quantity(node, "initialDistanceOffset", LENGTH)
        node.use_all()
        listed = ", ".join(points)
        told = f"points: [{listed}], interpolation: straight_line{on_road}"
        length = None
        if timed:
            stamps = ", ".join(literal(round(each, 6), TIME) for each in times)
            told = f"{told}, time_stamps: [{stamps}]"
            made = f"trajectory(absolute: road.create_trajectory{kind}({told}))"
            length = times[-1] if times else None
        else:
            begin = f", start_offset: {offset.text}" if offset.is_open or offset.value else ""
            made = f"path(absolute: road.create_path{kind}({told}){begin})"
        slots = BOTH if timed else frozenset((LATERAL,))
        yield Effect(Statement(f"{actor.name}.replay_{made}", length=length), actor.name, slots)
        self._lanes[said] = None
