"""Following and replaying curves off the lanes.

`Replay` and `TimedReplay` set the pose to that of the curve. `Follow` steers as the limits allow: a
bicycle with its reference point at the rear axle, steered at a point ahead on the curve (pure
pursuit), over a step exactly along an arc of a circle.
"""

from __future__ import annotations

import math
from typing import Protocol

from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import Limits, Shape
from osc2tx_runtime.world.commands import Command, FollowCourse, ReplayCourse, ReplayTrajectory
from osc2tx_runtime.world.geometry.curve import Curve, turn_between
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState

TURN_RATE = math.pi
"""Turn rate (rad/s) of actors without wheels."""

_LOOK_AHEAD = 0.5  # s ahead at which a follower steers
_NEAREST = 1.5  # wheelbases: the least look-ahead
_ON_FOOT = 0.3  # m: the least look-ahead of actors without wheels
_JOINED = 0.5  # m from the curve within which a follower is on it
_LOST = 3.0  # m from the curve beyond which it has left it
_DETOUR = 40.0  # m, plus five times the distance at the start: the longest path to the curve
_PASSED = 0.02  # m before the end that count as passed


class Course(Protocol):
    """Execution of a course for one actor."""

    def after(self, me: ActorState, speed: float, path: float, dt: float) -> tuple[Pose, float]:
        """Pose and speed (m/s) at the next step; called once per step.

        Args:
            me: State at the present step.
            speed: Speed of the longitudinal command (m/s).
            path: Metres driven in this step.
            dt: Length of the step (s).
        """

    def slid(self, along: float) -> None:
        """Notes that the actor was measured this distance (m) ahead of its commanded position."""

    def ahead(self, way: float) -> Pose:
        """Position at a distance (m) along the course; beyond its end on a straight line."""

    def progress(self) -> Progress:
        """Progress at the present step."""


class Steering:
    """Limits of the curvature of an actor.

    Args:
        shape: Its shape, with the wheelbase.
        limits: Limits of the actor; the lateral limit is that of braking.
    """

    def __init__(self, shape: Shape, limits: Limits) -> None:
        self._wheelbase = shape.wheelbase
        self._grip = limits.deceleration
        self._bend = math.tan(shape.steering) / shape.wheelbase if shape.wheelbase else math.inf

    def look_ahead(self, speed: float) -> float:
        """Look-ahead distance (m)."""
        least = _NEAREST * self._wheelbase or _ON_FOOT
        return max(least, _LOOK_AHEAD * abs(speed) if self._wheelbase else 0.0)

    def sharpest(self, speed: float) -> float:
        """Largest curvature (1/m) at a speed (m/s)."""
        if speed == 0.0:
            return min(self._bend, 1e9)
        if not self._wheelbase:
            return TURN_RATE / abs(speed)
        return min(self._bend, self._grip / (speed * speed))

    def towards(self, me: ActorState, x: float, y: float, path: float) -> Pose:
        """Pose after a distance (m) along an arc towards a point."""
        distance = math.hypot(x - me.x, y - me.y)
        angle = turn_between(me.h, math.atan2(y - me.y, x - me.x)) if distance > 0.0 else 0.0
        limit = self.sharpest(me.v)
        if abs(angle) > 0.5 * math.pi:
            bend = math.copysign(min(limit, 1e3), angle)
        else:
            bend = 2.0 * math.sin(angle) / distance if distance > 0.0 else 0.0
        bend = min(max(bend, -limit), limit)
        turn = bend * path
        if abs(turn) > abs(angle) and abs(angle) > 0.5 * math.pi:
            turn = angle
        half = 0.5 * turn
        chord = path * math.sin(half) / half if abs(half) > 1e-9 else path
        h = me.h + half
        return Pose(
            me.x + chord * math.cos(h),
            me.y + chord * math.sin(h),
            me.z,
            turn_between(0.0, me.h + turn),
        )


class Follow:
    """Steers along a curve as the limits allow."""

    def __init__(self, command: FollowCourse, me: ActorState, limits: Limits) -> None:
        self._curve = command.curve
        self._end = command.end
        self._steering = Steering(me.shape, limits)
        self._along = self._curve.nearest(me.x, me.y, command.begin, 5.0)
        away = self._curve.distance_to(me.x, me.y, self._along)
        self._joined = away < _JOINED
        self._left = _DETOUR + 5.0 * away
        self._failed: str | None = None

    def after(self, me: ActorState, speed: float, path: float, dt: float) -> tuple[Pose, float]:
        """Steers towards a point ahead on the curve."""
        ahead = self._along + self._steering.look_ahead(me.v)
        x, y, _ = self._curve.point(self._curve.at_length(ahead))
        pose = self._steering.towards(me, x, y, path)
        reach = max(2.0 * abs(path), 1.0)
        self._along = self._curve.nearest(pose.x, pose.y, self._along, reach)
        away = self._curve.distance_to(pose.x, pose.y, self._along)
        if away < _JOINED:
            self._joined = True
        elif self._joined and away > _LOST:
            radius = 1.0 / self._steering.sharpest(me.v)
            self._failed = (
                f"it deviated {away:.1f} m from the path, because at {me.v:.1f} m/s its turning"
                f" radius is at least {radius:.1f} m"
            )
        elif not self._joined:
            self._left -= abs(path)
            if self._left < 0.0:
                self._failed = f"it does not reach the path, which is {away:.1f} m away"
        return pose, speed

    def slid(self, along: float) -> None:
        """No effect: each step starts from the actual position."""

    def ahead(self, way: float) -> Pose:
        """A position on the curve."""
        return _place_on(self._curve, self._along + way)

    def progress(self) -> Progress:
        """Done when the end is passed."""
        if self._failed is not None:
            return Progress(False, self._failed)
        passed = self._joined and self._along >= self._end - _PASSED
        return REACHED if passed else PENDING


class Replay:
    """Follows the curve exactly, at its own speed."""

    def __init__(self, command: ReplayCourse) -> None:
        self._curve = command.curve
        self._begin = self._along = command.begin
        self._end = command.end

    def after(self, me: ActorState, speed: float, path: float, dt: float) -> tuple[Pose, float]:
        """The position on the curve after the distance driven."""
        self._along = max(self._along + path, self._begin)
        return _pose_at(self._curve, self._curve.at_length(self._along), me.h), speed

    def slid(self, along: float) -> None:
        """Continues from there."""
        self._along += along

    def ahead(self, way: float) -> Pose:
        """A position on the curve."""
        return _place_on(self._curve, self._along + way)

    def progress(self) -> Progress:
        """Done when the end is passed."""
        return REACHED if self._along >= self._end - 1e-9 else PENDING


class TimedReplay:
    """Follows the curve exactly in position and time."""

    def __init__(self, command: ReplayTrajectory) -> None:
        self._curve = command.curve
        self._begin, self._end = command.begin, command.end
        self._steps = 0
        self._time = command.begin

    def after(self, me: ActorState, speed: float, path: float, dt: float) -> tuple[Pose, float]:
        """The position on the curve at the next step; the speed is that of the curve."""
        self._steps += 1
        self._time = self._begin + self._steps * dt
        dx, dy, _ = self._curve.rate(min(self._time, self._end))
        pose = _pose_at(self._curve, self._time, me.h)
        backwards = dx * math.cos(pose.h) + dy * math.sin(pose.h) < 0.0
        return pose, math.copysign(math.hypot(dx, dy), -1.0 if backwards else 1.0)

    def slid(self, along: float) -> None:
        """No effect: its times count."""

    def ahead(self, way: float) -> Pose:
        """A position on the curve."""
        return _place_on(self._curve, self._curve.length_at(self._time) + way)

    def progress(self) -> Progress:
        """Done at the last time."""
        return REACHED if self._time >= self._end - 1e-9 else PENDING


def _place_on(curve: Curve, along: float) -> Pose:
    """Pose at a distance (m) along a curve, in the direction of motion."""
    at = curve.at_length(along)
    x, y, z = curve.point(at)
    return Pose(x, y, z, curve.heading(at) or 0.0)


def _pose_at(curve: Curve, at: float, before: float) -> Pose:
    x, y, z = curve.point(at)
    h = curve.yaw(at)
    if h is None:
        h = curve.heading(at)
    return Pose(x, y, z, before if h is None else turn_between(0.0, h))


def course_of(command: Command | None, me: ActorState, limits: Limits) -> Course | None:
    """Returns the execution of a course; None for other commands."""
    match command:
        case FollowCourse():
            return Follow(command, me, limits)
        case ReplayCourse():
            return Replay(command)
        case ReplayTrajectory():
            return TimedReplay(command)
    return None
