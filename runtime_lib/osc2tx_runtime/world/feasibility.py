"""The friction circle on every road: motions that no tyre can transmit.

Looked at are the motions that the scenario asks for, so the rule is the same in all worlds: the sum
of the squares of the accelerations along and across the way of a vehicle is at most (mu g)^2. What
jumps, is replayed, or is driven by somebody else is left out.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable

from .actor_dimensions import RATE_CAP
from .actor_motion import CommandedActor
from .curve import turn_between
from .friction import GRAVITY, RoadCondition, adhesion_of
from .overload import Overload
from .state import ActorState

__all__ = ["FrictionWatch"]

_SMOOTHING = 0.1  # s: where roads join, headings have small kinks
_AT_THE_LIMIT = 1.01  # who uses all the grip there is does not use more
_STRAIGHT = 1e-6  # rad/s at which one does not turn
_APART = 1.0  # s between two overloads of one actor; nearer ones are one


class FrictionWatch:
    """Looks at all vehicles after each step.

    Attributes:
        overloads: What was found, in order of time.
    """

    def __init__(self, dt: float) -> None:
        self.overloads: list[Overload] = []
        self._dt = dt
        self._share = dt / (_SMOOTHING + dt)
        self._turning: dict[str, float] = {}  # smoothed rad/s of those who turn
        self._last: dict[str, Overload] = {}
        self._steps = 0

    def step(
        self, members: Iterable[CommandedActor], jumped: Collection[str], road: RoadCondition
    ) -> None:
        """Look at the references after a step.

        Args:
            members: All actors.
            jumped: Who was put somewhere in it.
            road: Condition of the roads.
        """
        self._steps += 1
        limit = adhesion_of(road) * GRAVITY
        most = (_AT_THE_LIMIT * limit) ** 2
        for actor in jumped:
            self._turning.pop(actor, None)
        turning = self._turning
        for member in members:
            if member.wheels is None:
                continue
            state = member.reference
            across, a = 0.0, state.a
            if state.h != member.heading or member.spec.id in turning:
                across = state.v * self._turned(member, state.h, jumped)
            if across * across + a * a <= most:
                continue
            if abs(a) <= RATE_CAP and member.is_physical:  # else its speed jumps
                self._note(member.spec.id, state, across, limit, road)

    def _turned(self, member: CommandedActor, heading: float, jumped: Collection[str]) -> float:
        """Smoothed rad/s at which an actor turns; it has come to a new heading (rad)."""
        actor, before, member.heading = member.spec.id, member.heading, heading
        if before is None or actor in jumped:
            return 0.0
        rate = self._turning.get(actor, 0.0)
        rate += self._share * (turn_between(before, heading) / self._dt - rate)
        if abs(rate) > _STRAIGHT:
            self._turning[actor] = rate
        else:
            self._turning.pop(actor, None)
        return rate

    def _note(
        self, actor: str, state: ActorState, across: float, limit: float, road: RoadCondition
    ) -> None:
        time, v, a = self._steps * self._dt, state.v, state.a
        found = self._last.get(actor)
        if found is None or time > found.end + _APART:
            place = (state.lane_position, state.x, state.y)
            found = Overload(actor, time, time, v, a, across, limit, road, *place)
            self._last[actor] = found
            self.overloads.append(found)
        elif math.hypot(a, across) > math.hypot(found.along, found.across):
            found.speed, found.along, found.across = v, a, across
            found.place, found.x, found.y = state.lane_position, state.x, state.y
        found.end = time
