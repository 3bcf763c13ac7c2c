"""The grip limit: motions that no vehicle can drive.

The commanded motions are checked, so the rule is the same in all worlds: - the sum of the squares
of the longitudinal and lateral accelerations is at most (mu g)^2; - the lateral acceleration is
below that of rollover; - the lateral speed does not change faster than that. Teleports, replays,
non-physical motions and external drivers are not checked.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.grip.friction import GRAVITY, RoadCondition, adhesion_of
from osc2tx_runtime.world.grip.overload import Excess, Overload

from .actor_motion import CommandedActor

_SMOOTHING = 0.1  # s: headings have small kinks where roads join
_AT_THE_LIMIT = 1.01  # at the limit there is no excess
_STRAIGHT = 1e-6  # rad/s: a lower rate counts as straight
_APART = 1.0  # s: closer overloads of one actor count as one
_AT_ONCE = 0.1  # m/s: a larger change of the lateral speed is a jump

Place = tuple[str, str, int]


class FrictionWatch:
    """Checks all vehicles after each step.

    Attributes:
        overloads: The overloads in order of time, one for each actor and position.
    """

    def __init__(self, dt: float) -> None:
        self.overloads: list[Overload] = []
        self._dt = dt
        self._share = dt / (_SMOOTHING + dt)
        self._turning: dict[str, float] = {}  # smoothed yaw rates (rad/s) of turning actors
        self._last: dict[tuple[str, Excess], Overload] = {}
        self._at: dict[tuple[Place, Excess], Overload] = {}
        self._steps = 0

    def step(
        self, members: Iterable[CommandedActor], jumped: Collection[str], road: RoadCondition
    ) -> None:
        """Check the references after a step.

        Args:
            members: All actors.
            jumped: The actors that were teleported in it.
            road: Condition of the roads.
        """
        self._steps += 1
        for actor in jumped:
            self._turning.pop(actor, None)
        turning = self._turning
        for member in members:
            if member.wheels is None or (member.still and member.spec.id not in turning):
                continue
            state = member.reference
            if (
                state.h == member.heading
                and state.lateral_speed == member.aside
                and not state.a
                and member.bound is not None
                and member.residual is None
                and member.spec.id not in turning
            ):
                continue  # straight, the usual case
            self._look(member, jumped, road)

    def _look(self, member: CommandedActor, jumped: Collection[str], road: RoadCondition) -> None:
        """Checks one vehicle."""
        state, limit = member.reference, adhesion_of(road) * GRAVITY
        across, aside = 0.0, self._set_aside(member, jumped)
        if abs(aside) > _AT_ONCE + limit * self._dt:
            member.heading = state.h  # a jump is not a turn
            if member.is_physical:
                self._note(member, "jumps", (0.0, aside), limit, road)
        if state.h != member.heading or member.spec.id in self._turning:
            across = state.v * self._turned(member, state.h, jumped)
        least = _AT_THE_LIMIT * min(limit, member.spec.limits.overturn)
        if across * across + state.a * state.a > least * least and member.is_physical:
            self._judge(member, state.a, across, limit, road)

    def _judge(
        self,
        member: CommandedActor,
        along: float,
        across: float,
        limit: float,
        road: RoadCondition,
    ) -> None:
        """Notes an excess of longitudinal or lateral acceleration (m/s^2)."""
        overturn = member.spec.limits.overturn
        if abs(across) > _AT_THE_LIMIT * overturn and overturn < limit:
            self._note(member, "overturns", (0.0, across), overturn, road)
        elif across * across + along * along > (_AT_THE_LIMIT * limit) ** 2:
            self._note(member, "slides", (along, across), limit, road)

    def _set_aside(self, member: CommandedActor, jumped: Collection[str]) -> float:
        """Change of the lateral speed (m/s) in this step, for an actor in a lane."""
        before, now = member.aside, None
        if member.bound is not None:
            now = member.reference.lateral_speed
            if member.residual is not None:
                now -= member.residual.drift(member.reference.v)
        member.aside = now
        if before is None or now is None or member.spec.id in jumped:
            return 0.0
        return now - before

    def _turned(self, member: CommandedActor, heading: float, jumped: Collection[str]) -> float:
        """Smoothed yaw rate (rad/s) of an actor with a new heading (rad)."""
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
        self,
        member: CommandedActor,
        excess: Excess,
        rates: tuple[float, float],
        limit: float,
        road: RoadCondition,
    ) -> None:
        time, state, actor = self._steps * self._dt, member.reference, member.spec.id
        found = self._last.get((actor, excess))
        goes_on = found is not None and time <= found.last + _APART
        if found is None or not goes_on:
            key = _place_of(member), excess
            found = self._at.get(key)
            if found is None:
                begun = (actor, time, time, time, 0, excess, state.v, *rates, limit, road)
                found = Overload(*begun, state.lane_position, state.x, state.y)
                self._at[key] = found
                self.overloads.append(found)
            else:
                found.again += 1
            self._last[actor, excess] = found
        if found.measure**2 < rates[0] ** 2 + rates[1] ** 2:
            found.speed, (found.along, found.across) = state.v, rates
            found.place, found.x, found.y = state.lane_position, state.x, state.y
        found.last = time
        if not found.again:
            found.end = time


def _place_of(member: CommandedActor) -> Place:
    """Key of a position of an actor: a lane of a road; off the roads one key for all."""
    place = member.reference.lane_position
    return (member.spec.id, "", 0) if place is None else (member.spec.id, place.road, place.lane)
