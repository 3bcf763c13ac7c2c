"""Rehearsals: runs in the embedded world that determine how actors enter.

Only a run determines when the first action of an actor begins, and where its references are then.
Rehearsals are repeated with the ways in of the last one until nothing changes: the run itself is
then identical to the last rehearsal.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import cos, hypot, inf, sin
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.domain.actors import MovableObject
from osc2tx_runtime.domain.modifiers import Along, AlongTrajectory, Modifier, OnPath, Position
from osc2tx_runtime.domain.placing.entries import Entries, WayIn, start_demands
from osc2tx_runtime.domain.placing.placer import Placer
from osc2tx_runtime.domain.placing.start_room import overlap_with
from osc2tx_runtime.domain.placing.ways_in import Arrival, way_in
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.opendrive import LanePosition, MapError, Pose, RoadMap
from osc2tx_runtime.world.measuring.collision import Box, box_of

if TYPE_CHECKING:
    from osc2tx_runtime.domain.placing.initial_state import InitialState
    from osc2tx_runtime.language.actions.base_action import BaseAction
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.world.state import ActorState

_MOST = 8  # rehearsals
_NEAR = 1e-3  # m, m/s
_FITS = 1.0  # m by which an actor may miss its position if nothing else has changed


class AllEnteredError(Exception):
    """Ends a rehearsal: all actors have entered."""


class Rehearsal(Entries):
    """Observes a rehearsal: when actors begin, and where they have to be then.

    It ends the run when all have begun.

    Args:
        ways: The ways in to try.
        waiting: Ids of the actors that enter.

    Attributes:
        implied: Implied starts of the first actions, by actor.
        arrivals: Required states of the actors, in the order in which they begin.
        missed: Distance (m) of an actor to its required position.
        errors: Reasons for positions that do not exist.
        boxes: The room that all actors take at each step.
    """

    def __init__(self, ways: dict[str, WayIn], waiting: Sequence[str]) -> None:
        super().__init__(ways)
        self._waiting = set(waiting)
        self.implied: Mapping[str, Sequence[Modifier]] = {}
        self.arrivals: dict[str, Arrival] = {}
        self.missed: dict[str, float] = {}
        self.errors: dict[str, PlacementError] = {}
        self.boxes: list[dict[str, Box]] = []

    def begin(self, context: ExecutionContext) -> None:
        """Register the actors at their start."""
        self._context = context
        self._note_boxes()

    def observe(self, step: int) -> None:
        """Register the states of a step.

        Raises:
            AllEnteredError: All actors have entered.
        """
        if not self._waiting:
            raise AllEnteredError
        self._note_boxes()

    def sampled(self, kind: str, values: Mapping[str, Any]) -> None:
        """Ignore values."""

    def _note_boxes(self) -> None:
        world = self._context.world
        self.boxes.append({actor: box_of(world.state(actor)) for actor in world.actors()})

    def begins(self, action: BaseAction) -> None:
        """Determine the required start of an actor's first action, and place it there."""
        actor = getattr(action, "actor", None)
        if isinstance(actor, MovableObject) and actor.id in self._waiting:
            self._waiting.discard(actor.id)
            demands = start_demands(action, self.implied.get(actor.id, ()))
            if demands:
                try:
                    self._arrive(actor, demands, action)
                except MapError as error:
                    text = f"{actor.id}: {error.message}"
                    self.errors[actor.id] = PlacementError(text, action.source)
                except PlacementError as error:
                    error.source = error.source or action.source
                    self.errors[actor.id] = error
        super().begins(action)

    def _arrive(
        self, actor: MovableObject, demands: Sequence[Modifier], action: BaseAction
    ) -> None:
        can_jump = isinstance(action, Action) and action.jumps_if_it_must
        world = self._context.world
        here = world.state(actor.id)
        fixed = any(isinstance(m, Position | Along | AlongTrajectory | OnPath) for m in demands)
        initial = self._placed(actor, demands, None if fixed else here)
        speed = initial.speed or 0.0
        self.arrivals[actor.id] = Arrival(
            *(actor.id, self._context.step, initial.at, speed, initial.heading, initial.tilt),
            *(fixed, actor.shape, world.limits(actor.id), actor.lane_bound),
            *(action.source, can_jump),
        )
        may_miss = not fixed or (can_jump and actor.id not in self.ways)
        self.missed[actor.id] = 0.0 if may_miss else _missed(world.map, here, initial.at)
        world.assign(actor.id, at=initial.at, speed=speed, heading=initial.heading)

    def _placed(
        self, actor: MovableObject, demands: Sequence[Modifier], here: ActorState | None
    ) -> InitialState:
        """Return the required position, among the others in their present states."""
        world, state = self._context.world, self._context.world.state(actor.id)

        def taken_by(place: LanePosition) -> str | None:
            pose = world.map.pose(place)
            box = box_of(state._replace(x=pose.x, y=pose.y, z=pose.z, h=pose.h))
            others = {
                each: box_of(world.state(each)) for each in world.actors() if each != actor.id
            }
            return overlap_with(box, others)

        draws = self._context.random_for(f"{actor.id} start")
        return Placer(world).initial_state(actor, demands, here, taken_by=taken_by, draws=draws)


def _missed(road_map: RoadMap, here: ActorState, there: LanePosition | Pose) -> float:
    """Return the distance (m) to the required position; infinite if it is not ahead or behind."""
    pose = road_map.pose(there) if isinstance(there, LanePosition) else there
    dx, dy = pose.x - here.x, pose.y - here.y
    ahead = dx * cos(pose.h) + dy * sin(pose.h)
    aside = dy * cos(pose.h) - dx * sin(pose.h)
    if abs(ahead) < _FITS and abs(aside) < _NEAR:
        return ahead  # both may count from different lanes
    if isinstance(there, LanePosition) and here.lane_position is not None:
        left = road_map.route_distance(here.lane_position, there)
        beside = abs(here.lane_position.offset - there.offset) > _NEAR
        return inf if left is None or beside else left
    return hypot(dx, dy)


def ways_in(
    play: Callable[[Rehearsal], None], actors: Sequence[str], road_map: RoadMap, dt: float
) -> dict[str, WayIn]:
    """Return the ways in of the actors that enter in the run.

    Args:
        play: Plays a rehearsal.
        actors: Ids of the actors that enter.
        road_map: The map.
        dt: Length of a step (s).

    Raises:
        PlacementError: An actor has no way in.
    """
    ways: dict[str, WayIn] = {}
    before: dict[str, Arrival] = {}
    short: dict[str, float] = {}  # m by which the closed form of a way in is too short
    for attempt in range(_MOST):
        rehearsal = Rehearsal(ways, actors)
        play(rehearsal)
        found, errors = rehearsal.arrivals, rehearsal.errors
        if errors and attempt:  # at first the positions of the other entering actors are unknown
            raise next(iter(errors.values()))
        if not errors and _alike(found, before, road_map):
            missed = rehearsal.missed
            if all(abs(distance) < _NEAR for distance in missed.values()):
                return ways
            for actor, distance in missed.items():
                short[actor] = short.get(actor, 0.0) + (distance if abs(distance) < _FITS else 0.0)
        for actor, arrival in found.items():
            for boxes in rehearsal.boxes[: arrival.step + 1]:
                boxes.pop(actor, None)  # until then its way in determines its position
        searched = {
            actor: way_in(arrival, road_map, rehearsal.boxes, dt, short.get(actor, 0.0))
            for actor, arrival in found.items()
        }
        ways = {actor: way for actor, way in searched.items() if way is not None}
        before = found
    names = ", ".join(before)
    raise PlacementError(
        f"the start of {names} depends on the motion that leads to it",
        next((arrival.source for arrival in before.values()), None),
    )


def _alike(found: dict[str, Arrival], before: dict[str, Arrival], road_map: RoadMap) -> bool:
    """Return whether the same actors arrive at the same time and position in two rehearsals."""
    return found.keys() == before.keys() and all(
        arrival.is_like(before[actor], road_map) for actor, arrival in found.items()
    )
