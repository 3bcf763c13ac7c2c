"""Offsets between the members of a `parallel` as equations of their lengths (§7.6.2.1.4).

A secondary member of length `b` starts `s` after the primary of length `a`, and ends `e` after it:
`s + b = a + e`. So the bounds of `s` and `e` bound `b - a`, and since the members overlap, `a` and
`b` alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import inf, isinf
from typing import TypeAlias

from osc2tx import ir
from osc2tx.diagnostics import Label
from osc2tx.lowering.behavior.time_equations import TimeEquations
from osc2tx.lowering.behavior.time_expressions import (
    SLACK,
    Terms,
    Times,
    at_least,
    ends_of,
    range_between,
    shown,
    sum_of,
    time_like,
)
from osc2tx_shared.classes import dataclass
from osc2tx_shared.overlaps import ANY, OFFSETS

End: TypeAlias = ir.Expression | float
"""A stated bound of an offset, or the one of the overlap (s)."""


@dataclass(frozen=True, slots=True)
class Overlap:
    """How the secondary members of a `parallel` lie to the primary one.

    Attributes:
        starts: Least and greatest offset of their starts.
        ends: Of their ends.
        kind: Bounds of both by the kind of the overlap (s).
    """

    starts: tuple[End, End]
    ends: tuple[End, End]
    kind: tuple[Times, Times]

    def bounds(self, bounds_of: Callable[[Terms], Times | None]) -> tuple[Times, Times] | None:
        """Return the least and the greatest offsets of starts and of ends (s), if all are known."""
        starts, ends = _bounds(self.starts, bounds_of), _bounds(self.ends, bounds_of)
        if starts is None or ends is None:
            return None
        return _common(self.kind[0], starts), _common(self.kind[1], ends)

    @property
    def terms(self) -> Terms:
        """The offsets that are stated."""
        ends = (*self.starts, *self.ends)
        return tuple(each for each in ends if not isinstance(each, float))

    def spans(
        self,
        primary: Terms,
        others: Sequence[Terms],
        bounds_of: Callable[[Terms], Times | None],
    ) -> list[Terms] | None:
        """Return times of which the longest is as long as the whole; None if none are known.

        Args:
            primary: The length of the primary member.
            others: Those of the secondary ones.
            bounds_of: Returns the least and the greatest sum (s).
        """
        if self.starts[0] == 0.0 and self.ends[1] == 0.0:
            return [primary]
        if self.starts[1] == 0.0 and self.ends[0] == 0.0 and len(others) == 1:
            return list(others)
        both = (self.starts, self.ends, False), (self.ends, self.starts, True)
        for (offset, same), far, is_before in both:
            if offset != same:
                continue
            near = _bounds((offset, same), bounds_of)
            if near is None or near[0] < 0.0 < near[1]:
                continue
            if near[1] <= 0.0 and near != (0.0, 0.0):
                offset, is_before = _minus(offset), not is_before
            shift = () if isinstance(offset, float) else (offset,)
            first = (*shift, *primary) if is_before else primary
            rest = list(others) if is_before else [(*shift, *each) for each in others]
            beyond = _bounds(far, bounds_of) or ANY
            if far is self.starts:  # measured from the ends
                beyond = -beyond[1], -beyond[0]
            if beyond[1] <= 0.0:
                return [first]
            return rest if beyond[0] >= 0.0 else [first, *rest]
        return None

    def equations(self, primary: Terms, other: Terms) -> Iterator[tuple[Terms, ir.Expression]]:
        """Yield sums with the time, or the range of times, that the offsets require.

        Args:
            primary: The length of the primary member.
            other: The length of a secondary one.
        """
        (first, last), (end, final) = self.starts, self.ends
        whole = sum_of(primary)
        least, most = _after(whole, end, last), _after(whole, final, first)
        if least is not None and first == last and end == final:
            yield other, least
        elif least is not None or most is not None:
            yield other, range_between(least, most)
        for terms, ends in ((other, (_minus(last), end)), (primary, (first, _minus(final)))):
            yield from ((terms, at_least(each)) for each in ends if not isinstance(each, float))


def overlap_of(node: ir.Parallel) -> Overlap:
    """Return the offsets that a `parallel` states: those of its overlap, or its own."""
    kind = node.overlap or "start"
    given = (node.start_to_start, node.end_to_end)
    starts, ends = map(_stated, OFFSETS[kind], given)
    return Overlap(starts, ends, OFFSETS[kind])


def _bounds(offsets: tuple[End, End], bounds_of: Callable[[Terms], Times | None]) -> Times | None:
    low, high = (
        (each, each) if isinstance(each, float) else bounds_of((each,)) for each in offsets
    )
    return None if low is None or high is None else (low[0], high[1])


def _common(one: Times, other: Times) -> Times:
    return max(one[0], other[0]), min(one[1], other[1])


def _stated(kind: Times, given: ir.Expression | None) -> tuple[End, End]:
    if given is None:
        return kind
    low, high = ends_of(given)
    return (-inf if low is None else low), (inf if high is None else high)


def _after(whole: ir.Expression, end: End, start: End) -> ir.Expression | None:
    """Return the length with an offset of ends and one of starts; None without a bound."""
    for sign, offset in (("+", end), ("-", start)):
        if isinstance(offset, float):
            if isinf(offset):
                return None
            assert offset == 0.0, "overlaps have no other bounds"
        else:
            whole = _binary(sign, whole, offset)
    return whole


def _minus(offset: End) -> End:
    if isinstance(offset, float):
        return -offset
    return _binary("-", time_like(0.0, offset), offset)


def _binary(operator: str, left: ir.Expression, right: ir.Expression) -> ir.Binary:
    return ir.Binary(span=right.span, type=left.type, operator=operator, left=left, right=right)


class OverlapTimes:
    """The times of the members of a `parallel` with offsets between them.

    Args:
        equations: The equations of the scenario.
        node: The composition.
    """

    def __init__(self, equations: TimeEquations, node: ir.Parallel) -> None:
        self._equations = equations
        self._node = node
        self._overlap = overlap_of(node)

    def contradicts_overlap(self) -> bool:
        """Report a stated offset that the overlap excludes; return whether there is one."""
        node, offsets = self._node, self._overlap.bounds(self._equations.bounds)
        for given, found in zip(
            (node.start_to_start, node.end_to_end), offsets or (), strict=False
        ):
            if given is not None and found[0] > found[1] + SLACK:
                kind = "" if node.overlap is not None else ", which is the default"
                self._equations.ctx.sink.report(
                    "OSC519",
                    given.span,
                    f"this offset contradicts the overlap `{node.overlap or 'start'}`{kind}",
                    help="write `overlap: any`, or another kind, or omit the offset",
                )
                return True
        return False

    def relate(self, primary: Terms, others: Sequence[Terms]) -> bool:
        """Require the offsets; return whether they are possible."""
        for other in others:
            if self._is_apart(primary, other):
                return False
            if self._equations.is_variable((*primary, *other, *self._overlap.terms)):
                for terms, whole in self._overlap.equations(primary, other):
                    self._equations.relate(terms, whole)
        return True

    def whole(self, members: Sequence[Terms]) -> Terms | None:
        """Relate all members to the duration around them.

        Returns:
            The length of the whole; None if only the run decides.
        """
        spans = self._overlap.spans(members[0], members[1:], self._equations.bounds)
        duration = self._node.duration
        if duration is not None:
            for each in members:
                self._equations.bound(each, duration)
            least = ends_of(duration)[0]
            if spans is not None:
                self._equations.relate_longest(spans, duration)
            elif least is not None and len(members) == 2:  # longest with a member after the other
                self._equations.relate((*members[0], *members[1]), at_least(least))
        return None if spans is None else self._equations.longest(spans)

    def _is_apart(self, primary: Terms, other: Terms) -> bool:
        """Report members that cannot overlap as required; return whether it is so."""
        bounds = self._equations.bounds
        first, own, offsets = bounds(primary), bounds(other), self._overlap.bounds(bounds)
        if first is None or own is None or offsets is None:
            return False
        starts, ends = offsets
        low = max(starts[0], -own[1], ends[0] + first[0] - own[1])
        high = min(starts[1], first[1], ends[1] + first[1] - own[0])
        if low <= high + SLACK:
            return False
        message = f"members of {shown(first)} and {shown(own)} cannot overlap as this requires"
        labels = [Label(term.span, "one of them") for term in other]
        advice = None
        if self._node.overlap is None:
            advice = "without `overlap` they start together; `overlap: any` omits this"
        self._equations.ctx.sink.report(
            "OSC519", self._node.span, message, labels=labels, help=advice
        )
        return True
