"""Initializes the run: chooses roads, places the cast, couples trailers, sets routes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.actors import Map, PhysicalObject
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.modifiers import (
    MapModifier,
    SetTrafficLightsControlFile,
)
from osc2tx_runtime.domain.placing.entries import Entries
from osc2tx_runtime.domain.placing.map_solver import MapSolver, Relation
from osc2tx_runtime.domain.placing.placer import Placer
from osc2tx_runtime.domain.placing.start_order import (
    ActorStart,
    couple,
    cycle_of,
    joined,
)
from osc2tx_runtime.domain.placing.start_room import Placed, StartRoom
from osc2tx_runtime.domain.signals.control_file import read_control_file
from osc2tx_runtime.domain.signals.stop_lines import TrafficLightStopLine
from osc2tx_runtime.errors import InputError, PlacementError, ScenarioError, SettingsError
from osc2tx_runtime.opendrive import LanePosition, MapError, Pose
from osc2tx_runtime.world.measuring.collision import box_of
from osc2tx_runtime.world.motion.towing import pose_behind
from osc2tx_runtime.world.state import ActorState

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.placement import Placement
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.language.declared import DeclaredObject


class ScenarioInitializer(StartRoom[ActorStart]):
    """Resolves placements in the order of their dependencies and fills the world.

    Args:
        context: The run: its world, actors and settings.
        map_objects: Roads, lanes and other elements that the scenario declares.
    """

    failure = PlacementError

    def __init__(
        self, context: ExecutionContext, map_objects: Sequence[DeclaredObject] = ()
    ) -> None:
        super().__init__(most_tries=len(context.world.map.spawn_points()))
        self._context = context
        self._map_objects = map_objects
        self._world = context.world
        self._placer = Placer(context.world)
        self._ways = context.entries.ways if isinstance(context.entries, Entries) else {}

    def run(self, placements: Sequence[Placement]) -> None:
        """Places every physical actor and sets the routes of those with a destination.

        Raises:
            PlacementError: A position does not exist, is occupied, or depends on itself.
            SettingsError: A destination is invalid.
        """
        self._fill_in_roads([p for p in placements if isinstance(p.actor, Map)])
        starts = self._starts([p for p in placements if not isinstance(p.actor, Map)])
        for start in starts:
            self._world.add(start.actor.spec())
        self._context.open_starts = frozenset(s.id for s in starts if not s.has_place)
        spawned = self._context.settings.spawn
        for start in starts:
            if start.rank == 2 and start.id in spawned:
                start.rank = 1
        self.fill(starts)
        self._set_routes()
        self._note_sizes()

    def _fill_in_roads(self, placements: Sequence[Placement]) -> None:
        """Chooses segments of the map for the declared roads and lanes.

        Raises:
            PlacementError: The map does not fulfil the constraints of the scenario.
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
        """Writes sizes that differ from those of the requested model to the trace."""
        for actor in self._context.actors.values():
            if not isinstance(actor, PhysicalObject) or actor.model is None:
                continue
            if actor.size_from not in ("model", "scenario"):
                self._context.trace.other(
                    4, "size", actor=actor.id, model=actor.model, source=actor.size_from
                )

    def _starts(self, placements: Sequence[Placement]) -> list[ActorStart]:
        """One start per physical actor, in the order of the cast."""
        written: dict[str, Placement] = {}
        spawned = self._context.settings.spawn
        placements = [p for p in placements if not (p.implied and p.actor.id in spawned)]
        for placement in sorted(placements, key=lambda each: each.implied):
            known = written.get(placement.actor.id)
            written[placement.actor.id] = placement if known is None else joined(known, placement)
        starts = []
        for actor in self._context.actors.values():
            given = written.get(actor.id)
            if isinstance(actor, PhysicalObject):
                modifiers = () if given is None else given.modifiers
                starts.append(ActorStart(actor, modifiers, given.source if given else actor.source))
            elif given is not None:
                raise PlacementError(f"{actor.id} cannot be placed anywhere", given.source)
        couple(starts)
        return starts

    def place(self, start: ActorStart) -> Placed:
        """Places one actor."""
        actor = start.actor
        way = self._ways.get(actor.id)
        if way is not None:
            self._world.place(actor.id, way.start, way.speed, way.heading, way.tilt)
            return self._placed_now(actor)
        if start.towed_by is not None:
            tow = self._world.state(start.towed_by.id)
            self._world.place(actor.id, pose_behind(tow, actor.shape), tow.v)
            self._world.attach(start.towed_by.id, actor.id)
            return self._placed_now(actor)
        try:
            initial = self._placer.initial_state(
                actor,
                start.modifiers,
                spawn=self._spawn(actor.id),
                taken_by=lambda place: self._taken_by(start, place),
                draws=self._context.random_for(f"{actor.id} start"),
            )
            other = self._occupant_at(actor, initial.at, initial.heading)
            if other is not None:
                raise PlacementError(f"{actor.id} overlaps {other} at its start")
            self._world.place(actor.id, *initial)
        except ScenarioError as error:
            error.source = error.source or start.source
            raise
        except MapError as error:
            raise PlacementError(f"{actor.id}: {error.message}", start.source) from error
        return self._placed_now(actor)

    def cycle_of(self, waiting: Sequence[ActorStart]) -> PlacementError:
        """Return the error for starts that depend on each other."""
        return cycle_of(waiting)

    def _placed_now(self, actor: PhysicalObject) -> Placed:
        state = self._world.state(actor.id)
        at = state.lane_position
        lane = None if at is None else LanePosition(at.road, at.lane, at.s)
        return Placed(box_of(state), lane)

    def _taken_by(self, start: ActorStart, place: LanePosition) -> str | None:
        """The actor that blocks a position, or that could not be placed beside it."""
        centre = place._replace(offset=0.0) if place.offset else place
        if self.was_tried(start, centre):
            return "another actor"
        return self._occupant_at(start.actor, place)

    def _spawn(self, actor_id: str) -> LanePosition | None:
        given = self._context.settings.spawn.get(actor_id)
        return None if given is None else LanePosition(*given)

    def _occupant_at(
        self, actor: PhysicalObject, at: LanePosition | Pose, heading: float | None = None
    ) -> str | None:
        """The actors placed so far."""
        pose = self._world.map.pose(at) if isinstance(at, LanePosition) else at
        if heading is not None:
            pose = Pose(pose.x, pose.y, pose.z, heading)
        box = box_of(ActorState(pose.x, pose.y, pose.z, pose.h, 0, 0, None, 0, actor.shape))
        return self.taken_by(box)

    # --- routes -------------------------------------------------------------------------------

    def _set_routes(self) -> None:
        for actor_id, way in self._ways.items():
            if isinstance(way.goal, LanePosition) and way.heading is None:
                self._world.set_route(actor_id, self._world.map.route_to(way.goal))
        for actor_id, goal in self._context.settings.destination.items():
            if actor_id not in self._placed:
                raise SettingsError(f"--destination {actor_id}={goal}: {actor_id} is not placed")
            place = self._goal(actor_id, goal)
            try:
                self._world.set_route(actor_id, self._world.map.route_to(place))
            except MapError as error:
                raise SettingsError(f"--destination {actor_id}={goal}: {error.message}") from error

    def _goal(self, actor_id: str, goal: str) -> LanePosition:
        if goal in self._placed:
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
