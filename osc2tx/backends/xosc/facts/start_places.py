"""Start places, the options and the plans of runs, computed by the runtime."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.backends.xosc.facts import refusing
from osc2tx.backends.xosc.facts.actors import Shape
from osc2tx.backends.xosc.facts.map_search import MapSegment
from osc2tx.backends.xosc.facts.maps import Lane, LanePosition, Pose, Roads
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import Inexpressible, NoPlace
from osc2tx_runtime.domain.placing.default_starts import TakenBy
from osc2tx_runtime.domain.placing.start_room import Placed, StartRoom
from osc2tx_runtime.domain.routes.lane_coordinates import place_at_distance
from osc2tx_runtime.language.tree import parallel_schedule as schedule
from osc2tx_runtime.running.options import parse_signal, parse_spawn
from osc2tx_runtime.world.measuring.collision import Box, box_of
from osc2tx_runtime.world.motion.towing import pose_behind
from osc2tx_runtime.world.state import ActorState


@refusing(NoPlace)
def open_place(
    roads: Roads,
    name: str,
    lane: Lane | None,
    distance: float | None,
    segment: MapSegment | None,
    taken_by: TakenBy,
) -> LanePosition:
    """Return where an actor starts whose place no other one and no point says.

    Lane, distance from the start of the road (m) and piece of road are any that is `None`.

    Raises:
        NoPlace: There is no such place.
    """
    if segment is None:
        return roads.starts.default(name, lane, distance, taken_by)
    return roads.starts.on_path(name, segment, lane, distance, taken_by)


@refusing(NoPlace)
def given_place(roads: Roads, name: str, spawn: LanePosition, lane: Lane | None) -> LanePosition:
    """Return the place of `--spawn`, checked against map and scenario.

    Raises:
        NoPlace: The map has no such place, or it is in another lane than the scenario says.
    """
    return roads.starts.given(name, spawn, lane, None)


def box_at(pose: Pose, shape: Shape) -> Box:
    """Return the room that an actor takes."""
    return box_of(_state(pose, shape))


def trailer_pose(tow: Pose, tow_shape: Shape, trailer: Shape) -> Pose:
    """Return where a trailer is, in line with what tows it."""
    return pose_behind(_state(tow, tow_shape), trailer)


def _state(pose: Pose, shape: Shape) -> ActorState:
    x, y, z, h = map(float, pose[:4])
    return ActorState(x, y, z, h, 0.0, 0.0, None, 0.0, shape)


# --- options and plans of runs --------------------------------------------------------------------


@refusing()
def read_signal(text: str) -> tuple[str, float]:
    """Return name and time (s) of an event from outside, as `--signal` says it."""
    return parse_signal(text)


@refusing()
def read_spawn(text: str) -> tuple[str, LanePosition]:
    """Return an actor and its start, as `--spawn` says it."""
    actor, (road, lane, s) = parse_spawn(text)
    return actor, LanePosition(road, lane, s)


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

    Each part, the primary first, has a name, a length (s) if it is known, and may be open-ended.
    The overlap is a kind (§7.3.13.2), with bounds of the offsets of starts and of ends (s).

    Raises:
        Inexpressible: There is no plan, or only the run can tell whether it is kept.
    """
    planned = [
        schedule.Part(name, None if length is None else round(length * MILLISECONDS), is_open)
        for name, length, is_open in parts
    ]
    try:
        sts, ete = schedule.spans_of(overlap, _steps(start_to_start), _steps(end_to_end))
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
