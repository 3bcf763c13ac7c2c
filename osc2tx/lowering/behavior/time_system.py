"""Durations of a `do` tree that hold together (§7.6.2.1, §7.6.2.4).

The times of a tree are sums and differences: a `serial` takes what its members take together, the
members of an `equal` parallel take the same. A duration around them is an equation or a bound.
Times that are drawn from ranges are solved for where an equation leaves no choice, bounded or
checked otherwise; actions of free length, and open-ended members, get the rest. A contradiction is
an error that shows both positions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from functools import reduce
from typing import TypeAlias

from osc2tx import ir
from osc2tx.diagnostics import Label
from osc2tx.lowering.behavior.durations import is_free, is_instant, is_open_ended
from osc2tx.lowering.behavior.time_expressions import (
    SLACK,
    Terms,
    Times,
    greater_of,
    is_range,
    lies_within,
    names_in,
    resolved,
    rest_of,
    shown,
    sum_of,
    time_like,
    with_duration,
)
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import BOOL
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.overlaps import OFFSETS

Composition: TypeAlias = ir.Serial | ir.Parallel | ir.OneOf


@dataclass(frozen=True, slots=True)
class _Known:
    """A member whose length the text states."""

    terms: Terms


class _Filling:
    """A member that takes as long as it is given: open-ended, or an action of free length."""


_Length: TypeAlias = _Known | _Filling | None
"""Facts about the length of a member; `None` if only the run decides."""

INSTANT = _Known(())
OPEN, FREE = _Filling(), _Filling()


@dataclass(slots=True, eq=False)
class TimeSystem:
    """The times of one scenario.

    Attributes:
        ctx: The scenario; parameters that it draws are solved for.
        declared: Its own parameters.
        constraints: What has to be checked before a run.
    """

    ctx: LoweringContext
    declared: Sequence[ir.Declaration]
    constraints: list[ir.Constraint] = field(default_factory=list)

    def solve(self, tree: ir.Behavior) -> ir.Behavior:
        """Return a tree whose members take the times that the durations around them ask for."""
        return self._member(tree)[0]

    def _member(self, node: ir.Behavior) -> tuple[ir.Behavior, _Length]:
        match node:
            case ir.Wait(trigger=ir.Trigger(event=None, condition=ir.Elapsed(duration=time))):
                return node, _Known((time,))
            case ir.Serial() | ir.Parallel() | ir.OneOf():
                return self._composition(node)
            case ir.Invoke() | ir.InvokeScenario() if node.until:
                return node, None
            case ir.Invoke() | ir.InvokeScenario() if node.duration is not None:
                return node, None if is_range(node.duration) else _Known((node.duration,))
            case _ if is_instant(node):
                return node, INSTANT
            case _ if is_open_ended(node):
                return node, OPEN
            case _:
                return node, FREE if is_free(node) else None

    def _composition(self, node: Composition) -> tuple[ir.Behavior, _Length]:
        solved = [self._member(member) for member in node.members]
        if any(new is not old for (new, _), old in zip(solved, node.members, strict=True)):
            node = replace(node, members=tuple(member for member, _ in solved))
        if is_range(node.duration) and not isinstance(node.duration, ir.RangeValue):
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
        if node.duration is not None and not is_range(node.duration):
            length = _Known((node.duration,))
        return node, length

    # --- serial ---

    def _serial(self, node: ir.Serial, lengths: list[_Length]) -> tuple[ir.Serial, _Length]:
        known = [length for length in lengths if isinstance(length, _Known)]
        terms = tuple(term for length in known for term in length.terms)
        filling = [i for i, length in enumerate(lengths) if isinstance(length, _Filling)]
        if len(known) == len(lengths):
            if node.duration is not None:
                self._relate(terms, node.duration)
            return node, _Known(terms)
        if len(known) + len(filling) < len(lengths):
            return node, None
        if lengths[-1] is OPEN:
            return node, OPEN if len(filling) == 1 and node.duration is None else None
        if len(filling) > 1 or node.duration is None:
            return node, None
        if lengths[filling[0]] is FREE and isinstance(node.duration, ir.RangeValue):
            return node, None  # its own length may lie in it
        return self._filled(node, filling[0], terms), None

    def _filled(self, node: ir.Serial, index: int, others: Terms) -> ir.Serial:
        """Return a serial, one member of which takes the rest of its duration."""
        assert node.duration is not None
        whole = node.duration
        if isinstance(whole, ir.RangeValue):
            whole = self.ctx.draw(f"{node.label or node.name} duration", whole, whole.lower.type)
            node = replace(node, duration=whole)
        if self._is_impossible(others, whole, at_most=True):
            return node
        rest = rest_of(whole, others)
        return replace(node, members=with_duration(node.members, index, rest))

    # --- parallel ---

    def _parallel(self, node: ir.Parallel, lengths: list[_Length]) -> tuple[ir.Parallel, _Length]:
        lasting = [
            index
            for index, length in enumerate(lengths)
            if not isinstance(length, _Known) or length.terms
        ]
        overlap = node.overlap or "start"
        is_plain = node.start_to_start is None and node.end_to_end is None
        if not lasting or not is_plain or overlap not in ("equal", "start"):
            if len(lasting) > 1:
                self._check_offsets(node, [lengths[index] for index in lasting])
            return node, None
        if overlap == "equal":
            return self._equal(node, lengths, lasting)
        return self._started_together(node, lengths, lasting)

    def _check_offsets(self, node: ir.Parallel, lengths: list[_Length]) -> None:
        """Report members whose lengths contradict the overlap of the composition."""
        kind = node.overlap or ("start" if node.start_to_start is None else "any")
        bounds = list(OFFSETS[kind])
        for index, given in enumerate((node.start_to_start, node.end_to_end)):
            if given is not None:
                found = self._bounds((given,))
                if found is None:
                    return
                low, high = bounds[index]
                bounds[index] = max(low, found[0]), min(high, found[1])
        starts, ends = bounds
        primary, *others = lengths
        first = self._bounds(primary.terms) if isinstance(primary, _Known) else None
        for other in others if first is not None else ():
            own = self._bounds(other.terms) if isinstance(other, _Known) else None
            if first is None or own is None or not isinstance(other, _Known):
                continue
            low = max(starts[0], -own[1], ends[0] + first[0] - own[1])
            high = min(starts[1], first[1], ends[1] + first[1] - own[0])
            if low > high + SLACK:
                message = (
                    f"members of {shown(first)} and {shown(own)} cannot overlap as this asks for"
                )
                labels = [Label(term.span, "one of them") for term in other.terms]
                self.ctx.sink.report("OSC519", node.span, message, labels=labels)
                return

    def _equal(
        self, node: ir.Parallel, lengths: list[_Length], lasting: list[int]
    ) -> tuple[ir.Parallel, _Length]:
        """Relate members that start and end together."""
        known = [length for i in lasting if isinstance(length := lengths[i], _Known)]
        is_range = isinstance(node.duration, ir.RangeValue)
        if node.duration is not None and not is_range:
            whole: Terms = (node.duration,)
        elif known:
            whole = min(known, key=lambda each: self._is_variable(each.terms)).terms
            if node.duration is not None:
                self._relate(whole, node.duration)
        else:
            return node, None
        for length in known:
            if length.terms != whole:
                self._relate(length.terms, sum_of(whole))
        members = node.members
        for index in lasting:
            if lengths[index] is FREE:
                members = with_duration(members, index, sum_of(whole))
        return replace(node, members=members), _Known(whole)

    def _started_together(
        self, node: ir.Parallel, lengths: list[_Length], lasting: list[int]
    ) -> tuple[ir.Parallel, _Length]:
        """Relate members that start together: the longest is as long as the whole."""
        known = [length for i in lasting if isinstance(length := lengths[i], _Known)]
        free = [index for index in lasting if lengths[index] is FREE]
        whole = node.duration
        if len(lasting) > len(known) + len(free):
            for length in known:
                if whole is not None:
                    self._bound(length.terms, whole)
            return node, None
        if whole is None:
            return node, _Known(self._longest(known)) if known and not free else None
        if len(free) == 1 and not isinstance(whole, ir.RangeValue):
            node = replace(node, members=with_duration(node.members, free[0], whole))
        for length in known if len(known) > 1 or free else ():
            self._bound(length.terms, whole)
        if not free and len(known) == 1:
            self._relate(known[0].terms, whole)
        elif not free:
            self._relate_longest(known, whole)
        return node, _Known(self._longest(known)) if known and not free else None

    def _relate_longest(self, members: list[_Known], whole: ir.Expression) -> None:
        """Let the longest of some members be as long as the whole."""
        longest = self._longest(members)
        variable = [each for each in members if self._is_variable(each.terms)]
        reached = [self._bounds(each.terms) for each in members if each not in variable]
        wanted = self._bounds((whole,))
        if wanted is not None and any(
            found is not None and found[1] >= wanted[0] - SLACK for found in reached
        ):
            return
        if variable and not isinstance(whole, ir.RangeValue):
            self._relate(variable[0].terms, whole)
        else:
            self._relate(longest, whole)

    def _longest(self, members: list[_Known]) -> Terms:
        """Return the greatest of several lengths."""
        if len(members) == 1:
            return members[0].terms
        sums = [sum_of(each.terms) for each in members]
        ranges = [self._bounds((each,)) for each in sums]
        for one, found in zip(sums, ranges, strict=True):
            others = [other for each, other in zip(sums, ranges, strict=True) if each is not one]
            if found is not None and all(o is not None and o[1] <= found[0] for o in others):
                return (one,)
        return (reduce(greater_of, sums),)

    # --- equations and bounds ---

    def _relate(self, terms: Terms, whole: ir.Expression) -> None:
        """Let a sum be a time, or in a range of times."""
        if self._is_impossible(terms, whole):
            return
        self._narrow(terms, whole)
        if terms and not isinstance(whole, ir.RangeValue):
            self._narrow((whole,), sum_of(terms))
        if isinstance(whole, ir.RangeValue):
            self._demand(terms, whole)
            return
        for term in reversed(terms):
            others = tuple(other for other in terms if other is not term)
            parameter = self._parameter(term)
            if parameter is not None and parameter.name not in names_in((*others, whole)):
                self._set(parameter, rest_of(whole, others))
                return

    def _bound(self, terms: Terms, whole: ir.Expression) -> None:
        """Let a sum be no longer than a time, or than a range of times allows."""
        if self._is_impossible(terms, whole, at_most=True):
            return
        most = whole.upper if isinstance(whole, ir.RangeValue) else whole
        zero = ir.Literal(span=most.span, type=most.type, value=0.0)
        within = ir.RangeValue(span=most.span, type=most.type, lower=zero, upper=most)
        self._narrow(terms, within)
        self._demand(terms, within)

    def _demand(self, terms: Terms, whole: ir.RangeValue) -> None:
        """Have a bound checked before the run, unless it always holds."""
        found, wanted = self._bounds(terms), self._bounds((whole,))
        if not lies_within(found, wanted) and self._is_variable(terms):
            self._check(sum_of(terms), whole)

    def _check(self, value: ir.Expression, within: ir.RangeValue) -> None:
        expression = ir.Binary(span=within.span, type=BOOL, operator="in", left=value, right=within)
        self.constraints.append(ir.Constraint(expression=expression, span=within.span))

    def _set(self, parameter: ir.Parameter, value: ir.Expression) -> None:
        """Give a drawn time the value that an equation leaves it."""
        assert isinstance(parameter.domain, ir.RangeValue)
        found, wanted = self._bounds((value,)), self._bounds((parameter.domain,))
        self.ctx.drawn.remove(parameter)
        name = ir.FieldRef(span=parameter.span, type=parameter.type, name=parameter.name)
        self.ctx.drawn.append(replace(parameter, value=value, domain=None, is_fixed=True))
        if not lies_within(found, wanted):
            self._check(name, parameter.domain)

    def _is_impossible(self, terms: Terms, whole: ir.Expression, at_most: bool = False) -> bool:
        """Report a sum that is never a time, or in a range; return whether it is so."""
        found, wanted = self._bounds(terms), self._bounds((whole,))
        if found is None or wanted is None:
            return False
        is_longer = found[0] > wanted[1] + SLACK
        if not is_longer and (at_most or found[1] >= wanted[0] - SLACK):
            return False
        labels = [Label(term.span, f"this takes {shown(self._bounds((term,)))}") for term in terms]
        what = f"{shown(wanted)} here contradict the {shown(found)} that members take"
        self.ctx.sink.report(
            "OSC519",
            whole.span,
            what,
            labels=labels,
            help="let them agree, or leave one of them open",
        )
        return True

    # --- known times ---

    def _values(self) -> dict[str, ir.Expression]:
        found: dict[str, ir.Expression] = {}
        for each in (*self.declared, *self.ctx.drawn):
            if isinstance(each, ir.Parameter):
                is_open = each.value is None or not each.is_fixed
                value = each.domain if is_open else each.value
                if value is not None:
                    found[each.name] = value
        return found

    def _bounds(self, terms: Terms) -> Times | None:
        values = self._values()
        total = (0.0, 0.0)
        for term in terms:
            ends = [term]
            if isinstance(term, ir.RangeValue):
                ends = [term.lower, term.upper]
            found = [ir.bounds(resolved(end, values), values) for end in ends]
            known = [each for each in found if each is not None]
            if len(known) < len(found):
                return None
            total = (
                total[0] + min(low for low, _ in known),
                total[1] + max(high for _, high in known),
            )
        return total

    def _parameter(self, term: ir.Expression) -> ir.Parameter | None:
        """Return the parameter that a time is, if it can be solved for."""
        if not isinstance(term, ir.FieldRef):
            return None
        for each in self.ctx.drawn:
            if isinstance(each, ir.Parameter) and each.name == term.name and each.value is None:
                return each if isinstance(each.domain, ir.RangeValue) else None
        return None

    def _narrow(self, terms: Terms, whole: ir.Expression) -> None:
        """Leave to drawn times the rest of a whole."""
        wanted = self._bounds((whole,))
        for term in terms if wanted is not None else ():
            parameter = self._parameter(term)
            others = self._bounds(tuple(other for other in terms if other is not term))
            if parameter is None or others is None or wanted is None:
                continue
            assert isinstance(parameter.domain, ir.RangeValue)
            had = self._bounds((parameter.domain,))
            if had is None:
                continue
            low, high = max(had[0], wanted[0] - others[1]), min(had[1], wanted[1] - others[0])
            if low <= had[0] + SLACK and high >= had[1] - SLACK:
                continue
            position = self.ctx.drawn.index(parameter)
            lower = time_like(low, parameter.domain.lower)
            if high - low <= SLACK:
                narrowed = replace(parameter, value=lower, domain=None, is_fixed=True)
            else:
                upper = time_like(high, parameter.domain.upper)
                domain = replace(parameter.domain, lower=lower, upper=upper)
                narrowed = replace(parameter, domain=domain)
            self.ctx.drawn[position] = narrowed

    def _is_variable(self, terms: Terms) -> bool:
        """Whether a sum depends on drawn values."""
        drawn = {
            each.name
            for each in (*self.ctx.drawn, *self.declared)
            if isinstance(each, ir.Parameter) and each.domain is not None
        }
        return bool(drawn & names_in(terms))
