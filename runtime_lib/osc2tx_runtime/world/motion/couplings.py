"""Couplings of towing vehicles and trailers."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.state import ActorState

from .actor_motion import CommandedActor
from .towing import JACK_KNIFE, drawn


class Couplings:
    """Trailers on their hitches; a trailer may tow another trailer."""

    def __init__(self) -> None:
        self._towed: dict[str, str] = {}  # towing vehicle to trailer
        self._folded: set[str] = set()  # jack-knifed trailers
        self._news: list[tuple[str, str, float]] = []

    def attach(self, tow: str, trailer: str | None) -> str | None:
        """Couple a trailer, or None; return the trailer that is uncoupled."""
        before = self._towed.pop(tow, None)
        self._folded.discard(before or "")
        if trailer is not None:
            self._towed[tow] = trailer
        return before

    def trailer_of(self, tow: str) -> str | None:
        """Id of the trailer that a vehicle tows."""
        return self._towed.get(tow)

    def towed(self) -> Collection[str]:
        """The trailers."""
        return self._towed.values()

    def is_towed(self, actor: str) -> bool:
        """Whether an actor is towed."""
        return bool(self._towed) and actor in self._towed.values()

    def pairs(self) -> tuple[tuple[str, str], ...]:
        """The coupled pairs."""
        return tuple(self._towed.items()) if self._towed else ()

    def draw(
        self,
        members: Mapping[str, CommandedActor],
        states: list[ActorState],
        dt: float,
        road_map: RoadMap,
    ) -> None:
        """Compute the states of trailers from those of their towing vehicles, the foremost first.

        Args:
            members: All actors, with their states at the start of the step.
            states: States at its end, in the same order; those of trailers are replaced.
            dt: Length of the step (s).
            road_map: The map.
        """
        if not self._towed:
            return
        place = {actor: i for i, actor in enumerate(members)}
        waiting = [tow for tow in self._towed if not self.is_towed(tow)]
        for tow in waiting:
            trailer = self._towed[tow]
            member, new = members[trailer], states[place[tow]]
            pose, speed = drawn(member.state, new, members[tow].state, dt)
            a = (speed - member.state.v) / dt
            states[place[trailer]] = member.free_state(pose, speed, a, road_map)
            self._look(tow, trailer, turn_between(new.h, pose.h))
            if trailer in self._towed:
                waiting.append(trailer)

    def _look(self, tow: str, trailer: str, angle: float) -> None:
        """Note when a trailer jack-knifes (rad)."""
        if abs(angle) <= JACK_KNIFE:
            self._folded.discard(trailer)
        elif trailer not in self._folded:
            self._folded.add(trailer)
            self._news.append((tow, trailer, angle))

    def take_folded(self) -> list[tuple[str, str, float]]:
        """Returns the jack-knives since the last call: towing vehicle, trailer, angle (rad)."""
        news, self._news = self._news, []
        return news
