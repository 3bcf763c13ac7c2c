"""Options of `osc2tx run` and starts of parallel members, computed by the runtime."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.diagnostics import Span
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.language.tree import parallel_schedule as schedule
from osc2tx_runtime.running.options import parse_signal, parse_spawn


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
