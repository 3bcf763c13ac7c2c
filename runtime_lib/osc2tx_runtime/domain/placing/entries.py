"""Actors that enter: which they are, what their first action requires, and their motion until then.

The motion of an actor before its first action is free (DSL 7.6.2.4.2). If that action begins later
and states the position or speed at its start, the actor enters until then: the node `Enter`
represents this motion in the tree. ADR 10 has the reasons.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.actors import MovableObject
from osc2tx_runtime.domain.modifiers import (
    Along,
    AlongTrajectory,
    Modifier,
    MovementModifier,
    PhysicalMovement,
    Position,
)
from osc2tx_runtime.domain.modifiers.groups import PLACES
from osc2tx_runtime.domain.paths.path_values import Path, Trajectory
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.placing.start_order import with_implied
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.tree.base import RUNNING, SUCCESS, Behaviour, Leaf, Status
from osc2tx_runtime.language.tree.invocation import started_at_once
from osc2tx_runtime.language.tree.parallel import Parallel
from osc2tx_runtime.world.commands import SpeedChange
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt
from osc2tx_runtime.world.protocol import LONGITUDINAL
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.base_action import BaseAction
    from osc2tx_runtime.opendrive import LanePosition, Pose

ENTER = "enter"
"""Name of the motion of an actor that enters, in traces; its line is that of the first action."""


@dataclass(frozen=True, slots=True)
class WayIn:
    """Motion of an actor until its first action: a constant speed, and one change at the end.

    Attributes:
        start: Its start.
        goal: Its pose when its first action begins.
        arrives: Step at which its first action begins.
        speed: At the start (m/s).
        target: At the goal (m/s).
        changes: Step at which the speed change begins.
        changed: Step at which the speed change ends.
        heading: At the start (rad), off the lanes or opposite to the lane.
        tilt: Pitch and roll.
    """

    start: LanePosition | Pose
    goal: LanePosition | Pose
    arrives: int
    speed: float
    target: float
    changes: int
    changed: int
    heading: float | None = None
    tilt: Tilt = LEVEL

    def covered(self, step: int, dt: float) -> float:
        """Return the distance (m) from the start at a step."""
        before, after = min(step, self.changes), max(0, step - self.changed)
        changing = step - before - after
        whole = self.changed - self.changes
        share = changing / whole if whole else 0.0
        mean = self.speed + 0.5 * share * (self.target - self.speed)
        return (self.speed * before + mean * changing + self.target * after) * dt


class Entries:
    """The ways in of a run, and which actors have begun their first action.

    Args:
        ways: By actor.
    """

    def __init__(self, ways: dict[str, WayIn] | None = None) -> None:
        self.ways = ways or {}
        self._begun: set[str] = set()

    def begins(self, action: BaseAction) -> None:
        """Note that an action begins."""
        if action.actor_id is not None and action.actor_id not in self._begun:
            self._begun.add(action.actor_id)
            action.context.request_pass()

    def has_begun(self, actor: str) -> bool:
        """Return whether an actor has begun its first action."""
        return actor in self._begun


class Enter(Leaf):
    """Moves an actor to the start of its first action, and ends then.

    The actor has no owner meanwhile: the first action that claims it takes over.

    Args:
        actor: The actor that enters.
        source: Source position of the first action.
    """

    service = True
    open_ended = True
    synthetic = True

    def __init__(self, actor: MovableObject, source: str) -> None:
        super().__init__(f"{actor.id} enters")
        self.actor = actor
        self.source = source
        self.action_name = f"{actor.id} {ENTER}"
        self._changes = False

    @property
    def actor_id(self) -> str:
        """The actor that enters."""
        return self.actor.id

    def initialise(self) -> None:
        """Begin."""
        self._changes = False
        self.context.trace.action("start", self)

    def update(self) -> Status:
        """Start the speed change at its step; end with the first action of the actor."""
        context = self.context
        entries = context.entries
        if isinstance(entries, Entries) and entries.has_begun(self.actor.id):
            return SUCCESS
        way = self._way()
        if way is not None and not self._changes and way.changes <= context.step < way.changed:
            self._changes = True
            duration = (way.changed - way.changes) * context.dt
            change = SpeedChange(way.target, "constant", duration=duration)
            context.leave(self.actor.id, LONGITUDINAL, ENTER, change)
        return RUNNING

    def terminate(self, new_status: Status) -> None:
        """Release the actor."""
        context = self.context
        if self._way() is not None:
            context.leave(self.actor.id, LONGITUDINAL, ENTER, None)
            if self.actor.id not in context.settings.destination:
                context.world.set_route(self.actor.id, None)
        context.trace.action("end", self, None if new_status is SUCCESS else "stopped")

    def _way(self) -> WayIn | None:
        entries = self.context.entries
        return entries.ways.get(self.actor.id) if isinstance(entries, Entries) else None


def with_entries(
    tree: Behaviour, present: Set[str], implied: Mapping[str, Sequence[Modifier]], race: bool
) -> Behaviour:
    """Return a tree with a node beside it for each actor that enters.

    Args:
        tree: The tree of the scenario that runs.
        present: Ids of the actors that are placed, or that act at the start.
        implied: Implied starts of the others, by actor id.
        race: All members of a `one_of` start.
    """
    late = _late(tree, implied, race)
    found = [Enter(actor, source) for actor, source in late if actor.id not in present]
    if not found:
        return tree
    whole = Parallel(f"{tree.name}, with actors that enter", tree, *found)
    whole.synthetic, whole.source = True, getattr(tree, "source", "")
    return whole


def entering_actors(tree: Behaviour) -> tuple[str, ...]:
    """Return the ids of the actors that enter."""
    return tuple(node.actor.id for node in tree.iterate() if isinstance(node, Enter))


def acting_at_once(tree: Behaviour, race: bool) -> set[str]:
    """Return the ids of the actors that certainly act when a tree starts."""
    return {
        node.actor.id
        for node, at_once in started_at_once(tree, race)
        if at_once and isinstance(node, Action) and isinstance(node.actor, MovableObject)
    }


def _late(
    tree: Behaviour, implied: Mapping[str, Sequence[Modifier]], race: bool
) -> Iterator[tuple[MovableObject, str]]:
    """Yield the actors with a position required later, with the first line that states it."""
    sources: dict[str, tuple[MovableObject, str]] = {}
    for node, at_once in started_at_once(tree, race):
        if at_once or not isinstance(node, Action) or not isinstance(node.actor, MovableObject):
            continue
        if start_demands(node, implied.get(node.actor.id, ())):
            sources.setdefault(node.actor.id, (node.actor, node.source))
    yield from sources.values()


def start_demands(action: BaseAction, implied: Sequence[Modifier] = ()) -> tuple[Modifier, ...]:
    """Return what an action states about its start; empty if it may begin from any state.

    What holds throughout also holds at the start. An actor may approach it, so only `at: start`, a
    position that is kept, and a path are reasons to enter.

    Args:
        action: The first action of its actor.
        implied: Its implied start.
    """
    if not isinstance(action, Action):
        return ()
    physical = one_of_kind(action.modifiers, PhysicalMovement)
    if physical is not None and physical.option == "prefer_non_physical":
        return ()  # the actor is set instantly
    found = [m for m in action.modifiers if m.facts.placement and _holds_at_start(m)]
    if not any(isinstance(m, PLACES) for m in found):
        found += action.states_itself()
    placed = any(isinstance(m, Position) for m in implied)
    if not placed and not any(map(_is_reason, found)):
        return ()
    stated = {type(m) for m in found if m.is_start}
    return with_implied([m for m in found if m.is_start or type(m) not in stated], implied)


def _is_reason(modifier: Modifier) -> bool:
    """Return whether an actor has to have a state by then, and not only to approach it.

    A path that is known only then may depend on the position of the actor.
    """
    if isinstance(modifier, Along):
        return modifier.is_start or isinstance(modifier.route, Path)
    if isinstance(modifier, AlongTrajectory):
        return isinstance(modifier.trajectory, Trajectory)
    return modifier.is_start or isinstance(modifier, Position)


def _holds_at_start(modifier: Modifier) -> bool:
    """Return whether a modifier holds at the start of its action, and not only later."""
    at = getattr(modifier, "at", "all")
    if at == "start" or not isinstance(modifier, MovementModifier):
        return modifier.is_start or not isinstance(modifier, MovementModifier)
    shaped = (getattr(modifier, name, None) for name in ("shape", "rate_peak"))
    profile = getattr(modifier, "rate_profile", "none")
    return at == "all" and profile == "none" and not any(each is not None for each in shaped)
