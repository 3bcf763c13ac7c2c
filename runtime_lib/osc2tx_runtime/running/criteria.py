"""Criteria of a failed run, `--fail-on`.

The tree of a scenario determines whether its behavior succeeds. A criterion makes a run fail
whatever the result of the tree: a collision, a vehicle that leaves the lanes, a vehicle that passes
a stop line at red.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from osc2tx_runtime.language.settings import FAIL_ON
from osc2tx_runtime.opendrive import DRIVING

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.world.state import ActorState

_REACH = 1.0  # m beyond the distance of one step in which stop lines are searched


class Criteria:
    """The criteria of one run.

    Args:
        context: The run.
        wanted: Names of criteria; by default those of the settings.
        is_noted: Whether violations are noted in the trace.

    Attributes:
        broken: The violations of criteria: `collision of a and b at 3.20 s`.
    """

    def __init__(
        self,
        context: ExecutionContext,
        wanted: Iterable[str] | None = None,
        *,
        is_noted: bool = True,
    ) -> None:
        self._context = context
        self._is_noted = is_noted
        asked = context.settings.fail_on if wanted is None else wanted
        self._wanted = frozenset(asked) & frozenset(FAIL_ON)
        self._on_road: dict[str, bool] = {}
        self._lines: dict[str, tuple[str, float, ActorState]] = {}
        self._time = 0.0
        self.broken: list[str] = []
        self._look()

    def observe(self, step: int) -> None:
        """Check the criteria after a step."""
        if not self._wanted:
            return
        self._time = step * self._context.dt
        if "collision" in self._wanted:
            for one, other in self._context.world.collisions():
                self._break("collision", f"collision of {one} and {other}")
        self._look()

    def _look(self) -> None:
        if not self._wanted - {"collision"}:
            return
        context = self._context
        for actor_id in context.cast():
            if "vehicle" not in context.actors[actor_id].kinds:
                continue
            state = context.world.state(actor_id)
            if "off_road" in self._wanted:
                self._look_at_lane(actor_id, state)
            if "red_light" in self._wanted:
                self._look_at_lights(actor_id, state)

    def _look_at_lane(self, actor_id: str, state: ActorState) -> None:
        """Note a vehicle that was on a driving lane and no longer is."""
        place, road_map = state.lane_position, self._context.world.map
        here = place is not None and (
            road_map.lane_type(place.road, place.lane, place.s) in DRIVING
        )
        if self._on_road.get(actor_id) and not here:
            self._break("off_road", f"{actor_id} off the road")
        self._on_road[actor_id] = here

    def _look_at_lights(self, actor_id: str, state: ActorState) -> None:
        """Note a vehicle whose front has passed the stop line of a light showing stop."""
        ahead = self._lines.pop(actor_id, None)
        if ahead is not None:
            signal, gap, before = ahead
            if math.hypot(state.x - before.x, state.y - before.y) > gap:
                self._break("red_light", f"{actor_id} past the red light {signal}")
        reach = state.shape.front + abs(state.v) * self._context.dt + _REACH
        line = self._context.world.stop_line(state, None, reach) if state.v > 0.0 else None
        if line is not None and line.strict:
            self._lines[actor_id] = (line.signal, line.distance - state.shape.front, state)

    def _break(self, name: str, what: str) -> None:
        if self._is_noted:
            self._context.trace.criterion(name, what)
        self.broken.append(f"{what} at {self._time:.2f} s")
