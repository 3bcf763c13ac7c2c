"""Motion over seams of the map: lanes whose successor begins at another position or heading.

At a seam an actor keeps its position and its heading. Its offset from the lane, and its angle to
it, return to zero along a quintic over the distance driven, so the same path results at any speed
and step size. The path stays near the lane centre: if a kink is so sharp that this exceeds the grip
limit, the motion is reported like any other.
"""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, Seam

from .profiles import Quintic

_LEAST_WAY = 5.0  # m over which the smallest seam is smoothed
_ROOM = 0.4  # m of deviation from the centre at a kink
_CURVE = 5.8  # peak of the second derivative of a quintic, in units of change / duration^2
_BEND = 4.0  # the same from a slope, in units of slope / duration
_SWING = 0.2  # overshoot of a slope, in units of slope * duration
_MOST = 1.2  # rad: sharper turns are corners, which are not smoothed

Jump = tuple[float, float, float]
"""World x, y (m) and heading (rad) that a seam adds."""


class Residual:
    """The remaining offset from the seams behind an actor.

    Attributes:
        along: Metres ahead of its position in the lane.
        aside: Metres to the left of it.
        slope: Tangent of its angle to the left.

    Args:
        along: Initial `along`, at the seam.
        aside: Initial `aside`.
        slope: Initial `slope`.
        way: Metres over which it decays.
        sense: 1 forwards, -1 backwards.
    """

    def __init__(self, along: float, aside: float, slope: float, way: float, sense: float) -> None:
        self._along = Quintic(along, 0.0, way)
        self._aside = Quintic(aside, 0.0, way, sense * slope)
        self._way, self._sense = way, sense
        self._driven = 0.0
        self.along, self.aside, self.slope = along, aside, slope

    def driven(self, path: float) -> bool:
        """Advances by a distance (m); returns whether an offset remains."""
        self._driven += abs(path)
        at = self._driven
        self.along, self.aside = self._along.value(at), self._aside.value(at)
        self.slope = self._sense * self._aside.rate(at)
        return at < self._way

    @property
    def share(self) -> float:
        """Metres along the lane for each metre driven."""
        return 1.0 / math.hypot(1.0, self.slope)

    def drift(self, speed: float) -> float:
        """Resulting lateral speed (m/s), to the left."""
        return speed * self.slope * self.share

    def on(self, pose: Pose) -> Pose:
        """The pose of an actor for a nominal pose."""
        c, n = math.cos(pose.h), math.sin(pose.h)
        return pose._replace(
            x=pose.x + self.along * c - self.aside * n, y=pose.y + self.along * n + self.aside * c
        )


def crossed(
    road_map: RoadMap,
    before: LanePosition,
    after: LanePosition,
    residual: Residual | None,
    speed: float,
    comfort: float,
) -> Residual | None:
    """The offset after the seams between two positions of a step; unchanged without seams.

    Args:
        road_map: The map.
        before: Position in the lane at its start.
        after: Position at its end.
        residual: Residual before the step.
        speed: m/s.
        comfort: Lateral acceleration (m/s^2) that is comfortable.
    """
    seams = _between(road_map, before, after, backwards=speed < 0.0)
    if not seams:
        return residual
    here = road_map.pose(after)
    jump = _jump(seams, here, backwards=speed < 0.0)
    c, n = math.cos(here.h), math.sin(here.h)
    along, aside = -(jump[0] * c + jump[1] * n), jump[0] * n - jump[1] * c
    turn = jump[2]
    angle = -turn if abs(turn) <= _MOST else 0.0
    if residual is not None:
        c, n = math.cos(turn), math.sin(turn)
        along += residual.along * c + residual.aside * n
        aside += residual.aside * c - residual.along * n
        angle += math.atan(residual.slope)
    slope = math.tan(min(max(angle, -_MOST), _MOST))
    rate = abs(speed * slope)
    time = max(math.sqrt(_CURVE * abs(aside) / comfort), _BEND * rate / comfort)
    if rate:
        time = min(time, max(_ROOM / (_SWING * rate), math.sqrt(_CURVE * abs(aside) / comfort)))
    way = max(abs(speed) * time, _LEAST_WAY if rate < 1.0 else 0.0)
    return Residual(along, aside, slope, way, math.copysign(1.0, speed))


def _between(
    road_map: RoadMap, before: LanePosition, after: LanePosition, *, backwards: bool
) -> list[Seam]:
    """The seams of a step."""
    here, there = (before.road, before.lane), (after.road, after.lane)
    left, come = road_map.seams_of(*here), road_map.seams_of(*there)
    if not left and not come:
        return []
    ahead = (road_map.travel_direction(*here) > 0) != backwards
    return [
        seam
        for seam in dict.fromkeys((*left, *come))
        if _is_between(seam, before, after, ahead=ahead, backwards=backwards)
    ]


def _jump(seams: list[Seam], here: Pose, *, backwards: bool) -> Jump:
    """The offset that seams add to the pose of an actor behind them.

    An actor that continues straight at a kink is beside the lane at the end of the step.
    """
    sign = -1.0 if backwards else 1.0
    x = y = h = 0.0
    for seam in seams:
        dx, dy, turn = (sign * each for each in seam.jump)
        begin = seam.begin
        if backwards:
            begin = begin[0] + dx, begin[1] + dy
        drift = sign * math.dist(begin, here[:2]) * math.tan(min(max(turn, -_MOST), _MOST))
        x, y, h = x + dx - drift * math.sin(here.h), y + dy + drift * math.cos(here.h), h + turn
    return x, y, h


def _is_between(
    seam: Seam, before: LanePosition, after: LanePosition, *, ahead: bool, backwards: bool
) -> bool:
    """Whether a step goes over a seam of its lanes."""
    here, there, own = (before.road, before.lane), (after.road, after.lane), (seam.road, seam.lane)
    if seam.onto != own:
        out, into = (there, here) if backwards else (here, there)
        return own == out and (seam.onto == into or into in seam.beyond)
    if here == there:
        low, high = min(before.s, after.s), max(before.s, after.s)
        return own == here and low < seam.s <= high
    if own == here:  # already passed
        return seam.s > before.s if ahead else seam.s <= before.s
    return False
