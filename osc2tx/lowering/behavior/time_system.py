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
    is_free,
    with_elastic,
)
from osc2tx.lowering.behavior.invoked_times import MOST_CHOICES, InvokedTimes, Lasting, ScenarioOf
from osc2tx.lowering.behavior.member_lengths import (
    FREE,
    INSTANT,
    LEAST,
    OPEN,
    Either,
    Filling,
    Known,
    Length,
    Stretchable,
    alternatives,
    choice,
)
from osc2tx.lowering.behavior.parallel_times import ParallelTimes, given_times, is_filled
from osc2tx.lowering.behavior.time_equations import TimeEquations
from osc2tx.lowering.behavior.time_expressions import (
    Terms,
    ends_of,
    is_range,
    part_of,
    range_between,
    rest_of,
)
from osc2tx.lowering.context import LoweringContext
from osc2tx_shared.classes import replace

Composition: TypeAlias = ir.Serial | ir.Parallel | ir.OneOf


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
        self._parallels = ParallelTimes(self._equations)
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

    def _member(self, node: ir.Behavior, is_bounded: bool) -> tuple[ir.Behavior, Length]:
        """Solve a member.

        Args:
            node: The member.
            is_bounded: A member around it states its duration.
        """
        match node:
            case ir.Wait(trigger=ir.Trigger(event=None, condition=ir.Elapsed(duration=time))):
                return node, Known((time,))
            case ir.Serial() | ir.Parallel() | ir.OneOf():
                return self._composition(node, is_bounded)
            case ir.Invoke() | ir.InvokeScenario() if node.until:
                return node, None
            case ir.InvokeScenario() if is_bounded or node.duration is not None:
                return node, self._invocation(node)
            case ir.Invoke(duration=ir.HalfRange(is_lower=True)) if ir.is_open(
                replace(node, duration=None)
            ):
                return node, LEAST
            case ir.Invoke() if node.duration is not None:
                return node, None if is_range(node.duration) else Known((node.duration,))
            case _ if ir.is_instant(node):
                return node, INSTANT
            case _ if ir.is_open(node):
                return node, OPEN
            case _:
                return node, FREE if is_free(node) else None

    def _invocation(self, node: ir.InvokeScenario) -> Length:
        """Relate the times of an invoked scenario to the duration that it is given."""
        duration = node.duration
        if duration is not None and self.ctx.sink.has_report_at(duration.span):
            return None  # the invoked scenario states another duration
        lengths = self._invoked.lengths(node)
        if duration is None:
            if any(length.goes_on for length in lengths):
                return None
            return choice([length.terms for length in lengths])
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
                return Known(chosen[0].terms)
        return None if is_range(duration) else Known((duration,))

    def _relate(self, length: Lasting, duration: ir.Expression) -> None:
        """Give an invoked scenario a duration."""
        if not length.members:
            self._equations.relate(length.terms, duration)
            return
        for each in length.members:
            if not self._equations.bound(each, duration):
                return
        self._equations.relate_longest(length.members, duration)

    def _composition(self, node: Composition, is_bounded: bool) -> tuple[ir.Behavior, Length]:
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
        length: Length = None
        match node:
            case _ if node.until:
                return node, None
            case ir.Serial():
                node, length = self._serial(node, lengths)
            case ir.Parallel():
                node, length = self._parallels.solve(node, lengths)
            case ir.OneOf():
                length = self._one_of(node, lengths)
        if node.duration is not None and not is_range(node.duration):
            length = Known((node.duration,))
        return node, length

    def _one_of(self, node: ir.OneOf, lengths: list[Length]) -> Length:
        """Relate the times of alternatives to the duration of their `one_of`."""
        length = alternatives(lengths)
        if node.duration is None or not isinstance(length, Known | Either):
            return length
        return self._either(length.options if isinstance(length, Either) else (length.terms,), node)

    # --- serial ---

    def _serial(self, node: ir.Serial, lengths: list[Length]) -> tuple[ir.Serial, Length]:
        if any(isinstance(length, Either) for length in lengths):
            return node, self._with_alternatives(node, lengths)
        known = [length for length in lengths if isinstance(length, Known)]
        terms = tuple(term for length in known for term in length.terms)
        filling = [i for i, length in enumerate(lengths) if isinstance(length, Filling)]
        if len(known) == len(lengths):
            if node.duration is not None:
                self._equations.relate(terms, node.duration)
            return node, Known(terms)
        if (stretched := self._stretched(node, lengths)) is not None:
            return stretched
        if lengths[-1] is OPEN and node.duration is not None:
            self._equations.bound(terms, node.duration)  # the last member takes the rest
        whole = node.duration
        if whole is not None and is_range(whole) and len(known) == len(lengths) - 1:
            if not is_filled(self._equations, [Known(terms)], whole):
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

    def _stretched(
        self, node: ir.Serial, lengths: Sequence[Length]
    ) -> tuple[ir.Serial, Stretchable | None] | None:
        """Return a serial with a composition of any length, the last of which takes the rest.

        Others before it last as long as their bounded members. Without a duration the serial is
        itself of any length.
        """
        whole = node.duration
        found = [i for i, length in enumerate(lengths) if isinstance(length, Stretchable)]
        if not found or is_range(whole):
            return None
        others: list[ir.Expression] = []
        for index, length in enumerate(lengths):
            is_timed = isinstance(length, Known) or (
                isinstance(length, Stretchable) and length.terms
            )
            if index != found[-1] and not is_timed:
                return None
            if index != found[-1] and isinstance(length, Known | Stretchable):
                others += length.terms
        least = lengths[found[-1]]
        assert isinstance(least, Stretchable)
        if whole is None:
            return node, Stretchable((*others, *least.terms))
        if not self._equations.bound((*others, *least.terms), whole):
            return None
        rest = rest_of(whole, tuple(others))
        if is_filled(self._equations, [Known(least.terms)], rest):
            return None
        member = node.members[found[-1]]
        assert isinstance(member, ir.CompositionBase)
        stretched = self._member(replace(member, duration=rest), is_bounded=True)[0]
        before, after = node.members[: found[-1]], node.members[found[-1] + 1 :]
        return replace(node, members=(*before, stretched, *after)), None

    def _given_the_rest(
        self, node: ir.Serial, lengths: Sequence[Length], others: Terms
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
            if not isinstance(length, Known)
        )
        return with_elastic(node, (member,), range_between(low, high))

    def _with_alternatives(self, node: ir.Serial, lengths: list[Length]) -> Length:
        """Relate the times of a serial with alternatives to its duration, if one choice fits."""
        options = [
            (length.terms,) if isinstance(length, Known) else length.options
            for length in lengths
            if isinstance(length, Known | Either)
        ]
        if len(options) < len(lengths) or prod(map(len, options)) > MOST_CHOICES:
            return None
        sums = [tuple(term for terms in each for term in terms) for each in product(*options)]
        if node.duration is None:
            return choice(sums)
        return self._either(sums, node)

    def _either(self, options: Sequence[Terms], node: ir.Serial | ir.OneOf) -> Length:
        """Relate the lengths that a member may have to its duration."""
        assert node.duration is not None
        fitting = [each for each in options if self._equations.fits(each, node.duration)]
        if not fitting:
            self._equations.is_impossible(options[-1], node.duration)
            return None
        if len(fitting) == 1:
            self._equations.relate(fitting[0], node.duration)
        elif self._equations.is_variable(tuple(t for each in fitting for t in each)) or (
            self._equations.is_variable((node.duration,))
        ):
            self._equations.relate_either(fitting, node.duration)
        return choice(fitting)

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
        return replace(node, members=given_times(self._equations, node.members, filling, rest))
