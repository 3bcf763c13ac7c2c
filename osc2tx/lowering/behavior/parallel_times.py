"""The times of the members of a `parallel` (§7.6.2.1.4)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import prod

from osc2tx import ir
from osc2tx.lowering.behavior.durations import is_elastic, with_elastic
from osc2tx.lowering.behavior.invoked_times import MOST_CHOICES
from osc2tx.lowering.behavior.member_lengths import (
    FREE,
    LEAST,
    OPEN,
    Either,
    Known,
    Length,
    Stretchable,
)
from osc2tx.lowering.behavior.overlap_equations import OverlapTimes
from osc2tx.lowering.behavior.time_equations import TimeEquations
from osc2tx.lowering.behavior.time_expressions import (
    SLACK,
    Terms,
    is_range,
    sum_of,
    with_duration,
)
from osc2tx_shared.classes import replace

ENDING_WITH_OTHERS = ("equal", "end", "final", "full", "inside")
"""Overlaps that require of the end of a member where those of others are."""


class ParallelTimes:
    """The times of the `parallel` compositions of one scenario.

    Args:
        equations: Its equations.
    """

    def __init__(self, equations: TimeEquations) -> None:
        self._equations = equations

    def solve(self, node: ir.Parallel, lengths: list[Length]) -> tuple[ir.Parallel, Length]:
        """Return a parallel whose members take the times that it requires, with its length.

        Args:
            node: The composition.
            lengths: Those of its members; what it requires is added.
        """
        lasting = [
            index
            for index, length in enumerate(lengths)
            if not isinstance(length, Known) or length.terms
        ]
        overlap = node.overlap or "start"
        node = self._with_lengths_of_goals(node, lengths, lasting)
        is_plain = node.start_to_start is None and node.end_to_end is None
        if not lasting or not is_plain or overlap not in ("equal", "start"):
            return node, self._offset(node, [lengths[index] for index in lasting])
        if overlap == "equal":
            return self._equal(node, lengths, lasting)
        return self._started_together(node, lengths, lasting)

    def _with_lengths_of_goals(
        self, node: ir.Parallel, lengths: list[Length], lasting: Sequence[int]
    ) -> ir.Parallel:
        """Return a parallel whose elastic members are as long as its overlap with others requires.

        Their lengths are known from now on.
        """
        if node.start_to_start or node.end_to_end or node.overlap not in ENDING_WITH_OTHERS:
            return node
        known = [(i, length) for i in lasting if isinstance(length := lengths[i], Known)]
        elastic = [i for i in lasting if lengths[i] in (None, FREE) and is_elastic(node.members[i])]
        if node.overlap == "inside":
            elastic = [i for i in elastic if i == lasting[0]]
        if not elastic or not known or len(known) + len(elastic) < len(lasting):
            return node
        primary = [length for i, length in known if i == lasting[0]]
        whole = self._longest(primary or [length for _, length in known])
        for index in elastic:
            lengths[index] = whole
        return with_elastic(node, [node.members[i] for i in elastic], sum_of(whole.terms))

    def _offset(self, node: ir.Parallel, lengths: list[Length]) -> Length:
        """Relate members to the offsets between them, and to the duration around them."""
        known = [length.terms for length in lengths if isinstance(length, Known)]
        if len(lengths) < 2:
            return None
        times = OverlapTimes(self._equations, node)
        if times.contradicts_overlap() or not isinstance(lengths[0], Known):
            return None
        if not times.relate(known[0], known[1:]) or len(known) < len(lengths):
            return None
        whole = times.whole(known)
        return None if whole is None else Known(whole)

    def _equal(
        self, node: ir.Parallel, lengths: list[Length], lasting: list[int]
    ) -> tuple[ir.Parallel, Length]:
        """Relate members that start and end together."""
        lengths = self._only_fitting(lengths, lasting)
        known = [length for i in lasting if isinstance(length := lengths[i], Known)]
        if node.duration is not None and not is_range(node.duration):
            whole: Terms = (node.duration,)
        elif known:
            whole = min(known, key=lambda each: self._equations.is_variable(each.terms)).terms
            if node.duration is not None:
                self._equations.relate(whole, node.duration)
        else:
            return node, None
        for length in known:
            if length.terms != whole:
                self._equations.relate(length.terms, sum_of(whole))
        filling = [index for index in lasting if lengths[index] in (FREE, LEAST)]
        members = given_times(self._equations, node.members, filling, sum_of(whole))
        return replace(node, members=members), Known(whole)

    def _only_fitting(self, lengths: list[Length], lasting: list[int]) -> list[Length]:
        """Return the lengths of members that are equal, if one choice of alternatives fits."""
        options = {
            index: (length.terms,) if isinstance(length, Known) else length.options
            for index in lasting
            if isinstance(length := lengths[index], Known | Either)
        }
        count = prod(map(len, options.values()))
        if count == 1 or count > MOST_CHOICES:
            return lengths
        fitting = [
            each
            for each in product(*options.values())
            if all(self._equations.fits(each[0], sum_of(terms)) for terms in each[1:])
        ]
        if len(fitting) != 1:
            return lengths  # the choice is known when all times are drawn
        chosen = dict(zip(options, map(Known, fitting[0]), strict=True))
        return [chosen.get(index, length) for index, length in enumerate(lengths)]

    def _started_together(
        self, node: ir.Parallel, lengths: list[Length], lasting: list[int]
    ) -> tuple[ir.Parallel, Length]:
        """Relate members that start together: the longest is as long as the whole."""
        known = [length for i in lasting if isinstance(length := lengths[i], Known)]
        free = [index for index in lasting if lengths[index] in (FREE, LEAST)]
        whole = node.duration
        can_fill = is_range(whole) and OPEN not in lengths
        if whole is not None and can_fill and not is_filled(self._equations, known, whole):
            node = with_elastic(node, node.members, whole)
        if len(lasting) > len(known) + len(free):
            for length in known:
                if whole is not None:
                    self._equations.bound(length.terms, whole)
            are_open = all(lengths[i] is OPEN or isinstance(lengths[i], Known) for i in lasting)
            is_open = whole is None and known and are_open
            return node, Stretchable(self._longest(known).terms) if is_open else None
        if whole is None:
            return node, self._longest(known) if known and not free else None
        if not is_range(whole) and (len(free) == 1 or not is_filled(self._equations, known, whole)):
            node = replace(node, members=given_times(self._equations, node.members, free, whole))
        for length in known if len(known) > 1 or free else ():
            self._equations.bound(length.terms, whole)
        if not free:
            self._equations.relate_longest([each.terms for each in known], whole)
        return node, self._longest(known) if known and not free else None

    def _longest(self, members: Sequence[Known]) -> Known:
        return Known(self._equations.longest([each.terms for each in members]))


def is_filled(equations: TimeEquations, members: Sequence[Known], whole: ir.Expression) -> bool:
    """Whether one of some members surely lasts for a time."""
    found = (equations.bounds(each.terms) for each in members)
    wanted = equations.bounds((whole,))
    return wanted is not None and any(
        each is not None and each[0] >= wanted[0] - SLACK for each in found
    )


def given_times(
    equations: TimeEquations,
    members: tuple[ir.Behavior, ...],
    filling: Sequence[int],
    time: ir.Expression,
) -> tuple[ir.Behavior, ...]:
    """Return members, some of which take a time that is in their required range."""
    for index in filling:
        asked = getattr(members[index], "duration", None)
        if asked is not None:
            equations.relate((time,), asked)
        members = with_duration(members, index, time)
    return members
