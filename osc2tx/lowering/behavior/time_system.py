"""Consistent durations of a `do` tree (§7.6.2.1, §7.6.2.4).

The times of a tree are sums and differences: the duration of a `serial` is the sum of its members,
those of an `equal` parallel are equal. A duration around them is an equation or a bound. Times that
are drawn from ranges are solved for where an equation determines them, otherwise bounded or
checked; actions of free length, and open-ended members, get the rest. A contradiction is an error
that shows both positions.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import product
from math import prod
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.behavior.durations import (
    is_elastic,
    is_free,
    is_instant,
    is_open_ended,
    with_elastic,
)
from osc2tx.lowering.behavior.invoked_times import MOST_CHOICES, InvokedTimes, Lasting, ScenarioOf
from osc2tx.lowering.behavior.overlap_equations import OverlapTimes
from osc2tx.lowering.behavior.time_equations import TimeEquations
from osc2tx.lowering.behavior.time_expressions import (
    SLACK,
    Terms,
    ends_of,
    is_range,
    part_of,
    range_between,
    rest_of,
    sum_of,
    with_duration,
)
from osc2tx.lowering.context import LoweringContext
from osc2tx_shared.classes import dataclass, replace

Composition: TypeAlias = ir.Serial | ir.Parallel | ir.OneOf


@dataclass(frozen=True, slots=True)
class _Known:
    """A member whose length the text states."""

    terms: Terms


class _Filling:
    """A member that takes as long as it is given: open-ended, or an action of free length."""


@dataclass(frozen=True, slots=True)
class _Either:
    """A member that has one of several lengths: of the alternatives of a `one_of`."""

    options: tuple[Terms, ...]


_Length: TypeAlias = _Known | _Either | _Filling | None
"""Facts about the length of a member; `None` if only the run decides."""

INSTANT = _Known(())
OPEN, FREE = _Filling(), _Filling()
LEAST = _Filling()
"""The length of a member that continues for at least some time."""


def _choice(options: Sequence[Terms]) -> _Length:
    """Return the length of a member that has one of several lengths."""
    if not options or len(options) > MOST_CHOICES:
        return None
    return _Known(options[0]) if len(options) == 1 else _Either(tuple(options))


def _alternatives(lengths: Sequence[_Length]) -> _Length:
    """Return the length of a `one_of`, given those of its members."""
    found: list[Terms] = []
    for length in lengths:
        if not isinstance(length, _Known | _Either):
            return None
        found += (length.terms,) if isinstance(length, _Known) else length.options
    return _choice(found)


ENDING_WITH_OTHERS = ("equal", "end", "final", "full", "inside")
"""Overlaps that require of the end of a member where those of others are."""


class TimeSystem:
    """The times of one scenario.

    Args:
        ctx: The scenario; parameters that it draws are solved for.
        declared: Its own declarations.
        solvable: The names of its parameters that no invoker sets.
        scenario_of: Returns the scenarios that it invokes.
    """

    def __init__(
        self,
        ctx: LoweringContext,
        declared: Sequence[ir.Declaration],
        solvable: Collection[str],
        scenario_of: ScenarioOf,
    ) -> None:
        self.ctx = ctx
        self._equations = TimeEquations(ctx, list(declared), solvable)
        self._invoked = InvokedTimes(ctx, scenario_of, self._equations.longest)

    @property
    def declared(self) -> Sequence[ir.Declaration]:
        """The own declarations, with the times that are solved for."""
        return self._equations.declared

    @property
    def constraints(self) -> Sequence[ir.Constraint]:
        """The constraints that are checked before a run."""
        return self._equations.constraints

    def solve(self, tree: ir.Behavior) -> ir.Behavior:
        """Return a tree whose members take the times that the durations around them require."""
        solved = self._member(tree, is_bounded=False)[0]
        return self._invoked.handed_in(solved, self.constraints)

    def _member(self, node: ir.Behavior, is_bounded: bool) -> tuple[ir.Behavior, _Length]:
        """Solve a member.

        Args:
            node: The member.
            is_bounded: A member around it states its duration.
        """
        match node:
            case ir.Wait(trigger=ir.Trigger(event=None, condition=ir.Elapsed(duration=time))):
                return node, _Known((time,))
            case ir.Serial() | ir.Parallel() | ir.OneOf():
                return self._composition(node, is_bounded)
            case ir.Invoke() | ir.InvokeScenario() if node.until:
                return node, None
            case ir.InvokeScenario() if is_bounded or node.duration is not None:
                return node, self._invocation(node)
            case ir.Invoke(duration=ir.HalfRange(is_lower=True)) if is_open_ended(
                replace(node, duration=None)
            ):
                return node, LEAST
            case ir.Invoke() if node.duration is not None:
                return node, None if is_range(node.duration) else _Known((node.duration,))
            case _ if is_instant(node):
                return node, INSTANT
            case _ if is_open_ended(node):
                return node, OPEN
            case _:
                return node, FREE if is_free(node) else None

    def _invocation(self, node: ir.InvokeScenario) -> _Length:
        """Relate the times of an invoked scenario to the duration that it is given."""
        duration = node.duration
        if duration is not None and self.ctx.sink.has_report_at(duration.span):
            return None  # the invoked scenario states another duration
        lengths = self._invoked.lengths(node)
        if duration is None:
            if any(length.goes_on for length in lengths):
                return None
            return _choice([length.terms for length in lengths])
        fitting = [
            each
            for each in lengths
            if self._equations.fits(each.terms, duration, at_most=each.goes_on)
        ]
        chosen = fitting if len(lengths) > 1 else lengths
        if len(chosen) == 1 and chosen[0].goes_on:
            self._equations.bound(chosen[0].terms, duration)
        elif len(chosen) == 1:
            self._relate(chosen[0], duration)
            if is_range(duration):
                return _Known(chosen[0].terms)
        return None if is_range(duration) else _Known((duration,))

    def _relate(self, length: Lasting, duration: ir.Expression) -> None:
        """Give an invoked scenario a duration."""
        if not length.members:
            self._equations.relate(length.terms, duration)
            return
        for each in length.members:
            if not self._equations.bound(each, duration):
                return
        self._equations.relate_longest(length.members, duration)

    def _composition(self, node: Composition, is_bounded: bool) -> tuple[ir.Behavior, _Length]:
        is_equal = isinstance(node, ir.Parallel) and node.overlap == "equal"
        if isinstance(node, ir.OneOf) and node.duration is not None:
            node = with_elastic(node, node.members, node.duration)
        inner = not node.until and (is_bounded or node.duration is not None or is_equal)
        solved = [self._member(member, inner) for member in node.members]
        if any(new is not old for (new, _), old in zip(solved, node.members, strict=True)):
            node = replace(node, members=tuple(member for member, _ in solved))
        if is_range(node.duration) and not isinstance(node.duration, ir.RangeValue | ir.HalfRange):
            return node, None  # which range it is shows in the run
        lengths = [length for _, length in solved]
        length: _Length = None
        match node:
            case _ if node.until:
                return node, None
            case ir.Serial():
                node, length = self._serial(node, lengths)
            case ir.Parallel():
                node, length = self._parallel(node, lengths)
            case ir.OneOf():
                length = self._one_of(node, lengths)
        if node.duration is not None and not is_range(node.duration):
            length = _Known((node.duration,))
        return node, length

    def _one_of(self, node: ir.OneOf, lengths: list[_Length]) -> _Length:
        """Relate the times of alternatives to the duration of their `one_of`."""
        length = _alternatives(lengths)
        if node.duration is None or not isinstance(length, _Known | _Either):
            return length
        return self._either(
            length.options if isinstance(length, _Either) else (length.terms,), node
        )

    # --- serial ---

    def _serial(self, node: ir.Serial, lengths: list[_Length]) -> tuple[ir.Serial, _Length]:
        if any(isinstance(length, _Either) for length in lengths):
            return node, self._with_alternatives(node, lengths)
        known = [length for length in lengths if isinstance(length, _Known)]
        terms = tuple(term for length in known for term in length.terms)
        filling = [i for i, length in enumerate(lengths) if isinstance(length, _Filling)]
        if len(known) == len(lengths):
            if node.duration is not None:
                self._equations.relate(terms, node.duration)
            return node, _Known(terms)
        whole = node.duration
        if whole is not None and is_range(whole) and len(known) == len(lengths) - 1:
            if not self._is_filled([_Known(terms)], whole):
                node = self._given_the_rest(node, lengths, terms)
            return node, None
        if len(known) + len(filling) < len(lengths):
            return node, None
        if lengths[-1] is OPEN:
            return node, OPEN if len(filling) == 1 and node.duration is None else None
        are_free = all(lengths[index] is FREE for index in filling)
        if node.duration is None or (len(filling) > 1 and not are_free):
            return node, None
        if are_free and is_range(node.duration):
            return node, None  # their own lengths may lie in it
        return self._filled(node, filling, terms), None

    def _given_the_rest(
        self, node: ir.Serial, lengths: Sequence[_Length], others: Terms
    ) -> ir.Serial:
        """Return a serial whose only member of unknown length gets the rest of a range."""
        assert node.duration is not None
        low, high = (
            end if end is None or not others else rest_of(end, others)
            for end in ends_of(node.duration)
        )
        (member,) = (
            member
            for member, length in zip(node.members, lengths, strict=True)
            if not isinstance(length, _Known)
        )
        return with_elastic(node, (member,), range_between(low, high))

    def _with_alternatives(self, node: ir.Serial, lengths: list[_Length]) -> _Length:
        """Relate the times of a serial with alternatives to its duration, if one choice fits."""
        options = [
            (length.terms,) if isinstance(length, _Known) else length.options
            for length in lengths
            if isinstance(length, _Known | _Either)
        ]
        if len(options) < len(lengths) or prod(map(len, options)) > MOST_CHOICES:
            return None
        sums = [tuple(term for terms in each for term in terms) for each in product(*options)]
        if node.duration is None:
            return _choice(sums)
        return self._either(sums, node)

    def _either(self, options: Sequence[Terms], node: ir.Serial | ir.OneOf) -> _Length:
        """Relate the lengths that a member may have to its duration."""
        assert node.duration is not None
        fitting = [each for each in options if self._equations.fits(each, node.duration)]
        if not fitting:
            return None  # the run decides
        if len(fitting) == 1:
            self._equations.relate(fitting[0], node.duration)
        elif self._equations.is_variable(tuple(t for each in fitting for t in each)) or (
            self._equations.is_variable((node.duration,))
        ):
            self._equations.relate_either(fitting, node.duration)
        return _choice(fitting)

    def _filled(self, node: ir.Serial, filling: Sequence[int], others: Terms) -> ir.Serial:
        """Return a serial, some members of which take the rest of its duration, each the same."""
        assert node.duration is not None
        whole = node.duration
        if isinstance(whole, ir.RangeValue):
            whole = self.ctx.draw(f"{node.label or node.name} duration", whole, whole.lower.type)
            node = replace(node, duration=whole)
        elif is_range(whole):
            return node
        if others and not self._equations.bound(others, whole):
            return node
        rest = part_of(rest_of(whole, others), len(filling))
        return replace(node, members=self._given(node.members, filling, rest))

    def _given(
        self, members: tuple[ir.Behavior, ...], filling: Sequence[int], time: ir.Expression
    ) -> tuple[ir.Behavior, ...]:
        """Return members, some of which take a time that is in their required range."""
        for index in filling:
            asked = getattr(members[index], "duration", None)
            if asked is not None:
                self._equations.relate((time,), asked)
            members = with_duration(members, index, time)
        return members

    # --- parallel ---

    def _parallel(self, node: ir.Parallel, lengths: list[_Length]) -> tuple[ir.Parallel, _Length]:
        lasting = [
            index
            for index, length in enumerate(lengths)
            if not isinstance(length, _Known) or length.terms
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
        self, node: ir.Parallel, lengths: list[_Length], lasting: Sequence[int]
    ) -> ir.Parallel:
        """Return a parallel whose elastic members are as long as its overlap with others requires.

        Their lengths are known from now on.
        """
        if node.start_to_start or node.end_to_end or node.overlap not in ENDING_WITH_OTHERS:
            return node
        known = [(i, length) for i in lasting if isinstance(length := lengths[i], _Known)]
        elastic = [i for i in lasting if lengths[i] in (None, FREE) and is_elastic(node.members[i])]
        if node.overlap == "inside":
            elastic = [i for i in elastic if i == lasting[0]]
        if not elastic or len(known) + len(elastic) < len(lasting):
            return node
        primary = [length for i, length in known if i == lasting[0]]
        whole = self._longest(primary or [length for _, length in known]) if known else None
        if whole is None:
            return node
        for index in elastic:
            lengths[index] = whole
        return with_elastic(node, [node.members[i] for i in elastic], sum_of(whole.terms))

    def _offset(self, node: ir.Parallel, lengths: list[_Length]) -> _Length:
        """Relate members to the offsets between them, and to the duration around them."""
        known = [length.terms for length in lengths if isinstance(length, _Known)]
        if len(lengths) < 2 or not isinstance(lengths[0], _Known):
            return None
        times = OverlapTimes(self._equations, node)
        if not times.relate(known[0], known[1:]) or len(known) < len(lengths):
            return None
        whole = times.whole(known)
        return None if whole is None else _Known(whole)

    def _equal(
        self, node: ir.Parallel, lengths: list[_Length], lasting: list[int]
    ) -> tuple[ir.Parallel, _Length]:
        """Relate members that start and end together."""
        lengths = self._only_fitting(lengths, lasting)
        known = [length for i in lasting if isinstance(length := lengths[i], _Known)]
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
        members = self._given(node.members, filling, sum_of(whole))
        return replace(node, members=members), _Known(whole)

    def _only_fitting(self, lengths: list[_Length], lasting: list[int]) -> list[_Length]:
        """Return the lengths of members that are equal, if one choice of alternatives fits."""
        options = {
            index: (length.terms,) if isinstance(length, _Known) else length.options
            for index in lasting
            if isinstance(length := lengths[index], _Known | _Either)
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
        chosen = dict(zip(options, map(_Known, fitting[0]), strict=True))
        return [chosen.get(index, length) for index, length in enumerate(lengths)]

    def _started_together(
        self, node: ir.Parallel, lengths: list[_Length], lasting: list[int]
    ) -> tuple[ir.Parallel, _Length]:
        """Relate members that start together: the longest is as long as the whole."""
        known = [length for i in lasting if isinstance(length := lengths[i], _Known)]
        free = [index for index in lasting if lengths[index] in (FREE, LEAST)]
        whole = node.duration
        can_fill = is_range(whole) and OPEN not in lengths
        if whole is not None and can_fill and not self._is_filled(known, whole):
            node = with_elastic(node, node.members, whole)
        if len(lasting) > len(known) + len(free):
            for length in known:
                if whole is not None:
                    self._equations.bound(length.terms, whole)
            return node, None
        if whole is None:
            return node, self._longest(known) if known and not free else None
        if not is_range(whole) and (len(free) == 1 or not self._is_filled(known, whole)):
            node = replace(node, members=self._given(node.members, free, whole))
        for length in known if len(known) > 1 or free else ():
            self._equations.bound(length.terms, whole)
        if not free:
            self._equations.relate_longest([each.terms for each in known], whole)
        return node, self._longest(known) if known and not free else None

    def _is_filled(self, members: Sequence[_Known], whole: ir.Expression) -> bool:
        """Whether one of some members surely lasts for a time."""
        found = (self._equations.bounds(each.terms) for each in members)
        wanted = self._equations.bounds((whole,))
        return wanted is not None and any(
            each is not None and each[0] >= wanted[0] - SLACK for each in found
        )

    def _longest(self, members: Sequence[_Known]) -> _Known:
        return _Known(self._equations.longest([each.terms for each in members]))
