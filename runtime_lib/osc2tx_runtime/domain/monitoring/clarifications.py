"""The modifiers and conditions that actions stand for (DSL 8.8: semantic clarifications)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.domain.modifiers import (
    Acceleration,
    KeepLane,
    KeepPosition,
    KeepSpeed,
    Lane,
    Lateral,
    Modifier,
    Speed,
    value_of,
)
from osc2tx_runtime.domain.modifiers.base import now
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.lanes import lanes_from_start, lanes_text
from osc2tx_runtime.domain.monitoring.registry import stands_for, unmonitored
from osc2tx_runtime.enums import At, SideLeftRight
from osc2tx_runtime.world.measuring.distances import (
    along_lanes,
    drift,
    gap_between,
    headway_between,
    lateral_on_road,
    side_gap,
    time_to_cover,
)

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actions.movement import acceleration, gaps_and_headways, lane, speed
    from osc2tx_runtime.domain.monitoring.phase import Phase


@stands_for("change_speed")
def change_speed(action: speed.ChangeSpeed, phase: Phase) -> Sequence[Modifier]:
    """The target, at the end."""
    return (Speed(value_of(action.target), at="end"),)


@stands_for("keep_speed")
def keep_speed(action: object, phase: Phase) -> Sequence[Modifier]:
    """The speed at the start."""
    return (KeepSpeed(),)


@stands_for("change_acceleration")
def change_acceleration(
    action: acceleration.ChangeAcceleration, phase: Phase
) -> Sequence[Modifier]:
    """The target, at the end."""
    return (Acceleration(value_of(action.target), at="end"),)


@stands_for("keep_acceleration")
def keep_acceleration(action: object, phase: Phase) -> Iterator[Condition]:
    """The acceleration over the first step, all the time; the standard has no modifier for it."""
    me = phase.me
    kept: float | None = None

    def measure() -> Reading | None:
        nonlocal kept
        if phase.elapsed == 0.0:
            return None  # it belongs to the step before the phase
        now = me().a
        kept = now if kept is None else kept
        return now, kept, kept

    yield Condition("keep_acceleration", "its acceleration", "acceleration", "all", measure)


@stands_for("remain_stationary")
def remain_stationary(action: object, phase: Phase) -> Sequence[Modifier]:
    """The position at the start, and no speed."""
    return KeepPosition(), Speed(0.0)


@stands_for("follow_lane")
def follow_lane(action: lane.FollowLane, phase: Phase) -> Sequence[Modifier]:
    """The lane, and the offset in it: all the time, or reached if a profile leads there."""
    offset = 0.0 if action.offset is None and action.offset_range is None else action.offset
    at: At = "all" if action.rate_profile == "none" else "end"
    return KeepLane(), Lateral(offset, distance_range=action.offset_range, at=at)


@stands_for("change_lane")
def change_lane(action: lane.ChangeLane, phase: Phase) -> Iterator[Modifier | Condition]:
    """Another lane at the end (DSL 8.8.3.3), the required one, and the offset in it."""
    lanes = lanes_from_start(phase)
    yield Lateral(value_of(action.offset), at="end")
    stated = None if action.side is None else now(action.side)
    count = 0 if stated == "same" else int(now(action.num_of_lanes))
    side = _side(stated, phase)
    if action.target is None and action.reference is None and side is not None:
        wanted = float(count if side == "left" else -count)
        text = lanes_text(phase, f"the lane {count} {side} of its lane at the start")
        yield Condition("change_lane", "its lane", "lane", "end", _at(lanes, wanted), text)
        return
    stays = lanes_text(phase, "a lane other than that of its start")
    measure = _elsewhere(lanes)
    yield Condition("change_lane", "its lane", "lane", "end", measure, lambda r: stays((0, 0, 0)))
    if action.target is None and action.reference is not None and (side is not None or not count):
        beside = {"side_of": action.reference, "side": side or "left"} if count else {}
        same = {} if count else {"same_as": action.reference}
        yield Lane(count or None, at="end", **same, **beside)  # type: ignore[arg-type]


def _elsewhere(lanes: Callable[[], float | None]) -> Callable[[], Reading | None]:
    def measure() -> Reading | None:
        found = lanes()
        return None if found is None else (abs(found), 1.0, float("inf"))

    return measure


def _at(lanes: Callable[[], float | None], wanted: float) -> Callable[[], Reading | None]:
    def measure() -> Reading | None:
        found = lanes()
        return None if found is None else (found, wanted, wanted)

    return measure


def _side(side: str | None, phase: Phase) -> SideLeftRight | None:
    """The side as left or right; None if it is drawn."""
    place = phase.first.lane_position
    if side in ("inside", "outside") and place is not None:
        right_hand = phase.world.map.roads[place.road].right_hand_traffic
        return "left" if (side == "inside") == right_hand else "right"
    if side == "left":
        return "left"
    return "right" if side == "right" else None


# --- gaps and headways ---------------------------------------------------------------------------


@stands_for("change_space_gap", "change_time_gap", "change_space_headway", "change_time_headway")
def change_gap(action: gaps_and_headways._ChangeGap, phase: Phase) -> Iterator[Condition]:
    """The gap or headway, at the end."""
    target = value_of(action.target)
    across = action.direction not in ("ahead", "behind")
    side = action.direction if not across else _side(action.direction, phase) or action.direction
    sign = 1.0 if side in ("ahead", "left") else -1.0
    yield _gap(action, phase, "end", "lateral" if across else "longitudinal", sign * target)


@stands_for("keep_space_gap", "keep_time_gap", "keep_space_headway", "keep_time_headway")
def keep_gap(action: gaps_and_headways._KeepGap, phase: Phase) -> Iterator[Condition]:
    """The gap or headway at the start, all the time."""
    yield _gap(action, phase, "all", action.direction, None)


def _gap(
    action: gaps_and_headways._OneAxis,
    phase: Phase,
    at: At,
    direction: Literal["longitudinal", "lateral"],
    target: float | None,
) -> Condition:
    """Return the condition on a gap or headway; positive if the actor is ahead or left.

    Args:
        action: The action.
        phase: Its phase.
        at: When it holds.
        direction: Of the gap.
        target: The size (m or s); None: its value at the start.
    """
    read = _gap_reader(action, phase, direction)
    wanted = read() if target is None else target
    kind = f"{'time' if action.timed else 'space'} {action.measure}"
    quantity = "position" if direction == "longitudinal" else "lateral position"
    if action.timed:
        quantity = "time"

    def measure() -> Reading | None:
        found = read()
        return None if found is None or wanted is None else (found, wanted, wanted)

    what = f"its {kind} to {action.reference.id}"
    return Condition(action.registered.name, what, quantity, at, measure)


def _gap_reader(
    action: gaps_and_headways._OneAxis, phase: Phase, direction: str
) -> Callable[[], float | None]:
    road_map, me, other = phase.world.map, phase.me, phase.track(action.reference.id, False)
    between = gap_between if action.measure == "gap" else headway_between

    def read() -> float | None:
        here, there = me(), other()
        if direction == "lateral":
            to_left = lateral_on_road(road_map, here, there)
            if to_left is None:
                return None
            size = side_gap(to_left, here.shape, there.shape)
            closing = drift(here, there) - here.lateral_speed
            rate = closing if size > 0.0 else -closing
        else:
            along = along_lanes(road_map, there, here)
            if along is None:
                return None
            size = between(along, here.shape, there.shape)
            rate = there.v if size > 0.0 else here.v
        return time_to_cover(size, rate) if action.timed else size

    return read


unmonitored("decides whether a deviation of the others is a failure", "physical_movement")
unmonitored("a collision is a line of the trace and a criterion of `--fail-on`", "avoid_collisions")
unmonitored("states the start position alone, which the placement checks", "location", "on_path")
unmonitored("the world draws a trailer along exactly", "tow_trailer")

unmonitored("only its modifiers state something", "move", "drive", "walk")
unmonitored("takes no time, so it has no phase", "assign_position", "assign_orientation")
unmonitored("takes no time, so it has no phase", "assign_speed", "assign_acceleration")
unmonitored("changes no motion state", "connect_trailer", "disconnect_trailer")
