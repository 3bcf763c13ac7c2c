"""Durations and `until` that contradict each other in every run (§7.6.2.1, §7.6.2.5.4).

Only times of literals count: the run checks those that parameters or the run decide.
"""

from __future__ import annotations

from math import inf

from osc2tx.analysis.constraints.domains import Interval
from osc2tx.analysis.constraints.operation_list import OperationListBuilder
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.constraints.solver import values_on
from osc2tx.analysis.lints.termination import Endings
from osc2tx.analysis.tree_walk import do_directives, do_members
from osc2tx.diagnostics import DiagnosticSink, Label, Span
from osc2tx.semantics import SemanticModel
from osc2tx.syntax import ast

Times = tuple[float, float]
"""Least and most seconds."""

SLACK = 1e-9  # s


def report_durations(model: SemanticModel, endings: Endings, sink: DiagnosticSink) -> None:
    """Report the members of the root file whose `until` contradicts the time that they take."""
    judge = _Durations(model, endings)
    for scenario in model.scenarios:
        for directive in do_directives(scenario):
            if directive not in scenario.statements:
                continue
            members = list(do_members(directive.member))
            judge.measure(members)
            for member in members:
                if isinstance(member, ast.Composition | ast.Invocation):
                    _report(judge, member, sink)


def _report(
    judge: _Durations, member: ast.Composition | ast.Invocation, sink: DiagnosticSink
) -> None:
    given = judge.given(member)
    length = judge.own_length(member) if given is None else given
    until = judge.until(member)
    if length is None or until is None:
        return
    ends, span = until
    if ends[0] > length[1] + SLACK:
        when = f"later than the {_text(length)} that it takes"
    elif given is not None and ends[1] < given[0] - SLACK:
        when = f"earlier than its duration of {_text(given)}"
    else:  # `until` may end a member early
        return
    other = judge.span_of_duration(member)
    sink.report(
        "OSC439",
        span,
        f"this ends it after {_text(ends)}, {when}",
        labels=[] if other is None else [Label(other, "its duration")],
        help="state only one of them, or make them agree",
    )


def _text(times: Times) -> str:
    low, high = times
    return f"{low:g} s" if low == high else f"{low:g} s to {high:g} s"


class _Durations:
    """The times of members, as far as literals state them."""

    def __init__(self, model: SemanticModel, endings: Endings) -> None:
        self._model = model
        self._endings = endings
        self._lengths: dict[ast.BehaviorMember, Times | None] = {}

    def measure(self, members: list[ast.BehaviorMember]) -> None:
        """Note how long the members of a tree take, the inner ones first.

        Args:
            members: Those in source order.
        """
        for member in reversed(members):
            self._lengths[member] = self._length(member)

    def given(self, member: ast.Composition | ast.Invocation) -> Times | None:
        """Return the `duration` of a member."""
        value = self._duration_of(member)
        return None if value is None else self._times(value)

    def span_of_duration(self, member: ast.Composition | ast.Invocation) -> Span | None:
        """Return the place of the `duration` of a member."""
        value = self._duration_of(member)
        return None if value is None else value.span

    def own_length(self, member: ast.BehaviorMember) -> Times | None:
        """Return how long a member takes that ends by itself."""
        match member:
            case ast.EmitDirective() | ast.CallDirective():
                return (0.0, 0.0)
            case ast.WaitDirective(event=event):
                return self._elapsed(event)
            case ast.Composition(operator=ast.CompositionOperator.SERIAL) if (
                member not in self._endings.endless and not member.arguments
            ):
                return _sum([self._lengths[child] for child in member.members])
            case _:
                return None

    def until(self, member: ast.Composition | ast.Invocation) -> tuple[Times, Span] | None:
        """Return when the `until`s of a member end it, if they are times, and the first place."""
        directives = [m for m in member.with_members if isinstance(m, ast.UntilDirective)]
        found = [self._elapsed(directive.event) for directive in directives]
        times = [each for each in found if each is not None]
        if not times or len(times) < len(found):
            return None
        first = min(zip(times, directives, strict=True), key=lambda pair: pair[0])[1]
        return (min(low for low, _ in times), min(high for _, high in times)), first.event.span

    def _length(self, member: ast.BehaviorMember) -> Times | None:
        """Return the duration of a member, with its bounds."""
        if not isinstance(member, ast.Composition | ast.Invocation):
            return self.own_length(member)
        until, given = self.until(member), self.given(member)
        return (
            given if given is not None else self.own_length(member) if until is None else until[0]
        )

    def _duration_of(self, member: ast.Composition | ast.Invocation) -> ast.Expression | None:
        is_first = isinstance(member, ast.Composition) and (
            member.operator is not ast.CompositionOperator.PARALLEL
        )
        for argument in member.arguments:
            name = "duration" if is_first else ""
            if (argument.name.text if argument.name is not None else name) == "duration":
                return argument.value
        return None

    def _elapsed(self, event: ast.EventSpecification) -> Times | None:
        condition = event.condition
        if event.event is not None or not isinstance(condition, ast.ElapsedCondition):
            return None
        return self._times(condition.duration)

    def _times(self, expression: ast.Expression) -> Times | None:
        """Return the value of an expression of literals, in seconds."""
        if isinstance(expression, ast.RangeLiteral):
            low, high = self._times(expression.lower), self._times(expression.upper)
            return None if low is None or high is None else (low[0], high[1])
        place = Place(model=self._model, owner=None, prefix=(), it=None)
        operations = OperationListBuilder(self._model).write(expression, place.locate)
        value = values_on(operations, {})[-1]
        if not isinstance(value, Interval) or value.nan or not value.is_point:
            return None
        return (float(value.lower), float(value.lower)) if abs(value.lower) < inf else None


def _sum(lengths: list[Times | None]) -> Times | None:
    known = [length for length in lengths if length is not None]
    if len(known) < len(lengths):
        return None
    return sum(low for low, _ in known), sum(high for _, high in known)
