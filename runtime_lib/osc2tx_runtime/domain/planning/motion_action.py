"""The base of actions that command motion: state, limits and progress of the actor."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property, partial
from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.domain.actors import MovableObject
from osc2tx_runtime.domain.modifiers import Modifier, MovementModifier, Orient, PhysicalMovement
from osc2tx_runtime.domain.modifiers.base import settled
from osc2tx_runtime.domain.modifiers.calls import commanding
from osc2tx_runtime.domain.paths.path_curves import PathError
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.planning.enclosing_phase import most_steps
from osc2tx_runtime.enums import SideLeftRight
from osc2tx_runtime.errors import PlacementError, ScenarioError
from osc2tx_runtime.language.actions.action import Action, ActionOptions
from osc2tx_runtime.language.actions.base_action import with_blame
from osc2tx_runtime.language.actions.registry import LONGITUDINAL
from osc2tx_runtime.language.tree.base import Status
from osc2tx_runtime.language.tree.duration_limits import Duration, DurationLimits
from osc2tx_runtime.opendrive import MapError
from osc2tx_runtime.world.actor_dimensions import TOP_SPEED
from osc2tx_runtime.world.commands import Careful, Command, SpeedChange
from osc2tx_runtime.world.geometry.attitude import LEVEL
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx_runtime.domain.placing.initial_state import InitialState
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.opendrive import LanePosition
    from osc2tx_runtime.world.actor_dimensions import Limits
    from osc2tx_runtime.world.geometry.attitude import Tilt
    from osc2tx_runtime.world.protocol import LightState, World
    from osc2tx_runtime.world.state import ActorState


class Refused(ScenarioError):
    """The command is not possible: the action fails with this reason."""


IMPOSSIBLE = (Refused, PathError, PlacementError, MapError)
"""Errors that fail an action, not the run."""


class MotionAction(Action):
    """An action that commands the motion of its actor.

    An `IMPOSSIBLE` error is the reason why the action fails; at the start it then commands nothing.
    """

    _refused: str | None = None

    @property
    def world(self) -> World:
        """The world."""
        return self.context.world

    @property
    def here(self) -> ActorState:
        """State of the actor from which its commands start at the present step."""
        return self.context.world.reference(self.actor.id)

    def command(self, slot: str, command: Command) -> None:
        """Command the actor in a claimed slot.

        Raises:
            Refused: The actor is its own reference, or the speed exceeds the top speed.
        """
        course = command.course if isinstance(command, Careful) else command
        if isinstance(course, SpeedChange) and abs(course.target) > TOP_SPEED and not self.may_jump:
            raise Refused(f"{course.target:.1f} m/s exceeds its maximum speed of {TOP_SPEED:g} m/s")
        if getattr(course, "reference", None) == self.actor.id:
            raise Refused(f"{self.actor.id} cannot be its own reference; name another actor")
        super().command(slot, replace(command, unphysical=True) if self.may_jump else command)

    def situation(self) -> str:
        """Return that the actor is at standstill, as a reason for an unreached goal."""
        if not self.slots or self.actor.id not in self.world.actors():
            return ""
        return f"{self.actor.id} stands" if self.here.v == 0.0 else ""

    def place_of(self, actor_id: str) -> LanePosition:
        """Position of an actor on the lanes.

        Raises:
            Refused: It is off the road.
        """
        place = self.world.state(actor_id).lane_position
        if place is None:
            raise Refused(f"{actor_id} is not on a road, so it has no lane", self.source)
        return place

    def initialise(self) -> None:
        """Claim the slots and start."""
        self._refused = None
        try:
            super().initialise()
            self.on_started()
        except IMPOSSIBLE as error:
            self._refused = error.message

    def on_started(self) -> None:
        """Further commands at the start."""

    def update(self) -> Status:
        """Update; fails if a command was impossible."""
        if self._refused is not None:
            return self.fail(self._refused)
        excess = self._excess()
        if excess is not None:
            return self.fail(excess)
        try:
            return super().update()
        except IMPOSSIBLE as error:
            return self.fail(error.message)

    def _excess(self) -> str | None:
        """The limit that the motion has exceeded since the start, if limits must hold."""
        overloads = self.world.overloads()
        if not overloads or not self.slots or self.option() != "must_be_physical":
            return None
        since = (self.context.step - self.elapsed_steps + 0.5) * self.context.dt
        for found in overloads:
            if found.actor == self.actor.id and found.last > since:
                return str(found)
        return None

    def on_update(self) -> Status:
        """Ends with the goal in all slots, fails as soon as one cannot be reached."""
        if self.elapsed_steps == 0:
            return Status.RUNNING  # the commands have effect from now
        done, progress_of, actor_id = {}, self.context.world.progress, self.actor.id
        # An actor without a command keeps moving, and may also reach the end of the road.
        for slot in self.slots or (LONGITUDINAL,):
            progress = progress_of(actor_id, slot)
            if progress.failed is not None:
                return self.fail(progress.failed)
            done[slot] = progress.done
        return Status.SUCCESS if self.goal_reached(done) else Status.RUNNING

    def goal_reached(self, done: dict[str, bool]) -> bool:
        """Whether the action has reached its goal.

        Args:
            done: Whether the command is done, by slot.
        """
        return self.registered.ends != "open" and all(done.values())

    @property
    def limits(self) -> Limits:
        """The limits of the actor, vehicle and tyres, on the present road."""
        return self.world.limits(self.actor.id)

    @property
    def tyres(self) -> Limits:
        """The limits that its tyres have on the present road."""
        return self.world.limits(self.actor.id, of_vehicle=False)

    def be_at(self, initial: InitialState) -> None:
        """Teleport to a position, with the state there."""
        assign = partial(self.world.assign, self.actor.id)
        self.effect("position", initial.at, lambda: assign(at=initial.at))
        if initial.speed is not None:
            self.effect("speed", initial.speed, lambda: assign(speed=initial.speed))
        if (initial.heading, initial.tilt) != (None, LEVEL):
            self.turn(initial.heading, initial.tilt)

    def turn(self, heading: float | None, tilt: Tilt) -> None:
        """Set heading, pitch and roll (rad) instantly, as far as given."""
        apply = partial(self.world.assign, self.actor.id, heading=heading, tilt=tilt)
        self.effect("orientation", (heading, tilt), apply)

    def drawn_side(self, lanes: int) -> SideLeftRight:
        """A side with enough lanes, drawn from the seed."""
        own = self.place_of(self.actor.id)
        sides: tuple[SideLeftRight, ...] = ("left", "right")
        count = max(abs(lanes), 1)
        free = [s for s in sides if self.world.map.neighbour(own, s, count) is not None]
        return self.generator(self.action_name).choice(free or ["left"])

    def fixed_duration(self) -> float | None:
        """The duration (s) if it is a single number, from this step until its exact end."""
        duration = self.duration
        if duration is None or isinstance(duration, tuple):
            return None
        return max(0.0, float(duration) - self.started_late)

    def time_left(self) -> float | None:
        """Seconds until the end of the duration, if it is a single number."""
        duration = self.fixed_duration()
        return None if duration is None else duration - self.elapsed

    def option(self) -> str:
        """The option of `physical_movement`; `prefer_physical` without it."""
        physical = one_of_kind(self.modifiers, PhysicalMovement)
        return "prefer_physical" if physical is None else physical.option

    @property
    def may_jump(self) -> bool:
        """Whether physics need not hold."""
        return self.option() == "prefer_non_physical"

    @property
    def strict(self) -> bool:
        """Whether the limits of the actor must hold, not only those of tyres."""
        surprises = any(isinstance(m, MovementModifier) and m.monotonous for m in self.modifiers)
        return self.option() == "must_be_physical" or surprises


class Assignment(MotionAction):
    """An action that changes a state instantly (DSL 8.8.2.4 to 8.8.2.7)."""

    def on_update(self) -> Status:
        """Ends as soon as the change is applied."""
        return Status.SUCCESS


def note_lights(context: ExecutionContext, actor_id: str, lights: LightState) -> None:
    """Writes the requested lights and the shining ones to the trace."""
    context.trace.other(0, "lights", actor=actor_id, mode=lights.mode, lit=lights.lit)


class ModifiedMotion(MotionAction):
    """An action with modifiers that state the motion of its actor, and its end.

    Attributes:
        movable: The actor.
        planned: Seconds from its start to its goal, if the goal ends it.
    """

    def __init__(
        self, actor: MovableObject, *modifiers: Modifier, **options: Unpack[ActionOptions]
    ) -> None:
        self.movable = actor  # the resulting action may depend on it
        super().__init__(actor, *modifiers, **options)
        self._phase: DurationLimits | None = None
        self._given = self.modifiers
        self.planned: float | None = None

    def state_at_start(self, modifiers: Sequence[Modifier], source: str) -> None:
        """Add modifiers that hold at its start; call it before setup."""
        super().state_at_start(modifiers, source)
        self._given = self.modifiers

    def initialise(self) -> None:
        """Evaluate the late arguments of the modifiers, and start."""
        self.__dict__.pop("origin", None)
        if any(callable(value) for each in self._given for value in each.given().values()):
            self.modifiers = with_blame(self, partial(settled, self._given))
            for depending in ("commanding", "lasting", "orient"):
                self.__dict__.pop(depending, None)
        super().initialise()

    @cached_property
    def origin(self) -> LanePosition:
        """Its position at the start: positions count along that road and its successors."""
        return self.place_of(self.actor.id)

    @cached_property
    def commanding(self) -> tuple[Modifier, ...]:
        """The modifiers except those that only bound what another one commands."""
        return commanding(self.modifiers)

    @cached_property
    def lasting(self) -> tuple[Modifier, ...]:
        """The commanding modifiers except those that only constrain the start."""
        return tuple(modifier for modifier in self.commanding if not modifier.is_start)

    @cached_property
    def orient(self) -> Orient | None:
        """The tilt of a vehicle over time; None if it is not stated."""
        return one_of_kind(self.lasting, Orient) if self.movable.lane_bound else None

    def time_frame(self) -> Duration | None:
        """The time (s) for the action: its duration, or the rest of an enclosing one."""
        steps = None if self.context.first_come else most_steps(self)
        if steps is None or math.isinf(steps):
            return self.duration
        return 0.0, steps * self.context.dt

    @property
    def end_is_known(self) -> bool:
        """Whether it is known in advance when the action ends."""
        return self.fixed_duration() is not None or self._phase is not None or self._ends_open

    @property
    def _ends_open(self) -> bool:
        """Whether its end is drawn from a range of durations."""
        open_ended = self.registered.ends == "open"
        return open_ended and self._limits is not None and self._limits.ends_open

    def time_left(self) -> float | None:
        """Seconds until the end, if it is known or planned."""
        if self._phase is not None:
            return self._phase.left * self.context.dt
        known = super().time_left()
        if known is None and self._limits is not None and self._ends_open:
            known = self._limits.open_left * self.context.dt
        return self.planned - self.elapsed if known is None and self.planned else known
