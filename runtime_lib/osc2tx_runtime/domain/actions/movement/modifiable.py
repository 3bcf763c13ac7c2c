"""The base of actions whose motion modifiers complete (DSL 8.9.1).

`ego.follow_path(way) with: speed(30kph)`: the action controls the pose, the modifier the speed.
`at: all` holds (or is approached and then held) from the start of the action, which the end of a
lane change ends if nothing else does; `at: end` is reached exactly at the end of its duration or of
the phase it ends with, else it ends the action; `at: start` has to hold when the action starts, or
is set instantly if physics need not hold.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, ClassVar, Unpack

from osc2tx_runtime.domain.actors import MovableObject
from osc2tx_runtime.domain.map.roads_and_lanes import Route
from osc2tx_runtime.domain.modifiers import (
    Along,
    AvoidCollisions,
    ChangeLane,
    Distance,
    Lane,
    Lateral,
    Modifier,
    Orient,
    Position,
    Speed,
    Yaw,
)
from osc2tx_runtime.domain.modifiers.base import now
from osc2tx_runtime.domain.modifiers.groups import PATH_SHAPERS
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.planning.enclosing_phase import lasts_until_event, phase_of
from osc2tx_runtime.domain.planning.lateral.lateral_planning import follow_reference, side_command
from osc2tx_runtime.domain.planning.longitudinal.covering import time_to_goal
from osc2tx_runtime.domain.planning.longitudinal.goals import distance_to_cover, watched_place
from osc2tx_runtime.domain.planning.longitudinal.longitudinal_planning import speed_command
from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion
from osc2tx_runtime.domain.planning.orientation_planning import lies_so, tilt_again
from osc2tx_runtime.domain.planning.start_conditions import PlaceWatch, hold_or_jump
from osc2tx_runtime.domain.routes.composed_routes import MadeRoute
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.method import Method
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL
from osc2tx_runtime.language.tree.base import Status
from osc2tx_runtime.world.commands import Careful, Command

from .modifier_checks import check_modifiers, check_options

CARE = AvoidCollisions()


class ModifiableAction(ModifiedMotion):
    """Controls its own slots, and further slots as the modifiers state.

    It claims the speed if a modifier mentions it, and the lane likewise, so that
    `drive() with: speed(...)` and `change_lane(...)` run side by side.

    Attributes:
        stands: Whether it does not move, so that all its modifiers state its position.
        own: Slots that the action controls itself.
    """

    stands: ClassVar[bool] = False

    def __init__(
        self, actor: MovableObject, *modifiers: Modifier, **options: Unpack[ActionOptions]
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self._reached = self._jumped = False
        self._to_cover: float | None = None
        self._covered = 0.0
        self._counted = (0, 0.0)
        self._watched: PlaceWatch | None = None
        self._toward: object = None  # the lane of a reference, or its heading
        self._waits = False  # for a change of its actor, or for the end of its duration
        self._is_held = False  # its goal, once reached, until an event ends it

    def become(self, method: Method) -> None:
        """Takes the method; a goal bounds the action."""
        super().become(method)
        if self.has_goal and self.duration is None:
            goals = [m for m in self.modifiers if self._bounds(m)]
            routes = all(self._is_route(m) and getattr(m, "at", "all") == "all" for m in goals)
            self.open_ended = self.may_end = self.registered.ends == "open" and routes

    @cached_property
    def own(self) -> tuple[str, ...]:
        """Slots that the action controls itself; read when the action is complete."""
        return self.slots

    @cached_property
    def has_goal(self) -> bool:
        """True if a modifier states a goal."""
        return any(map(self._bounds, self.modifiers))

    def _bounds(self, modifier: Modifier) -> bool:
        """Whether a modifier states a goal.

        The end of a route or of a lane change only ends an action without a duration.
        """
        if getattr(modifier, "at", "all") == "end":
            return True
        yields = isinstance(modifier, ChangeLane) or self._is_route(modifier)
        return modifier.facts.bounds and not (self.duration is not None and yields)

    def _is_route(self, modifier: Modifier) -> bool:
        """Whether a modifier states a route of the map, and not a path."""
        if not isinstance(modifier, Along) or "vehicle" not in self.actor.kinds:
            return False
        route = modifier.route
        is_part = isinstance(route, Route) and route.kind != "crossing"
        return is_part or isinstance(route, MadeRoute)

    @cached_property
    def follows_path(self) -> bool:
        """True if it ends after the end of a path."""
        return any(isinstance(modifier, PATH_SHAPERS) for modifier in self.modifiers)

    def takes(self, modifier: Modifier) -> bool:
        """Whether the action can carry out a modifier."""
        return modifier.is_start or isinstance(modifier, self.accepts)

    def speaks_of(self, slot: str) -> bool:
        """Whether a modifier constrains a slot."""
        return any(slot in self._slots_of(modifier) for modifier in self.modifiers)

    def _slots_of(self, modifier: Modifier) -> tuple[str, ...]:
        starts = getattr(modifier, "at", "all") == "start"
        match modifier:
            case Position() | Lane() | Lateral() | Yaw() | Orient() if starts:
                return (LONGITUDINAL, LATERAL) if self.may_jump else ()
            case Speed(direction=direction) if starts:
                slot = LATERAL if direction == "lateral" else LONGITUDINAL
                return (slot,) if self.may_jump else ()
            case Speed(direction="lateral"):
                return (LATERAL,)
            case Along(shape=shape) if shape is not None:
                return (LONGITUDINAL, LATERAL)
            case AvoidCollisions(avoid=False):
                return ()
            case Distance(shape=None) if self.duration is None and not self.end_is_known:
                return ()
            case Orient(yaw=None) if self.movable.lane_bound:
                return ()
        return modifier.facts.slots

    # --- execution ----------------------------------------------------------------------------

    def setup(self, **kwargs: Any) -> None:
        """Claims the slots of the modifiers, and checks what is known at this time."""
        if self.has_goal:
            is_strict = not kwargs["context"].first_come
            goals = [each for each in self.modifiers if self._bounds(each)]
            self._is_held = lasts_until_event(self, goals, strict=is_strict)
            phase = None if self.follows_path else phase_of(self, strict=is_strict)
            if all(isinstance(each, ChangeLane) and each.at == "all" for each in goals):
                self._is_held |= phase is not None
            else:
                self._phase = phase
        if self._phase is not None or self._is_held:
            self.open_ended = True
        check_modifiers(self)
        own = self.own
        self.slots = tuple(
            slot for slot in (LONGITUDINAL, LATERAL) if slot in own or self.speaks_of(slot)
        )
        super().setup(**kwargs)
        check_options(self)

    def initialise(self) -> None:
        """Start."""
        self._reached, self._jumped, self._covered, self._to_cover = False, False, 0.0, None
        self._toward = self._watched = self.planned = None
        self._waits = False
        super().initialise()

    def on_started(self) -> None:
        """Establishes the conditions at the start, then commands the motion of the modifiers."""
        self._jumped = hold_or_jump(self)
        if not self._jumped:
            self._command_rest()

    def _command_rest(self) -> None:
        self._to_cover = distance_to_cover(self)
        time = time_to_goal(self)
        self.planned = None if time is None else self.elapsed + time
        position = watched_place(self)
        self._watched = None if position is None else PlaceWatch(position)
        self._counted = (self.elapsed_steps, self.here.v)
        speed = side = None
        if LONGITUDINAL not in self.own and LONGITUDINAL in self.slots:
            speed = speed_command(self)
        if LATERAL not in self.own and LATERAL in self.slots:
            side = side_command(self)
            self._toward = follow_reference(self)
        if speed is not None:
            self.command(LONGITUDINAL, speed)
        elif self._avoids_collisions_only:
            super().command(LONGITUDINAL, Careful(None))
        if side is not None:
            self.command(LATERAL, side)
        self._waits = self._is_passive()

    def command(self, slot: str, command: Command) -> None:
        """Command the actor, with collision avoidance if a modifier requires it."""
        careful = slot == LONGITUDINAL and self._careful()
        super().command(slot, Careful(command) if careful else command)

    @property
    def _avoids_collisions_only(self) -> bool:
        """Whether it has no command for the speed, but avoids collisions."""
        return LONGITUDINAL in self.slots and LONGITUDINAL not in self.own and self._careful()

    def _careful(self) -> bool:
        avoid = one_of_kind(self.modifiers, AvoidCollisions)
        if avoid is not None:
            return now(avoid.avoid)
        standard = self.context.settings.conduct == "standard"
        return standard and not self.may_jump and isinstance(CARE, self.accepts)

    def _is_passive(self) -> bool:
        """Whether it has no further commands, and ends only by progress or time."""
        watched = (self._to_cover, self._watched, self._toward, self._phase, self.orient)
        return (
            all(each is None for each in watched)
            and self._is_ours
            and not self.looks_further
            and self.option() != "must_be_physical"
        )

    @property
    def looks_further(self) -> bool:
        """Whether it checks more than its goal and its references in each pass."""
        return type(self).on_update is not ModifiableAction.on_update

    def _rest(self) -> None:
        """Rest, unless its time limit is over."""
        resting = self.context.resting
        if self._limits is None or self._limits.rest():
            resting.with_actor(self, self.actor.id)
            resting.nodes.add(self)

    def on_update(self) -> Status:
        """Ends with its goal; follows references."""
        if self._jumped and not self.context.effects.is_pending(self):
            self._jumped = False
            self.__dict__.pop("origin", None)
            self._command_rest()
            return Status.RUNNING
        covered = self._to_cover is None or self._cover() >= self._to_cover - 1e-6
        if self._watched is not None:
            self._reached = self._watched.reached(self) and covered
        elif self._to_cover is not None:
            self._reached = covered
        tilt_again(self)
        if self._toward is not None and self._toward != (now := follow_reference(self)):
            self._toward = now
            side = side_command(self)
            if side is not None:
                self.command(LATERAL, side)
                return Status.RUNNING
        status = super().on_update()
        if status is Status.RUNNING and self._is_beyond_goal():
            return self.fail(
                f"it has covered {self._to_cover:g} m, {self._not_reached(earlier=True)}"
            )
        return status

    def _is_beyond_goal(self) -> bool:
        """Whether its path ended before the last step, so that it ends without the missing part."""
        if self._to_cover is None or self.planned is None:
            return False
        step = abs(self.here.v) * self.context.dt
        return self._covered - 1.5 * step > self._to_cover + 1e-6

    def update(self) -> Status:
        """Update; at the end of a duration the goal has to be reached."""
        status = super().update()
        over = status is Status.SUCCESS
        if self._phase is not None and status is Status.RUNNING:
            over = self._phase.left <= 0
        if over and self.has_goal and not self._reached:
            missed = None if self._watched is None else self._watched.missed
            return self.fail(missed or self._not_reached())
        if self._waits and status is Status.RUNNING and self.elapsed_steps:
            self._rest()  # at its start its commands have no effect yet
        return Status.SUCCESS if over else status

    def _not_reached(self, *, earlier: bool = False) -> str:
        ends = [m.name for m in self.modifiers if getattr(m, "at", "all") == "end"]
        what = " and ".join(dict.fromkeys(f"`{name}(at: end)`" for name in ends)) or "its goal"
        if earlier:
            return f"before {what} is reached; {self.limits.text}"
        return f"its duration ends before {what} is reached; state a longer one, or none"

    # --- goals --------------------------------------------------------------------------------

    def goal_reached(self, done: dict[str, bool]) -> bool:
        """Whether all parts of the goal are reached."""
        open_ended = self.registered.ends == "open"
        if open_ended and not self.has_goal:
            return False
        reached = all(
            done[slot]
            for slot in self.slots
            if (slot in self.own and not open_ended) or self._ends_with(slot)
        )
        watches = self._to_cover is not None or self._watched is not None
        self._reached = reached and (not watches or self._reached) and lies_so(self)
        return self._reached and self._phase is None and not self._is_held

    def _ends_with(self, slot: str) -> bool:
        """Whether the command in a slot belongs to the goal."""
        for modifier in self.modifiers:
            is_course = isinstance(modifier, (*PATH_SHAPERS, ChangeLane)) and self._bounds(modifier)
            lasting = getattr(modifier, "at", "all") == "end" or is_course
            looked_at = self._watched is not None or self._to_cover is not None
            if looked_at and isinstance(modifier, Position):
                continue  # on its own
            counted = isinstance(modifier, Distance) and modifier.shape is None
            lasting = lasting or isinstance(modifier, Distance)
            if lasting and not counted and slot in self._slots_of(modifier):
                return True
        return False

    def _cover(self) -> float:
        """Metres covered since the start."""
        step, speed = self.elapsed_steps, self.here.v
        before, speed_before = self._counted
        if step > before:
            self._covered += 0.5 * abs(speed + speed_before) * (step - before) * self.context.dt
            self._counted = (step, speed)
        return self._covered
