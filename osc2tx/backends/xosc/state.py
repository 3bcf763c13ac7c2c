"""Known state of an actor while the tree is flattened: speed, lane, pose."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx_shared.classes import dataclass, replace

LONGITUDINAL, LATERAL, WAY = "longitudinal", "lateral", "way"
"""Domains that actions control; `way` is the motion of those off the lanes, which just goes on."""


class Interval(NamedTuple):
    """Where a value lies."""

    low: float
    high: float

    @property
    def is_known(self) -> bool:
        """Whether it is one value."""
        return self.low == self.high

    def over(self, other: Interval) -> Interval:
        """Return the interval that holds both."""
        return Interval(min(self.low, other.low), max(self.high, other.high))


def known(value: float) -> Interval:
    """Return the interval of one value."""
    return Interval(value, value)


CENTRE = Interval(0.0, 0.0)
"""Of a lane."""


class Demand(NamedTuple):
    """The most that a scenario asks of the motion of an actor.

    Attributes:
        speed: m/s.
        acceleration: m/s^2.
        deceleration: m/s^2.
        jumps: Its speed may change in no time, too.
    """

    speed: float = 0.0
    acceleration: float = 0.0
    deceleration: float = 0.0
    jumps: bool = False

    def over(self, other: Demand) -> Demand:
        """Return what covers both."""
        return Demand(
            max(self.speed, other.speed),
            max(self.acceleration, other.acceleration),
            max(self.deceleration, other.deceleration),
            self.jumps or other.jumps,
        )


@dataclass(frozen=True, slots=True)
class ActorState:
    """What is known about an actor.

    Attributes:
        speed: m/s; `None` if it may be anything.
        offset: Metres left of the centre of its lane; `None` if it may be anything.
        lane: The lane it is in; its `s` is that of the start. `None` if unknown.
        pose: Where it is, for those off the lanes; `None` if unknown.
        aim: Speed (m/s) that its last change had as its goal; `None` without one, or if
            there are several.
        rate: Acceleration (m/s^2) that an action may keep; `None` if it may be anything.
        jumped: The speed may have changed in no time before, or evenly up to the end, and not again
            since then.
        unfinished: What may still be changing when the last action has ended, by domain, with the
            event that changes it.
    """

    speed: Interval | None = None
    offset: Interval | None = CENTRE
    lane: LanePosition | None = None
    pose: Pose | None = None
    aim: float | None = None
    rate: float | None = 0.0
    jumped: bool = False
    unfinished: tuple[tuple[str, str], ...] = ()

    @property
    def known_speed(self) -> float | None:
        """Its speed (m/s), if it is known to be just one."""
        return self.speed.low if self.speed is not None and self.speed.is_known else None

    @property
    def is_changing_speed(self) -> bool:
        """Whether a change of its speed may not be over."""
        return any(domain == LONGITUDINAL for domain, _ in self.unfinished)

    def with_unfinished(self, domain: str, event: str) -> ActorState:
        """Return the state in which an event may not be over."""
        return replace(self, unfinished=(*self._others(domain), (domain, event)))

    def finished(self, domain: str) -> ActorState:
        """Return the state in which nothing changes in a domain."""
        found = replace(self, unfinished=self._others(domain))
        if domain == LONGITUDINAL:
            return replace(found, rate=0.0, jumped=False)
        return found

    def going_on(self, other: ActorState) -> ActorState:
        """Return the state in which what changes goes on as in another one."""
        return replace(self, rate=other.rate, jumped=other.jumped)

    def goes_on_as(self, other: ActorState) -> bool:
        """Whether it is as fast as in another state, and at the same place in its lane."""
        return (self.speed, self.lane, self.offset) == (other.speed, other.lane, other.offset)

    def _others(self, domain: str) -> tuple[tuple[str, str], ...]:
        return tuple(pair for pair in self.unfinished if pair[0] != domain)


NOTHING_KNOWN = ActorState(offset=None, rate=None)


def either(a: Mapping[str, ActorState], b: Mapping[str, ActorState]) -> dict[str, ActorState]:
    """Return what is known if one of two courses was taken."""
    return {name: merged(a[name], b[name]) for name in a}


def merged(a: ActorState, b: ActorState) -> ActorState:
    """Return what is known about an actor that is in one of two states."""
    if a == b:
        return a
    unfinished = tuple(dict.fromkeys((*a.unfinished, *b.unfinished)))
    return ActorState(
        speed=None if a.speed is None or b.speed is None else a.speed.over(b.speed),
        offset=None if a.offset is None or b.offset is None else a.offset.over(b.offset),
        lane=a.lane if a.lane == b.lane else None,
        pose=a.pose if a.pose == b.pose else None,
        aim=b.aim if a.aim is None else a.aim if b.aim in (None, a.aim) else None,
        rate=a.rate if a.rate == b.rate else None,
        jumped=a.jumped or b.jumped,
        unfinished=unfinished,
    )
