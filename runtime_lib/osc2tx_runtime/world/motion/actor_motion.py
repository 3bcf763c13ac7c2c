"""The commands of one actor, and their execution."""

from __future__ import annotations

import math
from dataclasses import field

from osc2tx_runtime.opendrive import Pose, RoadMap
from osc2tx_runtime.world.commands import (
    Command,
    FollowRoute,
    KeepLane,
    RunOut,
    Sideways,
    Slant,
    Turn,
)
from osc2tx_runtime.world.geometry.lane_return import turn_from
from osc2tx_runtime.world.lateral.attitude_control import Turning
from osc2tx_runtime.world.lateral.curve_following import Replay, TimedReplay, course_of
from osc2tx_runtime.world.lateral.execution import HoldOffset, Impossible, Shift, lateral_of
from osc2tx_runtime.world.lateral.route_following import Way
from osc2tx_runtime.world.longitudinal.acceleration import ConstantAcceleration
from osc2tx_runtime.world.longitudinal.collision_avoidance import Cautious
from osc2tx_runtime.world.longitudinal.execution import ProfileRun, acceleration_of, longitudinal_of
from osc2tx_runtime.world.longitudinal.gap_control import ArrivalRun
from osc2tx_runtime.world.longitudinal.outlook import outlook_of
from osc2tx_runtime.world.longitudinal.position_control import CoverRun
from osc2tx_runtime.world.measuring.measurement import MeasuredMotion
from osc2tx_runtime.world.protocol import LATERAL, LONGITUDINAL, PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import Outlook, StepInputs
from osc2tx_runtime.world.tracking.expectations import Expectation, expected
from osc2tx_runtime.world.tracking.tracking import Tracking
from osc2tx_shared.classes import dataclass

from .actor_step import MovingActor

STEADY = frozenset({type(None), ConstantAcceleration, HoldOffset, ProfileRun, Shift})
"""Kinds of executions that cannot fail."""


@dataclass
class CommandedActor(MovingActor):
    """An actor with its commands.

    Attributes:
        follows: Whether it follows its commands; False with another driver, of which they are only
            expected.
        tracking: Quality of tracking, if it is measured.
        motion: Its measured motion, if any.
        heading: Heading (rad) of its reference at the last check of grip.
        aside: Lateral speed (m/s) then; None off the lanes.
    """

    follows: bool = True
    _expected: dict[str, Expectation] = field(default_factory=dict)
    tracking: Tracking | None = None
    motion: MeasuredMotion | None = None
    heading: float | None = None
    aside: float | None = None
    _last: tuple[Progress, Progress] | None = None  # progress at the last check

    def progress(self, slot: str) -> Progress:
        """Progress of the command in a slot, by reference and measurement."""
        if not self.follows:
            expectation = self._expected.get(slot)
            return REACHED if expectation is None else expectation.progress()
        commanded = self.speed_progress() if slot == LONGITUDINAL else self.side_progress()
        return commanded if self.tracking is None else self.tracking.progress(slot, commanded)

    @property
    def is_physical(self) -> bool:
        """Whether it moves by its commands, and was not teleported."""
        if not self.follows or self._unphysical:
            return False
        return not isinstance(self._course, Replay | TimedReplay)

    def pursue(self, slot: str, command: Command | None, road_map: RoadMap) -> None:
        """Executes the command of a slot; None holds the speed, or keeps the lane."""
        self._unphysical.discard(slot)
        if command is not None and command.unphysical:
            self._unphysical.add(slot)
        if not self.follows:
            self._expected[slot] = expected(command, self.state, road_map, self.route)
        elif slot == LONGITUDINAL:
            self.pursue_speed(command)
        else:
            self.pursue_side(command, road_map)

    def observe(self, inputs: StepInputs) -> None:
        """Updates the progress of its expectations after a step."""
        for expectation in self._expected.values():
            expectation.look(self.state, inputs)

    def pursue_speed(self, command: Command | None) -> None:
        """Executes a longitudinal command; None holds the speed."""
        self.upset()
        if self.tracking is not None:
            self.tracking.forget(LONGITUDINAL)
        if command is None:
            self._speed = None
            return
        slips = self.wheels is not None and self.wheels.slipping
        now = self.reference.a if slips else acceleration_of(self._speed, self.reference)
        state = self.reference._replace(a=now)
        self._speed = longitudinal_of(command, state, self.limits, self.route)

    def go_on_with(self, speed: float, acceleration: float) -> None:
        """Continues from an assigned speed (m/s), at an acceleration (m/s^2), up to a command."""
        self.upset()
        self._speed = ConstantAcceleration(acceleration, speed)

    def pursue_side(self, command: Command | None, road_map: RoadMap) -> None:
        """Executes a lateral command; None keeps the lane, or returns to one."""
        self.upset()
        if self.tracking is not None:
            self.tracking.forget(LATERAL)
        if self._way is not None:
            self.route, self._way = self._way.before, None
        if isinstance(command, FollowRoute):
            self._way = Way(command, road_map, self.route)
            self.route, command = self._way.route, command.side or KeepLane()
        course = course_of(command, self.reference, self.limits)
        if course is not None:
            self._course, self.bound, self.home = course, None, None
            self._side = HoldOffset()
            return
        returned = self._course is not None
        if returned:
            self._course = None
            self._return_to_lane(road_map)
            if self.bound is not None and (command is None or isinstance(command, KeepLane)):
                return  # it moves to the middle of the lane
        if self.home is not None or self._astray:
            self._return_to_lane(road_map, at_angle=isinstance(command, Sideways | Slant))
        if self.home is not None:
            held = command is None or isinstance(command, KeepLane)
            self._side = HoldOffset() if held else Impossible(f"{self.spec.id} is in no lane yet")
            return
        if self.bound is None:
            self._pursue_heading(command)
            return
        state = self.reference
        here, rate = state.lane_position or self.bound, state.lateral_speed
        if returned:
            here, rate = self.bound, state.v * math.sin(turn_from(road_map, self.bound, state))
        before = self.bound
        self.bound, self._side = lateral_of(
            command,
            road_map,
            before,
            here,
            (state.x, state.y, rate),
            self._side,
            self.limits,
        )
        if self.bound is not before:
            self.residual = None  # it counts from its position

    def _pursue_heading(self, command: Command | None) -> None:
        self._turning = Turning(command) if isinstance(command, Turn) else None
        self._side = HoldOffset()
        if command is not None and not isinstance(command, KeepLane | Turn):
            self._side = Impossible(
                f"{self.spec.id} is not on a driving lane, so it cannot change or follow one"
            )

    def is_steady(self) -> bool:
        """Returns whether its commands cannot fail: closed forms, independent of others."""
        self.steady = (
            self.follows
            and type(self._speed) in STEADY
            and type(self._side) in STEADY
            and self._course is None
            and self._way is None
            and self.blocked is None
            and self.tracking is None
            and not (self.wheels is not None and self.wheels.limited)
        )
        return self.steady

    def has_news(self) -> bool:
        """Whether progress may have changed since the last call."""
        if not (self.steady or self.is_steady()):
            self._last = None
            return True
        before, self._last = self._last, (self.speed_progress(), self.side_progress())
        return self._last != before

    def upset(self) -> None:
        """As in the base class; its progress is checked again."""
        super().upset()
        self._last = None

    def outlook(self, steps: int, dt: float, *, moved: bool) -> Outlook | None:
        """Its expected motion over a number of steps, if its command determines it.

        See `outlook_of`.
        """
        is_told = self.follows and self._stopping is None
        return outlook_of(self._speed, steps, dt, moved=moved) if is_told else None

    def speed_progress(self) -> Progress:
        """Progress of the longitudinal command, by the reference."""
        if self._hindrance is not None:
            return Progress(False, self._hindrance)
        progress = REACHED if self._speed is None else self._speed.progress()
        lags = self.wheels is not None and self.wheels.slipping
        return PENDING if lags and progress.done else progress

    @property
    def _hindrance(self) -> str | None:
        """Why it cannot continue; the end of the road is not a reason if its goal was there."""
        sliding = None if self.wheels is None else self.wheels.sliding
        arrived = self._way is not None and self._way.progress().done
        return sliding if arrived else self.blocked or sliding

    def side_progress(self) -> Progress:
        """Progress of the lateral command, by the reference."""
        if self._hindrance is not None:
            return Progress(False, self._hindrance)
        if self._course is not None:
            return self._course.progress()
        if self._way is not None and self._way.ends:
            return self._way.progress()
        lost = isinstance(self._side, Impossible)
        if self.bound is not None or self.home is not None or lost:
            return self._side.progress()
        return REACHED if self._turning is None else self._turning.progress(self.reference)

    def drift(self, aside: float, road_map: RoadMap) -> None:
        """Sets a lateral speed (m/s) at the start."""
        if self.bound is not None:
            self.settle(self.on_lane(self.bound, self.reference.v, aside, 0.0, road_map))
            self.pursue_side(RunOut(aside), road_map)

    # --- for controllers -----------------------------------------------------------------------

    def settle(self, state: ActorState) -> None:
        """Sets state and reference to the commanded state."""
        self.state = self.reference = state

    def slid(self, along: float) -> None:
        """Notes that its reference is a distance (m) ahead of its commanded position."""
        if self._course is not None:
            self._course.slid(along)
        if isinstance(self._speed, ArrivalRun | Cautious | CoverRun):
            self._speed.slid(along)

    def course_ahead(self, way: float) -> Pose | None:
        """Position at a distance (m) along its course; None without a course."""
        return None if self._course is None else self._course.ahead(way)

    def offset_after(self, seconds: float, rate: float) -> float:
        """Offset in its lane after a time, at a lateral speed (m/s, to the left)."""
        assert self.bound is not None
        if isinstance(self._side, Shift):
            return self._side.offset_in(seconds)
        return self.bound.offset + rate * seconds
