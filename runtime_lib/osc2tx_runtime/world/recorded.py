"""A world with the states of a trace: it can be read, not moved."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from osc2tx_runtime.opendrive import LanePosition, RoadMap

from .embedded import NOBODY, EmbeddedWorld
from .protocol import ControlMode
from .state import ActorState


class RecordedWorld(EmbeddedWorld):
    """Holds the states of one instant of a trace; its actors are placed as in a run.

    Args:
        road_map: The road map.
        dt: Length of a step (s).
        controls: Control modes of the actors, by id; `exact` for all others.
    """

    def __init__(self, road_map: RoadMap, dt: float, controls: Mapping[str, ControlMode]) -> None:
        super().__init__(road_map, dt)
        self._controls = controls

    def control(self, actor: str) -> ControlMode:
        """The control mode of an actor."""
        return self._controls.get(actor, "exact")

    def unsteady(self) -> tuple[str, ...]:
        """All of them: any may have changed."""
        return self._ids

    def show(self, lines: Mapping[str, Mapping[str, Any]]) -> None:
        """Take the states of an instant: `state` lines of the trace, by actor.

        Raises:
            KeyError, TypeError, ValueError: A line is not a state.
        """
        before = [member.state for member in self._members]
        for actor, line in lines.items():
            member = self._cast.get(actor)
            if member is not None:
                member.state = member.reference = self._read(member.state, line)
        self._track.add(self._ids, before, NOBODY)

    def _read(self, known: ActorState, line: Mapping[str, Any]) -> ActorState:
        """The state of a line, with the known shape; the lateral speed follows from the heading."""
        x, y, z, h, v, a = (_number(line[name]) for name in ("x", "y", "z", "h", "v", "a"))
        place, aside = None, 0.0
        if line["road"] is not None and line["s"] is not None:
            road, lane = str(line["road"]), int(line["lane"])
            place = LanePosition(road, lane, _number(line["s"]), _number(line["offset"]))
            aside = v * math.sin(h - self.map.pose(place).h)
        pitch, roll = (_number(line.get(name, 0.0)) for name in ("pitch", "roll"))
        return known._replace(
            x=x,
            y=y,
            z=z,
            h=h,
            v=v,
            a=a,
            pitch=pitch,
            roll=roll,
            lane_position=place,
            lateral_speed=aside,
        )


def _number(value: Any) -> float:
    """A number of a trace; nan if it is unknown there."""
    return math.nan if value is None else float(value)
