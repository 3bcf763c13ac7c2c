"""Scheduling of the members of a `parallel`, before the run.

The first member is the primary, the others are secondaries. For each secondary the composition
bounds two offsets, in steps:

    start to start = start(secondary) - start(primary)
    end to end     = end(secondary)   - end(primary)

A member has a length in steps, is open-ended (of any length), or only the run determines its
length. With known lengths the plan satisfies the bounds; otherwise the members start as near to the
primary as the bounds allow, and the composition watches the ends. Each secondary is planned
independently, so their order has no influence.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

from osc2tx_shared.classes import dataclass
from osc2tx_shared.overlaps import OFFSETS

Overlap = Literal["equal", "start", "end", "initial", "final", "inside", "full", "any"]
Steps = float  # a whole number, or infinite
INF = math.inf


@dataclass(frozen=True, slots=True)
class Span:
    """Steps from `low` to `high`, both included."""

    low: Steps = -INF
    high: Steps = INF

    @property
    def free(self) -> bool:
        """Whether it is unbounded."""
        return self == FREE

    def meet(self, other: Span) -> Span:
        """Return the intersection; `low` is above `high` if it is empty."""
        return Span(max(self.low, other.low), min(self.high, other.high))

    def nearest(self, steps: Steps) -> int:
        """Return the number in the span that is nearest to `steps`."""
        return int(max(self.low, min(self.high, steps)))


FREE, ENDLESS = Span(), Span(0)
SPANS: dict[str, tuple[Span, Span]] = {
    kind: (Span(*starts), Span(*ends)) for kind, (starts, ends) in OFFSETS.items()
}


class Unplannable(Exception):
    """No schedule satisfies the bounds, or this cannot be known; the text states why."""


@dataclass(frozen=True, slots=True)
class Part:
    """A member for the plan: its steps (None: the run determines them), open-ended or not."""

    name: str
    length: int | None
    open_ended: bool = False


@dataclass(frozen=True, slots=True)
class Schedule:
    """A plan.

    Attributes:
        starts: Start of each member in steps from the start of the composition, the primary first;
            None for one that starts when the primary ends.
        primary_length: Steps of the primary; None if the run determines it.
        end_to_end: Bounds for the ends of the secondaries.
        length: Steps of the whole; None if the run determines it.
    """

    starts: tuple[int | None, ...]
    primary_length: int | None
    end_to_end: Span
    length: int | None


def spans_of(overlap: str, start_to_start: Span | None, end_to_end: Span | None) -> list[Span]:
    """Return the bounds of start to start and end to end.

    Raises:
        Unplannable: The offsets contradict the overlap.
    """
    found = []
    for kind, offset, what in zip(
        SPANS[overlap], (start_to_start, end_to_end), ("start_to_start", "end_to_end"), strict=True
    ):
        both = kind if offset is None else kind.meet(offset)
        if both.low > both.high:
            raise Unplannable(f"{what} contradicts it")
        found.append(both)
    return found


def make_schedule(parts: Sequence[Part], sts: Span, ete: Span, frame: Span = ENDLESS) -> Schedule:
    """Plan a parallel composition.

    Args:
        parts: The members that take time, the primary first; there may be none.
        sts: Bounds of start to start.
        ete: Bounds of end to end.
        frame: Possible steps of the whole.

    Raises:
        Unplannable: There is no schedule.
    """
    least = int(frame.low)
    if not parts:
        return Schedule((), least, ete, least)
    primary, secondaries = parts[0], parts[1:]
    length = primary.length
    if primary.open_ended:
        length = open_primary_length(secondaries, sts, ete, least)
    offsets = [offset_of(part, primary, length, sts, ete, secondaries) for part in secondaries]
    known = [offset for offset in offsets if offset is not None]
    if length is not None and len(known) == len(offsets):
        offsets = [*framed(parts, length, known, sts, ete, frame)]
    shift = -min([0, *(offset for offset in offsets if offset is not None)])
    starts = (shift, *(None if offset is None else offset + shift for offset in offsets))
    return Schedule(starts, length, ete, whole_length(parts, starts, length, ete))


def framed(
    parts: Sequence[Part], length: int, offsets: list[int], sts: Span, ete: Span, frame: Span
) -> list[int]:
    """Return offsets with which the whole takes as long as it may; they are moved if need be.

    One member after the other starts later, then earlier, as far as the bounds allow and all of
    them have an instant in common.

    Raises:
        Unplannable: The whole is too short or too long in any case.
    """
    lengths = [part.length for part in parts[1:] if part.length is not None]
    if len(lengths) < len(offsets):
        return offsets
    for is_later in (True, False):
        for index, own in enumerate(lengths):
            missing = frame.low - _whole(length, offsets, lengths)
            if missing <= 0:
                break
            others = [(0, length), *zip(offsets, lengths, strict=True)]
            del others[index + 1]
            start, end = max(o for o, _ in others), min(o + n for o, n in others)
            allowed = _fitting(length, own, sts, ete).meet(Span(start - own, end))
            first, last = min(o for o, _ in others), max(o + n for o, n in others)
            wanted = first + frame.low - own if is_later else last - frame.low
            if allowed.low <= allowed.high:
                offsets[index] = allowed.nearest(wanted)
    whole = _whole(length, offsets, lengths)
    if not frame.low <= whole <= frame.high:
        raise Unplannable(
            f"the composition takes {'less' if whole < frame.low else 'more'} time than allowed"
        )
    return offsets


def _whole(length: int, offsets: Sequence[int], lengths: Sequence[int]) -> int:
    ends = [length, *(o + n for o, n in zip(offsets, lengths, strict=True))]
    return max(ends) - min([0, *offsets])


def _fitting(primary: int, length: int, sts: Span, ete: Span) -> Span:
    """Return the offsets of a member of known length, with a primary of known length."""
    fitting = sts.meet(Span(ete.low + primary - length, ete.high + primary - length))
    return fitting.meet(Span(-length, primary))


def open_primary_length(
    secondaries: Sequence[Part], sts: Span, ete: Span, least: int
) -> int | None:
    """Return the duration of an open-ended primary; None if the run determines it.

    It ends with the last secondary, as far as the bounds allow.
    """
    bounded = [part for part in secondaries if not part.open_ended]
    if not bounded:
        if not sts.low <= 0 <= sts.high or not ete.low <= 0 <= ete.high:
            raise Unplannable("no member has a length that can be determined")
        return None
    lengths = [part.length for part in bounded if part.length is not None]
    if len(lengths) < len(bounded):
        if ete.low > 0:
            raise Unplannable(f"the length of {unknown(bounded)} cannot be determined")
        if ete.low == ete.high and sts.low != sts.high and len(bounded) > 1:
            raise Unplannable(f"the length of {unknown(bounded)} cannot be determined")
        return None
    least_length: Steps = max(1, sts.low, -ete.high)
    most_length: Steps = INF
    for part, length in zip(bounded, lengths, strict=True):
        if length < ete.low:
            raise Unplannable(f"{part.name} is too short")
        least_length = max(least_length, sts.low + length - ete.high)
        most_length = min(most_length, sts.high + length - ete.low)
    if least_length > most_length:
        raise Unplannable("no length of the open-ended first member fits all the others")
    wanted = max(least, *(length + sts.nearest(0) for length in lengths))
    return Span(least_length, most_length).nearest(wanted)


def unknown(parts: Sequence[Part]) -> str:
    """Return the names of the members whose length is only known in the run."""
    return " and ".join(sorted(p.name for p in parts if p.length is None and not p.open_ended))


def offset_of(
    part: Part,
    primary: Part,
    length: int | None,
    sts: Span,
    ete: Span,
    secondaries: Sequence[Part],
) -> int | None:
    """Return the start of a secondary after the start of the primary; None: at its end."""
    if part.open_ended:
        if length is None and ete.high < 0:
            raise Unplannable(f"the length of {primary.name} cannot be determined")
        return with_primary(part, length, sts)
    if length is not None and part.length is not None:
        fitting = _fitting(length, part.length, sts, ete)
        if fitting.low > fitting.high:
            raise Unplannable(f"{part.name} does not fit the length of {primary.name}")
        return fitting.nearest(0)
    if ete.free or primary.open_ended or sts.low == sts.high:
        return with_primary(part, length, sts)
    if ete.low >= 0 and sts.high == INF and sts.low <= 0:
        fits = ete.high > 0 if part.length is None else ete.low <= part.length <= ete.high
        if fits:
            return None
    if ete.low == ete.high or (ete.low >= 0 and sts.high == INF):
        raise Unplannable(f"the length of {unknown([primary, *secondaries])} cannot be determined")
    return with_primary(part, length, sts)


def with_primary(part: Part, length: int | None, sts: Span) -> int:
    """Return the offset nearest to the start of the primary."""
    offset = sts.nearest(0)
    if length is not None and offset > length:
        raise Unplannable(f"{part.name} would start after the end of the first member")
    if part.length is not None and offset < -part.length:
        raise Unplannable(f"{part.name} would end before the start of the first member")
    return offset


def whole_length(
    parts: Sequence[Part], starts: Sequence[int | None], length: int | None, ete: Span
) -> int | None:
    """Return the steps of the whole, if they are known.

    Raises:
        Unplannable: The members share no instant.
    """
    first = starts[0]
    if length is None or first is None:
        return None
    ends: list[int] = [first + length]
    for part, start in zip(parts[1:], starts[1:], strict=True):
        if part.open_ended:
            continue
        if start is None or part.length is None:
            return None
        ends.append(start + part.length)
    last = max(ends)
    for part in parts[1:]:
        if part.open_ended:
            ends.append(first + length + ete.nearest(last - first - length))
    if max(start for start in starts if start is not None) > min(ends):
        raise Unplannable("the members would have no instant in common")
    return max(ends)
