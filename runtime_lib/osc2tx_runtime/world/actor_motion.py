"""The commands of one actor, and their execution."""

from __future__ import annotations

import math
from dataclasses import dataclass

from osc2tx_runtime.opendrive import RoadMap

from .actor_step import ANY_LANE, CRUISE, Moving, cruise_of
from .attitude_control import Turning
from .commands import Command, FollowRoute, KeepLane, RunOut, Turn
from .curve_following import course_of
from .lane_return import turn_from
from .lateral import (
    HoldOffset,
    Impossible,
    lateral_of,
)
from .longitudinal import acceleration_of, longitudinal_of
from .protocol import PENDING, REACHED, Progress
from .route_following import Way

__all__ = ["ANY_LANE", "CRUISE", "Body", "cruise_of"]


@dataclass(slots=True)
class Body(Moving):
    """An actor with what it is asked for."""

    def pursue_speed(self, command: Command | None) -> None:
        """Puts a longitudinal command to work; None holds the speed."""
        if command is None:
            self._speed = None
            return
        slips = self.wheels is not None and self.wheels.slipping
        now = self.state.a if slips else acceleration_of(self._speed, self.state)
        state = self.state._replace(a=now)
        self._speed = longitudinal_of(command, state, self.limits, self.route)

    def pursue_side(self, command: Command | None, road_map: RoadMap) -> None:
        """Puts a lateral command to work; None keeps the lane, or returns to one."""
        if self._way is not None:
            self.route, self._way = self._way.before, None
        if isinstance(command, FollowRoute):
            self._way = Way(command, road_map, self.route)
            self.route, command = self._way.route, KeepLane()
        course = course_of(command, self.state, self.limits)
        if course is not None:
            self._course, self.bound, self._home = course, None, None
            self._side = HoldOffset()
            return
        returned = self._course is not None
        if returned:
            self._course = None
            self._return_to_lane(road_map)
            if self.bound is not None and (command is None or isinstance(command, KeepLane)):
                return  # on its way to the middle of the lane
        if self._home is not None:
            held = command is None or isinstance(command, KeepLane)
            self._side = HoldOffset() if held else Impossible(f"{self.spec.id} is in no lane yet")
            return
        if self.bound is None:
            self._pursue_heading(command)
            return
        state = self.state
        here, rate = state.lane_position or self.bound, state.lateral_speed
        if returned:
            here, rate = self.bound, state.v * math.sin(turn_from(road_map, self.bound, state))
        self.bound, self._side = lateral_of(
            command,
            road_map,
            self.bound,
            here,
            (state.x, state.y, rate),
            self._side,
            self.limits,
        )

    def _pursue_heading(self, command: Command | None) -> None:
        self._turning = Turning(command) if isinstance(command, Turn) else None
        self._side = HoldOffset()
        if command is not None and not isinstance(command, KeepLane | Turn):
            self._side = Impossible(
                f"{self.spec.id} is not on a driving lane, so it cannot change or follow one"
            )

    def speed_progress(self) -> Progress:
        """Progress of the longitudinal command."""
        if self._hindrance is not None:
            return Progress(False, self._hindrance)
        progress = REACHED if self._speed is None else self._speed.progress()
        lags = self.wheels is not None and self.wheels.slipping
        return PENDING if lags and progress.done else progress

    @property
    def _hindrance(self) -> str | None:
        """Why it cannot go on; the end of the road is none for who wanted to go to it."""
        sliding = None if self.wheels is None else self.wheels.sliding
        arrived = self._way is not None and self._way.progress().done
        return sliding if arrived else self.blocked or sliding

    def side_progress(self) -> Progress:
        """Progress of the lateral command."""
        if self._hindrance is not None:
            return Progress(False, self._hindrance)
        if self._course is not None:
            return self._course.progress()
        if self._way is not None:
            return self._way.progress()
        lost = isinstance(self._side, Impossible)
        if self.bound is not None or self._home is not None or lost:
            return self._side.progress()
        return REACHED if self._turning is None else self._turning.progress(self.state)

    def drift(self, aside: float, road_map: RoadMap) -> None:
        """Has a lateral speed (m/s) at the start."""
        if self.bound is not None:
            state = self._state_on_lane(self.bound, self.state.v, aside, 0.0, road_map)
            self.state = state
            self.pursue_side(RunOut(aside), road_map)
