"""What the embedded world knows, and the XML has to agree with: sizes, limits, courses, maps.

The only file of the compiler's back ends that imports the runtime library: there must be one table
of sizes, one set of formulas for profiles and one reader of OpenDRIVE.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Literal, NamedTuple, cast

from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.diagnostics import Span
from osc2tx_runtime.along import way_through
from osc2tx_runtime.behaviour import schedule
from osc2tx_runtime.errors import InputError, ScenarioError, SettingsError
from osc2tx_runtime.map_search import DEFAULT_MAP, SUFFIXES, find_map
from osc2tx_runtime.opendrive import LanePosition, MapError, Pose, RoadMap, read_map
from osc2tx_runtime.paths import (
    PathError,
    curve_of_path,
    curve_of_trajectory,
    stretch,
)
from osc2tx_runtime.poses import road_entry
from osc2tx_runtime.settings import parse_signal, parse_spawn
from osc2tx_runtime.values import Path as Way
from osc2tx_runtime.values import Pose as WayPose
from osc2tx_runtime.values import Trajectory
from osc2tx_runtime.world.acceleration import acceleration_profile
from osc2tx_runtime.world.catalogue import COMFORT, Limits, Shape, limits_of, shape_of
from osc2tx_runtime.world.commands import AccelerationChange, SpeedChange
from osc2tx_runtime.world.friction import ADHESION, held_by, road_condition
from osc2tx_runtime.world.lamps import Lamp, Meaning, lamps_that_mean
from osc2tx_runtime.world.lanes import lane_with_number
from osc2tx_runtime.world.lateral import shift_profile
from osc2tx_runtime.world.longitudinal import speed_profile
from osc2tx_runtime.world.motion import CRUISE as SPEEDS_AT_START
from osc2tx_runtime.world.profiles import (
    QUINTIC_PEAK,
    DynamicProfile,
    Linear,
    Profile,
    Quintic,
    SCurve,
)
from osc2tx_runtime.world.signals import Signals
from osc2tx_runtime.world.towing import DRAWBAR

__all__ = [
    "ADHESION",
    "COMFORT",
    "CRUISE",
    "DEFAULT_MAP",
    "DRAWBAR",
    "QUINTIC_PEAK",
    "Lamp",
    "LanePosition",
    "Limits",
    "Linear",
    "Pose",
    "Profile",
    "Quintic",
    "Roads",
    "SCurve",
    "Shape",
    "Waypoint",
    "course_of_acceleration",
    "course_of_shift",
    "course_of_speed",
    "drawn",
    "held_by",
    "limits_of",
    "map_places",
    "plan_starts",
    "read_signal",
    "read_spawn",
    "road_condition",
    "roads_of",
    "shape_of",
]


CRUISE = SPEEDS_AT_START["person"]
"""Speed (m/s) at which walkers set out."""


def course_of_speed(
    start: float,
    target: float,
    profile: str,
    peak: float | None,
    duration: float | None,
    limits: Limits,
) -> Profile:
    """Return the course of a change of the speed (m/s) as the embedded world drives it."""
    change = SpeedChange(target, _known(profile), peak, duration)
    return speed_profile(change, start, limits)


def course_of_acceleration(
    start: float,
    target: float,
    profile: str,
    peak: float | None,
    duration: float | None,
    limits: Limits,
) -> Linear | Quintic:
    """Return the course of a change of the acceleration (m/s^2) as the embedded world drives it."""
    change = AccelerationChange(target, _known(profile), peak, duration)
    return acceleration_profile(change, start, limits)


def course_of_shift(
    distance: float, profile: str, peak: float | None, duration: float | None, limits: Limits
) -> Profile:
    """Return the course of a change of the place across the road (m)."""
    return shift_profile(0.0, distance, 0.0, (_known(profile), peak, duration), limits)


def _known(profile: str) -> DynamicProfile:
    match profile:
        case "none" | "constant" | "smooth" | "asap":
            return profile
    raise Inexpressible(f"`{profile}` is no profile of a rate")


class Waypoint(NamedTuple):
    """A point of a way.

    Attributes:
        time: Seconds since its start, if it has times.
        x: Metres.
        y: Metres.
        z: Metres.
        h: Heading (rad); `None`: that of the way.
    """

    time: float
    x: float
    y: float
    z: float
    h: float | None = None


SAMPLES = 12
"""Pieces into which a stretch of a smooth way is cut."""


def drawn(
    points: Sequence[Waypoint],
    *,
    is_timed: bool,
    is_smooth: bool,
    offsets: tuple[float, float],
) -> tuple[Waypoint, ...]:
    """Return the corners of a line that is as good as a way through points.

    Args:
        points: The points.
        is_timed: They have times.
        is_smooth: The way has no corners.
        offsets: Metres that are left out at its start and its end.

    Raises:
        Inexpressible: There is no such way.
    """
    poses = tuple(WayPose(p.x, p.y, p.z, yaw=p.h) for p in points)
    joined: Literal["smooth", "straight_line"] = "smooth" if is_smooth else "straight_line"
    try:
        if is_timed:
            curve = curve_of_trajectory(Trajectory(poses, [p.time for p in points], joined))
        else:
            curve = curve_of_path(Way(poses, joined))
        low, high = stretch(curve, *offsets)
    except PathError as error:
        raise Inexpressible(error.message) from None
    begin, end = curve.begin, curve.end
    if any(offsets):
        begin, end = curve.at_length(low), curve.at_length(high)
    places = [begin, *(knot for knot in curve.knots if begin < knot < end), end]
    if is_smooth and len(points) > 2:
        places = [
            left + (right - left) * part / SAMPLES
            for left, right in pairwise(places)
            for part in range(SAMPLES)
        ] + [end]
    turns = {round(curve.heading(place) or 0.0, 6) for place in places}
    is_even = is_smooth or len(turns) == 1
    found = []
    for place in places:
        x, y, z = curve.point(place)
        h = curve.yaw(place)
        h = curve.heading(place) if h is None and is_even else h
        found.append(Waypoint(place - begin, x, y, z, h))
    return tuple(found)


MOST_LANES = 8
"""Lanes beside each other among which one is looked for."""


class Roads:
    """A map that can be asked."""

    def __init__(self, road_map: RoadMap) -> None:
        """Take the map."""
        self.map = road_map
        self._signals = Signals(road_map)

    def numbered(self, number: int, edge: str, distance: float | None) -> LanePosition | None:
        """Return the first place on a lane with a number, so far (m) along its road.

        Without a distance it is where the road begins.
        """
        side: Literal["left", "right"] = "right" if edge == "right" else "left"
        seen: set[tuple[str, int]] = set()
        for point in self.map.spawn_points():
            direction = self.map.travel_direction(point.road, point.lane)
            if (point.road, direction) in seen:
                continue
            seen.add((point.road, direction))
            start = point if distance is None else road_entry(self.map, point)
            step = self.map.advance(start, distance or 0.0)
            if abs(step.travelled - (distance or 0.0)) > 1e-6:
                continue
            place = lane_with_number(self.map, step.position, number, side)
            if place is not None:
                return place
        return None

    def beside(self, place: LanePosition, lanes: int) -> LanePosition | None:
        """Return the lane so many to the left of a place; negative: to the right."""
        if lanes == 0:
            return place
        return self.map.neighbour(place, "left" if lanes > 0 else "right", abs(lanes))

    def with_number(self, place: LanePosition, number: int, edge: str) -> LanePosition | None:
        """Return the lane with a number at a place; `None` if there is none."""
        side: Literal["left", "right"] = "right" if edge == "right" else "left"
        return lane_with_number(self.map, place, number, side)

    def lanes_between(self, place: LanePosition, other: LanePosition) -> int | None:
        """Return how many lanes to the left another lane of the same road is; `None`: it is not."""
        for lanes in range(-MOST_LANES, MOST_LANES + 1):
            beside = self.beside(place, lanes)
            if beside is not None and (beside.road, beside.lane) == (other.road, other.lane):
                return lanes
        return None

    def ahead(self, place: LanePosition, distance: float) -> LanePosition | None:
        """Return the place so far (m) along the lane."""
        step = self.map.advance(place, distance)
        return step.position if abs(step.travelled - distance) < 1e-6 else None

    def pose(self, place: LanePosition) -> Pose:
        """Return where a place is."""
        return self.map.pose(place)

    def direction_at(self, x: float, y: float, z: float) -> float:
        """Return the heading (rad) of the nearest road."""
        place = self.map.locate(x, y, z)
        return 0.0 if place is None else self.map.pose(place).h

    def lamps(self, signal: str) -> tuple[Lamp, ...]:
        """Return the lamps of a traffic light.

        Raises:
            Inexpressible: There is no such light, or its lamps are not known.
        """
        try:
            return self._signals.lamps(signal)
        except ScenarioError as error:
            raise Inexpressible(error.message) from None

    def group(self, group: str) -> tuple[str, ...]:
        """Return the traffic lights of a group.

        Raises:
            Inexpressible: There is no such group.
        """
        try:
            return self._signals.members(group)
        except ScenarioError as error:
            raise Inexpressible(error.message) from None

    def group_of(self, signal: str) -> tuple[str, ...]:
        """Return the lights of the group that a traffic light belongs to."""
        group = self._signals.group_of(signal)
        return (signal,) if group is None else self.group(group)

    def meaning(self, signal: str, meaning: str) -> tuple[str, ...] | None:
        """Return the states of lamps that mean something; `None` if a light cannot say it."""
        return lamps_that_mean(self.lamps(signal), cast("Meaning", meaning))

    def locate(self, x: float, y: float, z: float) -> LanePosition | None:
        """Return the driving lane that contains a point; `None` if there is none."""
        return self.map.locate(x, y, z, max_distance=1e-3)

    def along(self, places: Sequence[LanePosition]) -> tuple[Waypoint, ...]:
        """Return the way along lanes through places.

        Raises:
            Inexpressible: There is no such way.
        """
        try:
            found = way_through(self.map, places)
        except ScenarioError as error:
            raise Inexpressible(error.message) from None
        return tuple(Waypoint(0.0, pose.x, pose.y, pose.z, pose.yaw) for pose in found)

    def is_right_hand(self, road: str) -> bool:
        """Whether a road has right-hand traffic."""
        return self.map.roads[road].right_hand_traffic


def roads_of(map_file: str | None, folders: Sequence[Path]) -> Roads | None:
    """Return a map, looked for as `osc2tx run` does; `None` if it is not found.

    Raises:
        Inexpressible: It is found and is no map.
    """
    wanted = Path(map_file or DEFAULT_MAP)
    if wanted.is_absolute() or ".." in wanted.parts:
        return None  # nothing outside of the folders is read
    try:
        return _read(find_map(map_file, [f for f in folders if f.exists()]))
    except InputError:
        return None


def map_places(map_file: str | None, folders: Sequence[Path]) -> list[Path]:
    """Return where a map is looked for, outside of the runtime library."""
    wanted = Path(map_file or DEFAULT_MAP)
    if wanted.is_absolute() or ".." in wanted.parts:
        return []
    return [
        place
        for entry in folders
        for place in (
            [entry] if entry.is_file() else [entry / f"{wanted}{suffix}" for suffix in SUFFIXES]
        )
    ]


def read_signal(text: str) -> tuple[str, float]:
    """Return name and time (s) of an event from outside, as `--signal` says it.

    Raises:
        Inexpressible: It says none.
    """
    try:
        return parse_signal(text)
    except SettingsError as error:
        raise Inexpressible(str(error)) from None


def read_spawn(text: str) -> tuple[str, LanePosition]:
    """Return an actor and its start, as `--spawn` says it.

    Raises:
        Inexpressible: It says none.
    """
    try:
        actor, (road, lane, s) = parse_spawn(text)
    except SettingsError as error:
        raise Inexpressible(str(error)) from None
    return actor, LanePosition(road, lane, s)


@cache
def _read(path: Path) -> Roads:
    try:
        return Roads(read_map(path))
    except MapError as error:
        raise Inexpressible(f"map {path.name} cannot be read: {error.message}") from None


MILLISECONDS = 1000
"""Steps of a second for plans of `parallel`: finer than any scenario writes times."""

Part = tuple[str, float | None, bool]


def plan_starts(
    parts: Sequence[Part],
    overlap: str,
    start_to_start: tuple[float, float] | None,
    end_to_end: tuple[float, float] | None,
    span: Span,
) -> list[float | None]:
    """Return when the members of a `parallel` start (s), as the embedded world plans it.

    Args:
        parts: Name, length (s) if it is known, and whether it is open-ended; the primary first.
        overlap: A kind of overlap (§7.3.13.2).
        start_to_start: Bounds of the offset of starts (s).
        end_to_end: Bounds of the offset of ends (s).
        span: The composition.

    Raises:
        Inexpressible: There is no plan, or only the run can tell whether it is kept.
    """
    kind = next((known for known in OVERLAPS if known == overlap), None)
    if kind is None:
        raise Inexpressible(f"`{overlap}` is no overlap", span)
    planned = [
        schedule.Part(name, None if length is None else round(length * MILLISECONDS), is_open)
        for name, length, is_open in parts
    ]
    try:
        sts, ete = schedule.spans_of(kind, _steps(start_to_start), _steps(end_to_end))
        plan = schedule.make_schedule(planned, sts, ete)
    except schedule.Unplannable as error:
        raise Inexpressible(f"the overlap `{overlap}` has no plan: {error}", span) from None
    if not ete.free and any(part.length is None and not part.open_ended for part in planned):
        reason = f"whether the overlap `{overlap}` is kept depends on lengths known only in the run"
        raise Inexpressible(reason, span)
    return [None if start is None else start / MILLISECONDS for start in plan.starts]


def _steps(bounds: tuple[float, float] | None) -> schedule.Span | None:
    if bounds is None:
        return None
    low, high = (round(bound * MILLISECONDS) for bound in bounds)
    return schedule.Span(low, high)


OVERLAPS = tuple(schedule.SPANS)
