"""Initializes the run: chooses roads, places the cast, couples trailers, sets routes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.actors import Map, PhysicalObject
from osc2tx_runtime.domain.modifiers import (
    MapModifier,
    SetTrafficLightsControlFile,
)
from osc2tx_runtime.domain.placing.map_solver import MapSolver, Relation
from osc2tx_runtime.domain.placing.placer import Placer
from osc2tx_runtime.domain.placing.start_order import (
    Start,
    couple,
    cycle_of,
    is_behind,
    joined,
)
from osc2tx_runtime.domain.routes.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.signals.control_file import read_control_file
from osc2tx_runtime.domain.signals.stop_lines import TrafficLightStopLine
from osc2tx_runtime.errors import InputError, PlacementError, ScenarioError, SettingsError
from osc2tx_runtime.opendrive import LanePosition, MapError, Pose
from osc2tx_runtime.world.collision import Box, box_of, overlapping
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.towing import pose_behind

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.language.declared import DeclaredObject
    from osc2tx_runtime.language.placement import Placement

__all__ = ["ScenarioInitializer"]


class ScenarioInitializer:
    """Resolves placements in the order of their dependencies and fills the world.

    Args:
        context: The run: its world, actors and settings.
        map_objects: Roads, lanes and the like that the scenario declares.
    """

    def __init__(
        self, context: ExecutionContext, map_objects: Sequence[DeclaredObject] = ()
    ) -> None:
        self._context = context
        self._map_objects = map_objects
        self._world = context.world
        self._placer = Placer(context.world)
        self._boxes: dict[str, Box] = {}
        # Places that left no room for those that start relative to it.
        self._tried: dict[str, list[LanePosition | None]] = {}

    def run(self, placements: Sequence[Placement]) -> None:
        """Places every physical actor and sets the routes of those with a destination.

        Raises:
            PlacementError: A place does not exist, is taken, or depends on itself.
            SettingsError: A destination is none.
        """
        self._fill_in_roads([p for p in placements if isinstance(p.actor, Map)])
        waiting = self._starts([p for p in placements if not isinstance(p.actor, Map)])
        for start in waiting:
            self._world.add(start.actor.spec())
        spawned = self._context.settings.spawn
        for start in waiting:
            if start.rank == 2 and start.actor.id in spawned:
                start.rank = 1
        placed: list[Start] = []
        while waiting:
            ready = [s for s in waiting if all(r.id in self._boxes for r in s.references)]
            if not ready:
                raise cycle_of(waiting)
            start = min(ready, key=lambda s: s.rank)  # the first of equals: order of the cast
            waiting.remove(start)
            placed.append(start)
            try:
                self._place(start)
            except PlacementError:
                if not self._makes_room(placed):
                    raise
        self._set_routes()
        self._note_sizes()

    def _fill_in_roads(self, placements: Sequence[Placement]) -> None:
        """Chooses segments of the map for the roads and lanes that are declared.

        Raises:
            PlacementError: The map is not as the scenario wants it.
        """
        for actor in self._context.actors.values():
            if isinstance(actor, Map) and actor.required_rule not in (None, actor.driving_rule):
                raise PlacementError(
                    f"map {self._world.map.name} has {actor.driving_rule}, not"
                    f" {actor.required_rule}",
                    actor.source,
                )
        relations = [
            Relation(modifier, placement.source)
            for placement in placements
            for modifier in placement.modifiers
            if isinstance(modifier, MapModifier)
        ]
        for placement in placements:
            for modifier in placement.modifiers:
                if isinstance(modifier, SetTrafficLightsControlFile):
                    self._read_cycles(placement, modifier.file)
        lines = [each for each in self._map_objects if isinstance(each, TrafficLightStopLine)]
        parts = [
            each
            for each in self._map_objects
            if isinstance(each, RoadPart) and not isinstance(each, TrafficLightStopLine)
        ]
        if parts or relations:
            MapSolver(self._world.map, parts, relations).solve()
        for line in lines:
            line.settle(self._world.map, self._world.signals)

    def _read_cycles(self, placement: Placement, file: str) -> None:
        assert isinstance(placement.actor, Map)
        try:
            cycles = read_control_file(file, self._context.settings.map_path)
        except InputError as error:
            error.source = placement.source
            raise
        placement.actor.traffic_light_control.extend(cycles)

    def _note_sizes(self) -> None:
        """Says in the trace which sizes are not those of the model that was asked for."""
        for actor in self._context.actors.values():
            if not isinstance(actor, PhysicalObject) or actor.model is None:
                continue
            if actor.size_from not in ("model", "scenario"):
                self._context.trace.other(
                    4, "size", actor=actor.id, model=actor.model, source=actor.size_from
                )

    def _starts(self, placements: Sequence[Placement]) -> list[Start]:
        """One start per physical actor, in the order of the cast."""
        written: dict[str, Placement] = {}
        for placement in placements:
            known = written.get(placement.actor.id)
            written[placement.actor.id] = placement if known is None else joined(known, placement)
        starts = []
        for actor in self._context.actors.values():
            given = written.get(actor.id)
            if isinstance(actor, PhysicalObject):
                modifiers = () if given is None else given.modifiers
                starts.append(Start(actor, modifiers, given.source if given else actor.source))
            elif given is not None:
                raise PlacementError(f"{actor.id} cannot be placed anywhere", given.source)
        couple(starts)
        return starts

    def _place(self, start: Start) -> None:
        actor = start.actor
        if start.towed_by is not None:
            tow = self._world.state(start.towed_by.id)
            self._world.place(actor.id, pose_behind(tow, actor.shape), tow.v)
            self._world.attach(start.towed_by.id, actor.id)
            self._boxes[actor.id] = box_of(self._world.state(actor.id))
            return
        try:
            initial = self._placer.initial_state(
                actor,
                start.modifiers,
                spawn=self._spawn(actor.id),
                is_free=lambda place: self._is_free(actor, place),
                draws=self._context.random_for(f"{actor.id} start"),
            )
            other = self._taken_by(actor, initial.at, initial.heading)
            if other is not None:
                raise PlacementError(f"{actor.id} overlaps {other} at its start")
            self._world.place(actor.id, *initial)
        except ScenarioError as error:
            error.source = error.source or start.source
            raise
        except MapError as error:
            raise PlacementError(f"{actor.id}: {error.message}", start.source) from error
        self._boxes[actor.id] = box_of(self._world.state(actor.id))

    def _makes_room(self, placed: Sequence[Start]) -> bool:
        """Put the last actor, by moving one whose place is open and that it starts relative to.

        Those that start relative to that one move with it.

        Args:
            placed: Those that are placed, in that order; the last one does not fit.

        Returns:
            Whether there is such a place.
        """
        *_, start = placed
        spawned = self._context.settings.spawn
        movable = (each for each in placed if each.is_open and each.actor.id not in spawned)
        anchor = next((each for each in movable if is_behind(start, each, placed)), None)
        if anchor is None:
            return False
        moved = [each for each in placed if each is anchor or is_behind(each, anchor, placed)]
        tried = self._tried.setdefault(anchor.actor.id, [])
        for _ in self._world.map.spawn_points():
            tried.append(self._centre_of(anchor))
            for each in moved:
                self._boxes.pop(each.actor.id, None)
            try:
                self._place(anchor)
            except PlacementError:
                return False
            if self._centre_of(anchor) in tried:
                return False
            try:
                for each in moved[1:]:
                    self._place(each)
            except PlacementError:
                continue
            return True
        return False

    def _centre_of(self, placed: Start) -> LanePosition | None:
        """Where on the centre of its lane an actor is; None off the lanes."""
        at = self._world.state(placed.actor.id).lane_position
        return None if at is None else LanePosition(at.road, at.lane, at.s)

    def _is_free(self, actor: PhysicalObject, place: LanePosition) -> bool:
        """Whether nobody is at a place, and it was not tried in vain."""
        if place in self._tried.get(actor.id, ()):
            return False
        return self._taken_by(actor, place) is None

    def _spawn(self, actor_id: str) -> LanePosition | None:
        given = self._context.settings.spawn.get(actor_id)
        return None if given is None else LanePosition(*given)

    def _taken_by(
        self, actor: PhysicalObject, at: LanePosition | Pose, heading: float | None = None
    ) -> str | None:
        """Who stands there already."""
        pose = self._world.map.pose(at) if isinstance(at, LanePosition) else at
        if heading is not None:
            pose = Pose(pose.x, pose.y, pose.z, heading)
        box = box_of(ActorState(pose.x, pose.y, pose.z, pose.h, 0, 0, None, 0, actor.shape))
        for other, taken in self._boxes.items():
            if overlapping(box, taken):
                return other
        return None

    # --- routes -------------------------------------------------------------------------------

    def _set_routes(self) -> None:
        for actor_id, goal in self._context.settings.destination.items():
            if actor_id not in self._boxes:
                raise SettingsError(f"--destination {actor_id}={goal}: {actor_id} is not placed")
            place = self._goal(actor_id, goal)
            try:
                self._world.set_route(actor_id, self._world.map.route_to(place))
            except MapError as error:
                raise SettingsError(f"--destination {actor_id}={goal}: {error.message}") from error

    def _goal(self, actor_id: str, goal: str) -> LanePosition:
        if goal in self._boxes:
            state = self._world.state(goal)
            on = self._world.map.locate(state.x, state.y, state.z)
            if on is None:
                raise SettingsError(f"--destination {actor_id}={goal}: {goal} is not on a road")
            return on
        parts = goal.split(",")
        try:
            road, lane, s = parts
            return LanePosition(road.strip(), int(lane), float(s))
        except ValueError:
            raise SettingsError(
                f"--destination {actor_id}={goal}: write a placed actor or ROAD,LANE,S"
            ) from None
