"""Motion on the lane centre at constant speed: that of nearly all actors in nearly all steps.

Constant values are looked up once for a stretch of the lane. The rest is computed as in
`MovingActor` and `LaneCursor`, in the same order, so the states are identical to the last digit.
"""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import LanePosition, Stretch
from osc2tx_runtime.opendrive.geometry import wrap
from osc2tx_runtime.opendrive.model import new_tuple
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.state import ActorState


class Cruise:
    """An actor that moves equally in each step.

    Args:
        place: Its position.
        stretch: The stretch of its lane.
        path: Metres per step, negative backwards.
        state: Its state there.

    Attributes:
        way: Upper bound of the distance (m) that its corners move in a step.
    """

    __slots__ = (
        "_along",
        "_cos",
        "_h",
        "_heading",
        "_place",
        "_shape",
        "_sin",
        "_speed",
        "_stretch",
        "way",
    )

    def __init__(
        self, place: LanePosition, stretch: Stretch, path: float, state: ActorState
    ) -> None:
        self._place = place
        self._stretch = stretch
        self._along = path * stretch.direction
        self._speed = state.v
        self._shape: Shape = state.shape
        self._h, self._sin, self._cos, self._heading = math.nan, 0.0, 1.0, 0.0
        turn = abs(path * stretch.curvature) / stretch.rate
        self.way = abs(path) + state.shape.reach * turn

    def after(self) -> ActorState | None:
        """State at the next step; None beyond the end of the stretch."""
        place = self._place
        begin, end, node, length, rate, t, direction, segment, start, _ = self._stretch
        s = node + (length + (place.s - node) * rate + self._along - length) / rate
        if not begin <= s < end:
            return None
        x, y, h, _ = segment.at(s - start)
        if h != self._h:
            self._h, self._sin, self._cos = h, math.sin(h), math.cos(h)
            self._heading = wrap(h if direction > 0 else h + math.pi)
        place = self._place = new_tuple(LanePosition, (place.road, place.lane, s, place.offset))
        x, y = x - t * self._sin, y + t * self._cos
        return new_tuple(
            ActorState,
            (x, y, 0.0, self._heading, self._speed, 0.0, place, 0.0, self._shape, 0.0, 0.0),
        )
