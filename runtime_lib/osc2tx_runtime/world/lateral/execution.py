"""Execution of lateral commands: closed-form offset over time.

A lane change binds the actor to its target lane instantly, and the offset from there runs to its
end value; so curves, widths and section changes need no special treatment. The course is a function
of a time that pauses while the actor is too slow for it: the heading never differs from that of the
lane by more than `HEADING_LIMIT`, and at standstill there is no lateral motion.
"""

from __future__ import annotations

import math
from typing import Protocol

from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world.actor_dimensions import Limits
from osc2tx_runtime.world.commands import (
    Beside,
    Command,
    KeepLane,
    LaneChange,
    LaneOffset,
    RunOut,
    Sideways,
    Slant,
)
from osc2tx_runtime.world.geometry.function_profiles import Mapped
from osc2tx_runtime.world.geometry.lane_neighbours import lane_beside, offset_from
from osc2tx_runtime.world.geometry.profiles import (
    Cosine,
    Linear,
    Profile,
    Quintic,
    cosine_duration,
    fastest_cosine,
)
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs

from .feedback import HEADING_LIMIT, SIDEWAYS, BesideRun, SidewaysRun

__all__ = [
    "HEADING_LIMIT",
    "LANE_CHANGE_TIME",
    "LANE_CHANGE_WIDTH",
    "SIDEWAYS",
    "HoldOffset",
    "Impossible",
    "Lateral",
    "Shift",
    "excessive_shift",
    "lateral_of",
    "shift_profile",
]

LANE_CHANGE_TIME = 3.0
"""Duration (s) of a lane change without stated profile, over `LANE_CHANGE_WIDTH` metres."""

LANE_CHANGE_WIDTH = 3.5
"""Metres; the duration grows with the square root of the distance."""

_AT_REST = 1e-6  # m/s of lateral speed
_RUN_OUT = 0.4  # s: time in which a free lateral speed decays
_SAME_LANE = 1.0  # m: drift of the centre of one lane of oncoming traffic


class Lateral(Protocol):
    """Execution of a command for one actor."""

    def offset_after(
        self, offset: float, path: float, me: ActorState, inputs: StepInputs
    ) -> tuple[float, float]:
        """Offset (m) and lateral speed (m/s) at the next step; called once per step.

        Args:
            offset: Offset at the present step (m).
            path: Metres driven in this step.
            me: State at the present step.
            inputs: The snapshot of the present step.
        """

    def progress(self) -> Progress:
        """Progress at the present step."""


class HoldOffset:
    """Keeps its position in the lane.

    Attributes:
        centre: Offset (m) of the centre of the lane that it has reached, which may be one of
            oncoming traffic; None without a change of the offset.
    """

    __slots__ = ("centre",)

    def __init__(self, centre: float | None = None) -> None:
        self.centre = centre

    def offset_after(
        self, offset: float, path: float, me: ActorState, inputs: StepInputs
    ) -> tuple[float, float]:
        """The same offset."""
        return offset, 0.0

    def progress(self) -> Progress:
        """Always reached."""
        return REACHED


class Impossible(HoldOffset):
    """Keeps its position, because the target does not exist."""

    __slots__ = ("_reason",)

    def __init__(self, reason: str) -> None:
        super().__init__()
        self._reason = reason

    def progress(self) -> Progress:
        """Failed."""
        return Progress(False, self._reason)


class Shift:
    """A change of the offset in closed form."""

    __slots__ = ("_lag", "_profile", "_steps", "_time", "centre", "end")

    def __init__(self, profile: Profile, end: float, centre: float = 0.0) -> None:
        """Takes the profile and the end of the offset (m), and its value in the target lane."""
        self._profile = profile
        self.centre = centre
        self._steps = 0
        self._lag = 0.0
        self._time = 0.0
        self.end = end

    def offset_after(
        self, offset: float, path: float, me: ActorState, inputs: StepInputs
    ) -> tuple[float, float]:
        """Value of the profile, at a time that pauses while the actor is too slow."""
        if self._time >= self._profile.duration:
            return self.end, 0.0
        dt = inputs.dt
        self._steps += 1
        if path == 0.0:
            self._lag += dt
            return offset, 0.0
        time = self._steps * dt - self._lag
        wanted, room = self._profile.value(time), abs(path) * SIDEWAYS
        if abs(wanted - offset) <= room:
            self._time = time
            # A constant rate ends with the change, whether a step ends there or goes beyond it.
            return wanted, 0.0 if self.progress().done else self._profile.rate(time)
        share = room / abs(wanted - offset)
        self._lag += (1.0 - share) * dt
        self._time = self._steps * dt - self._lag
        reached = self._profile.value(self._time)
        return reached, (reached - offset) / dt

    def offset_in(self, seconds: float) -> float:
        """Offset (m) after a time from the present step, without delays."""
        time = self._time + seconds
        return self.end if time >= self._profile.duration else self._profile.value(time)

    def progress(self) -> Progress:
        """Done when the profile has ended."""
        return REACHED if self._time >= self._profile.duration - 1e-9 else PENDING


def shift_profile(
    offset: float,
    end: float,
    rate: float,
    command: tuple[DynamicProfile, float | None, float | None],
    limits: Limits,
) -> Profile:
    """Closed form of a change of the offset.

    Args:
        offset: Where it starts (m).
        end: Where it ends (m).
        rate: Lateral speed at the start (m/s); ignored by `constant`.
        command: Profile, peak of the lateral speed (m/s), duration (s).
        limits: Of the actor.
    """
    profile, peak, duration = command
    change = abs(end - offset)
    if profile == "constant":
        usual = 1.0 / LANE_CHANGE_TIME if change == 0.0 else change / _usual_time(change, limits)
        return Linear(offset, end, duration or change / (peak or usual))
    if profile == "asap":
        slowed = 0.0 if peak is None else cosine_duration(change, peak)
        time = max(fastest_cosine(change, limits.lateral), slowed)
    elif duration is not None:
        time = duration
    elif peak is not None:
        time = cosine_duration(change, peak)
    else:
        time = _usual_time(change, limits)
    if abs(rate) <= _AT_REST:
        return Cosine(offset, end, time)
    # Continuing a lateral speed takes time even without a distance to cover.
    is_free = profile != "asap" and duration is None and peak is None
    return Quintic(offset, end, max(time, 1.0) if is_free else time, rate)


def _usual_time(change: float, limits: Limits) -> float:
    fastest = fastest_cosine(change, limits.lateral)
    return max(LANE_CHANGE_TIME * math.sqrt(change / LANE_CHANGE_WIDTH), fastest)


def lateral_of(
    command: Command | None,
    road_map: RoadMap,
    bound: LanePosition,
    physical: LanePosition,
    motion: tuple[float, float, float],
    before: Lateral,
    limits: Limits,
) -> tuple[LanePosition, Lateral]:
    """Returns the execution of a lateral command.

    Args:
        command: The command; None: stay in the lane.
        road_map: The map.
        bound: Lane the actor follows now, with its offset from there.
        physical: Lane in which its reference point is.
        motion: World x, y (m) and lateral speed (m/s).
        before: The execution until now.
        limits: Of the actor.

    Returns:
        The lane to follow, with the offset of the actor from it, and the execution.
    """
    x, y, rate = motion
    lane = LanePosition(physical.road, physical.lane, physical.s)
    match command:
        case LaneChange() | LaneOffset():
            lanes = command.lanes if isinstance(command, LaneChange) else 0
            place = _in_own_lane(physical, bound, before) if lanes == 0 else physical
            target = lane_beside(road_map, place, lanes)
            if target is None:
                return bound, Impossible(_no_lane(road_map, physical, lanes))
            start, end = offset_from(road_map, target, x, y), command.offset
        case Beside():
            return bound, BesideRun(command, limits, rate)
        case Sideways() | Slant():
            return bound, SidewaysRun(command)
        case RunOut():
            target, rate = lane, command.speed
            start = offset_from(road_map, target, x, y)
            end = start + _RUN_OUT * rate
        case None | KeepLane() if isinstance(before, BesideRun | SidewaysRun):
            # It may be in another lane now; the rest of the lateral speed decays.
            target, start = lane, offset_from(road_map, lane, x, y)
            end = start + _RUN_OUT * rate
        case None | KeepLane():
            if isinstance(before, HoldOffset):
                return bound, HoldOffset(before.centre)
            if not isinstance(before, Shift) or before.progress().done:
                return bound, HoldOffset(before.centre if isinstance(before, Shift) else None)
            target = lane_beside(road_map, _in_own_lane(physical, bound, before), 0) or lane
            is_there = (bound.road, bound.lane) == (target.road, target.lane)
            if is_there and abs(before.centre - target.offset) < _SAME_LANE:
                return bound, before  # interrupted in its target lane: complete the change
                # Interrupted before that: back to the present lane.
            start, end = offset_from(road_map, target, x, y), 0.0
        case _:
            raise UnsupportedError(
                f"{type(command).__name__} is not a command for an actor on a lane"
            )
    centre = target.offset
    course: Profile
    if isinstance(command, (LaneChange, LaneOffset)) and command.course is not None:
        course = Mapped(command.course, 1.0, centre) if centre else command.course
    else:
        stated: tuple[DynamicProfile, float | None, float | None] = ("none", None, None)
        if isinstance(command, (LaneChange, LaneOffset)):
            stated = (command.profile, command.rate_peak, command.duration)
        course = shift_profile(centre + start, centre + end, rate, stated, limits)
    here = LanePosition(target.road, target.lane, target.s, centre + start)
    return here, Shift(course, centre + end, centre)


def _in_own_lane(physical: LanePosition, bound: LanePosition, before: Lateral) -> LanePosition:
    """A position, on the centre of its lane if the actor has not entered one of oncoming traffic.

    An actor that only overlaps the lane boundary is still in its own lane, wherever its reference
    point is.
    """
    centre = before.centre if isinstance(before, Shift | HoldOffset) else None
    same = (physical.road, physical.lane) == (bound.road, bound.lane)
    return physical._replace(offset=0.0) if centre == 0.0 and same else physical


def excessive_shift(
    road_map: RoadMap,
    me: ActorState,
    target: LanePosition,
    offset: float,
    duration: float,
    limits: Limits,
) -> str | None:
    """Why a lateral motion is infeasible in a time; None if it is feasible.

    Args:
        road_map: The map.
        me: The actor.
        target: Centre of the lane in which it ends.
        offset: Metres to the left of it.
        duration: Seconds.
        limits: Of the actor.
    """
    here = offset_from(road_map, target, me.x, me.y)
    least = fastest_cosine(offset - here, limits.lateral)
    if duration >= least - 1e-9:
        return None
    return (
        f"a lateral displacement of {abs(offset - here):.1f} m in {duration:g} s requires more"
        f" than {limits.lateral:g} m/s^2; the shortest possible duration is {least:.2f} s"
    )


def _no_lane(road_map: RoadMap, place: LanePosition, lanes: int) -> str:
    side = "left" if lanes > 0 else "right"
    count = "is no driving lane" if abs(lanes) == 1 else f"are not {abs(lanes)} driving lanes"
    return (
        f"there {count} to the {side} of lane {place.lane} of road {place.road}"
        f" at s = {place.s:.1f} m"
    )
