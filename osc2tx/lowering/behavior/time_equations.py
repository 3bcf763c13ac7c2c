"""Equations and bounds between the times of a scenario, and the remaining values of drawn times.

A time that is drawn from a range gets the value that an equation determines, or a narrower range;
the rest is checked before a run. A contradiction is an error that shows both positions.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import field
from functools import partial, reduce
from math import inf

from osc2tx import ir
from osc2tx.diagnostics import Label, Span
from osc2tx.lowering.behavior.time_expressions import (
    SLACK,
    Terms,
    Times,
    about,
    at_least,
    at_most,
    ends_of,
    greater_of,
    is_range,
    lies_within,
    names_in,
    resolved,
    rest_of,
    shown,
    solved_for,
    sum_of,
    time_like,
)
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import BOOL
from osc2tx_shared.classes import dataclass, replace


def _binary(span: Span, operator: str, one: ir.Expression, other: ir.Expression) -> ir.Binary:
    return ir.Binary(span=span, type=BOOL, operator=operator, left=one, right=other)


@dataclass(slots=True, eq=False)
class TimeEquations:
    """The equations between the times of one scenario.

    Attributes:
        ctx: The scenario; parameters that it draws are solved for.
        declared: Its declarations, including parameters.
        solvable: The names of its parameters that are solved for as well.
        constraints: Constraints that are checked before a run.
    """

    ctx: LoweringContext
    declared: list[ir.Declaration]
    solvable: Collection[str]
    constraints: list[ir.Constraint] = field(default_factory=list)

    def relate(self, terms: Terms, whole: ir.Expression) -> None:
        """Require that a sum equals a time, or is in a range of times."""
        if self.is_impossible(terms, whole):
            return
        self._narrow(terms, whole)
        if is_range(whole):
            if terms and isinstance(whole, ir.HalfRange):
                bound_of = at_most if whole.is_lower else at_least
                self._narrow((whole.bound,), bound_of(sum_of(terms)))
            self._demand(terms, whole)
            return
        if terms:
            self._narrow((whole,), sum_of(terms))
        for term in reversed(terms):
            others = tuple(other for other in terms if other is not term)
            parameter = self._parameter(term)
            if parameter is not None and self._is_apart(parameter, (*others, whole)):
                self._set(parameter, rest_of(whole, others))
                return
        computed = self._computed()
        sums = tuple(resolved(term, computed) for term in terms)
        for parameter in reversed([*self._parameters(self.declared), *self._parameters()]):
            value = solved_for(parameter.name, sums, resolved(whole, computed))
            if value is not None and self._is_apart(parameter, (value,)):
                self._set(parameter, value)
                return
        if self.is_variable((*terms, whole)) and not any(map(ir.is_live, (*terms, whole))):
            self._check(self._within(sum_of(terms), about(whole)))

    def bound(self, terms: Terms, whole: ir.Expression) -> bool:
        """Require that a sum does not exceed a time, or a range of times.

        Returns:
            Whether this is possible.
        """
        if self.is_impossible(terms, whole, at_most=True):
            return False
        most = ends_of(whole)[1]
        if most is not None:
            within = at_most(most)
            self._narrow(terms, within)
            self._demand(terms, within)
        if terms:
            self._narrow((whole,), at_least(sum_of(terms)))
        return True

    def relate_either(self, options: Sequence[Terms], whole: ir.Expression) -> None:
        """Require that one of several sums equals a time, or is in a range of times.

        A drawn time that is part of all of them is drawn from the values that they allow.
        """
        if is_range(whole):
            if not all(self._is_held(terms, whole) for terms in options):
                within = [self._within(sum_of(terms), whole) for terms in options]
                self._check(reduce(partial(_binary, whole.span, "or"), within))
            return
        computed = self._computed()
        target = resolved(whole, computed)
        sums = [tuple(resolved(term, computed) for term in terms) for terms in options]
        for parameter in reversed([*self._parameters(self.declared), *self._parameters()]):
            values = [solved_for(parameter.name, terms, target) for terms in sums]
            known = tuple(value for value in values if value is not None)
            if len(known) == len(options) and self._is_apart(parameter, known):
                self._set_to_one_of(parameter, known)
                return
        self.relate(options[0], whole)

    def _demand(self, terms: Terms, whole: ir.Expression) -> None:
        """Have a bound checked before the run, unless it always holds."""
        ends = tuple(end for end in ends_of(whole) if end is not None)
        if not self._is_held(terms, whole) and self.is_variable((*terms, *ends)):
            self._check(self._within(sum_of(terms), whole))

    def _is_held(self, terms: Terms, whole: ir.Expression) -> bool:
        """Whether a sum is in a range for all drawn values."""
        found = self.bounds(terms)
        lower, upper = (None if end is None else self.bounds((end,)) for end in ends_of(whole))
        is_open = [end is None for end in ends_of(whole)]
        if (
            found is None
            or (lower is None and not is_open[0])
            or (upper is None and not is_open[1])
        ):
            return False
        least = -inf if lower is None else lower[1]
        most = inf if upper is None else upper[0]
        return lies_within(found, (least, most))

    def _within(self, value: ir.Expression, whole: ir.Expression) -> ir.Binary:
        """Return the test whether a time lies in a range, whose bounds may turn out reversed."""
        lower, upper = ends_of(whole)
        least = None if lower is None else _binary(whole.span, ">=", value, lower)
        most = None if upper is None else _binary(whole.span, "<=", value, upper)
        if least is None or most is None:
            half = least or most
            assert half is not None
            return half
        is_drawn_apart = names_in((lower,)) != names_in((upper,)) if lower and upper else False
        if is_drawn_apart:
            return _binary(whole.span, "and", least, most)
        return _binary(whole.span, "in", value, whole)

    def _check(self, expression: ir.Binary) -> None:
        self.constraints.append(ir.Constraint(expression=expression, span=expression.span))

    def _set_to_one_of(self, parameter: ir.Parameter, values: Terms) -> None:
        """Restrict a drawn time to those of several values that can be in its range."""
        assert isinstance(parameter.domain, ir.RangeValue)
        domain, had = parameter.domain, self.bounds((parameter.domain,))
        fitting = tuple(each for each in values if self.fits((each,), domain)) or values
        name = ir.FieldRef(span=parameter.span, type=parameter.type, name=parameter.name)
        drawn = ir.Choices(span=parameter.span, type=parameter.type, elements=fitting)
        self._replace(parameter, replace(parameter, domain=drawn))
        if not all(lies_within(self.bounds((each,)), had) for each in fitting):
            self._check(self._within(name, domain))

    def _set(self, parameter: ir.Parameter, value: ir.Expression) -> None:
        """Give a drawn time the value that an equation leaves it."""
        assert isinstance(parameter.domain, ir.RangeValue)
        found, wanted = self.bounds((value,)), self.bounds((parameter.domain,))
        name = ir.FieldRef(span=parameter.span, type=parameter.type, name=parameter.name)
        solved = replace(parameter, value=value, domain=None, is_fixed=True)
        if parameter in self.ctx.state.drawn:
            self.ctx.state.drawn.remove(parameter)
            self.ctx.state.drawn.append(solved)
        else:
            self._replace(parameter, solved)
        if not lies_within(found, wanted):
            self._check(self._within(name, parameter.domain))

    def is_impossible(self, terms: Terms, whole: ir.Expression, at_most: bool = False) -> bool:
        """Report a sum that is never a time, or in a range; return whether it is so."""
        if self.fits(terms, whole, at_most):
            return False
        found, wanted = self.bounds(terms), self.bounds((whole,))
        labels = [Label(term.span, f"this takes {shown(self.bounds((term,)))}") for term in terms]
        what = f"{shown(wanted)} here contradict the {shown(found)} that members take"
        self.ctx.sink.report(
            "OSC519",
            whole.span,
            what,
            labels=labels,
            help="let them agree, or leave one of them open",
        )
        return True

    def fits(self, terms: Terms, whole: ir.Expression, at_most: bool = False) -> bool:
        """Return whether a sum may be a time, or in a range, as far as is known.

        Args:
            terms: That add up.
            whole: The time, or the range.
            at_most: The sum may also be less.
        """
        found, wanted = self.bounds(terms), self.bounds((whole,))
        if found is None or wanted is None:
            return True
        is_longer = found[0] > wanted[1] + SLACK
        return not is_longer and (at_most or found[1] >= wanted[0] - SLACK)

    # --- the longest of several ---

    def relate_longest(self, members: Sequence[Terms], whole: ir.Expression) -> None:
        """Require that the longest of some members is as long as the whole."""
        if len(members) == 1:
            self.relate(members[0], whole)
            return
        longest = self.longest(members)
        variable = [each for each in members if self.is_variable(each)]
        reached = [self.bounds(each) for each in members if each not in variable]
        wanted = self.bounds((whole,))
        if wanted is not None and any(
            found is not None and found[1] >= wanted[0] - SLACK for found in reached
        ):
            return
        fitting = [each for each in variable if self.fits(each, whole)]
        if fitting and not is_range(whole):
            self.relate(fitting[0], whole)
        else:
            self.relate(longest, whole)

    def longest(self, members: Sequence[Terms]) -> Terms:
        """Return the greatest of several lengths."""
        if len(members) == 1:
            return members[0]
        sums = [sum_of(each) for each in members]
        ranges = [self.bounds((each,)) for each in sums]
        for one, found in zip(sums, ranges, strict=True):
            others = [other for each, other in zip(sums, ranges, strict=True) if each is not one]
            if found is not None and all(o is not None and o[1] <= found[0] for o in others):
                return (one,)
        return (reduce(greater_of, sums),)

    # --- known times ---

    def _values(self) -> dict[str, ir.Expression]:
        found: dict[str, ir.Expression] = {}
        for each in (*self.declared, *self.ctx.state.drawn):
            if isinstance(each, ir.Parameter):
                is_open = each.value is None or not each.is_fixed
                value = each.domain if is_open else each.value
                if value is not None:
                    found[each.name] = value
        return found

    def _computed(self) -> dict[str, ir.Expression]:
        """Return the values of parameters that have one, defaults included."""
        known = (*self.declared, *self.ctx.state.drawn)
        parameters = (each for each in known if isinstance(each, ir.Parameter))
        return {each.name: each.value for each in parameters if each.value is not None}

    def bounds(self, terms: Terms) -> Times | None:
        """Return the least and the greatest sum (s); None if one of the terms is unknown."""
        values = self._values()
        total = (0.0, 0.0)
        for term in terms:
            low, high = ends_of(term)
            least = (0.0, 0.0) if low is None else ir.bounds(resolved(low, values), values)
            most = (inf, inf) if high is None else ir.bounds(resolved(high, values), values)
            if least is None or most is None:
                return None
            total = total[0] + min(least[0], most[0]), total[1] + max(least[1], most[1])
        return total

    def _parameters(
        self, declarations: Sequence[ir.Declaration] | None = None
    ) -> list[ir.Parameter]:
        """Return the parameters that can be solved for, by default those of ranges."""
        drawn = self.ctx.state.drawn if declarations is None else declarations
        return [
            each
            for each in drawn
            if isinstance(each, ir.Parameter)
            and each.value is None
            and isinstance(each.domain, ir.RangeValue)
            and (declarations is None or each.name in self.solvable)
        ]

    def _parameter(self, term: ir.Expression) -> ir.Parameter | None:
        """Return the parameter that a time is, if it can be solved for."""
        if not isinstance(term, ir.FieldRef):
            return None
        known = (*self._parameters(), *self._parameters(self.declared))
        return next((each for each in known if each.name == term.name), None)

    def _replace(self, old: ir.Parameter, new: ir.Parameter) -> None:
        declarations = self.ctx.state.drawn if old in self.ctx.state.drawn else self.declared
        declarations[declarations.index(old)] = new

    def _is_apart(self, parameter: ir.Parameter, others: Terms) -> bool:
        """Whether other times can be known without a parameter, defaults included."""
        values = self._values()
        values |= self._computed()
        pending, needed = names_in(others), set[str]()
        while pending:
            needed |= pending
            read = (names_in((values[name],)) for name in pending if name in values)
            pending = set[str]().union(*read) - needed
        return parameter.name not in needed

    def _narrow(self, terms: Terms, whole: ir.Expression) -> None:
        """Leave to drawn times the rest of a whole."""
        wanted = self.bounds((whole,))
        for term in terms if wanted is not None else ():
            parameter = self._parameter(term)
            others = self.bounds(tuple(other for other in terms if other is not term))
            if parameter is None or others is None or wanted is None:
                continue
            assert isinstance(parameter.domain, ir.RangeValue)
            had = self.bounds((parameter.domain,))
            if had is None:
                continue
            low, high = max(had[0], wanted[0] - others[1]), min(had[1], wanted[1] - others[0])
            if low <= had[0] + SLACK and high >= had[1] - SLACK:
                continue
            lower = time_like(low, parameter.domain.lower)
            if high - low <= SLACK:
                narrowed = replace(parameter, value=lower, domain=None, is_fixed=True)
            else:
                upper = time_like(high, parameter.domain.upper)
                domain = replace(parameter.domain, lower=lower, upper=upper)
                narrowed = replace(parameter, domain=domain)
            self._replace(parameter, narrowed)

    def is_variable(self, terms: Terms) -> bool:
        """Whether a sum depends on drawn values."""
        drawn = {
            each.name
            for each in (*self.ctx.state.drawn, *self.declared)
            if isinstance(each, ir.Parameter) and each.domain is not None
        }
        return bool(drawn & names_in(terms))
