"""Durations of invoked scenarios, from the times that they draw (§7.6.2.1.4).

A duration around an invocation bounds the invoked scenario. Where a duration requires it, the
invoker draws the times of the invoked scenario: they are parameters of the invoker, solved for like
its own, and passed by path.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import field
from itertools import product
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.behavior.time_expressions import Terms, is_range, names_in
from osc2tx.lowering.context import LoweringContext
from osc2tx_shared.classes import dataclass, replace

ScenarioOf: TypeAlias = Callable[[str], "ir.AbstractScenario | None"]
"""Gives a lowered scenario by its key; nothing for one that is just being lowered."""


class _Undecided(Exception):
    """Only the run decides a length."""


@dataclass(frozen=True, slots=True)
class Lasting:
    """The duration of an invoked scenario.

    Attributes:
        terms: Times that add up, in terms of the invoker.
        goes_on: It continues behind them for the rest of the given duration.
        members: The times of members that run together: the longest counts.
    """

    terms: Terms = ()
    goes_on: bool = False
    members: tuple[Terms, ...] = ()


Lengths: TypeAlias = tuple[Lasting, ...]

MOST_CHOICES = 16
"""Choices of alternatives that are compared with a duration."""


@dataclass(frozen=True, slots=True, eq=False)
class _Frame:
    """One invocation.

    Attributes:
        scenario: The invoked scenario.
        given: Arguments, each with the frame of its expression; None for the invoker.
        path: Path of the invocation, below the outermost one.
        who: Name of the invocation, for the names of times.
        drawn: Times that the invoker draws for the outermost invocation, by path.
    """

    scenario: ir.Scenario
    given: Mapping[str, tuple[ir.Expression, _Frame | None]]
    path: str
    who: str
    drawn: dict[str, ir.FieldRef]


@dataclass(slots=True, eq=False)
class InvokedTimes:
    """The lengths of the scenarios that one scenario invokes.

    Attributes:
        ctx: The scenario that invokes.
        scenario_of: Gives the invoked ones.
        longest: Returns the greatest of several lengths.
    """

    ctx: LoweringContext
    scenario_of: ScenarioOf
    longest: Callable[[Sequence[Terms]], Terms]
    _drawn: dict[ir.InvokeScenario, dict[str, ir.FieldRef]] = field(default_factory=dict)
    _as_drawn: dict[str, ir.Parameter] = field(default_factory=dict)

    def lengths(self, node: ir.InvokeScenario) -> Lengths:
        """Return the possible durations of an invoked scenario without a given duration.

        Times that it draws become parameters of the invoker. Empty if only the run decides; one
        length for each choice of its alternatives.
        """
        known, drawn = list(self.ctx.state.drawn), dict[str, ir.FieldRef]()
        try:
            frame = self._invoked(node, None, drawn)
            found = self._lengths(frame.scenario.body, frame)
        except _Undecided:
            self.ctx.state.drawn[:] = known
            return ()
        if drawn:
            self._drawn[node] = drawn
        return found

    # --- passed times ---

    def handed_in(self, tree: ir.Behavior, constraints: Sequence[ir.Constraint]) -> ir.Behavior:
        """Return a tree whose invocations take the solved times.

        Where a duration leaves all of them as they are, the invoked scenario draws them itself.

        Args:
            tree: The tree, with the invocations that `lengths` measured.
            constraints: Constraints that are checked before a run.
        """
        named = names_in(tuple(each.expression for each in constraints))
        named |= {name for each in self.ctx.state.drawn for name in self._read_by(each)}
        by_span: dict[Hashable, tuple[ir.Argument, ...]] = {}
        for node, drawn in self._drawn.items():
            names = {ref.name for ref in drawn.values()}
            if names & named or any(self._is_solved(name) for name in names):
                by_span[node.span] = tuple(
                    ir.Argument(parameter=path, value=ref, is_positional=False, span=ref.span)
                    for path, ref in drawn.items()
                )
            else:
                self.ctx.state.drawn[:] = [
                    each for each in self.ctx.state.drawn if each.name not in names
                ]
        return _with_times(tree, by_span) if by_span else tree

    def _is_solved(self, name: str) -> bool:
        return not any(each is self._as_drawn[name] for each in self.ctx.state.drawn)

    def _read_by(self, drawn: ir.Declaration) -> set[str]:
        if not isinstance(drawn, ir.Parameter):
            return set()
        return names_in(tuple(v for v in (drawn.value, drawn.domain) if v is not None))

    # --- lengths ---

    def _invoked(
        self, node: ir.InvokeScenario, around: _Frame | None, drawn: dict[str, ir.FieldRef]
    ) -> _Frame:
        scenario = self.scenario_of(node.key)
        if not isinstance(scenario, ir.Scenario) or scenario.overrides or node.specials:
            raise _Undecided
        inside = ir.walk_behaviors(scenario.body)
        if any(isinstance(each, ir.Finish) for each in inside):
            raise _Undecided
        given = {a.parameter: (a.value, around) for a in node.arguments}
        if around is None:
            return _Frame(scenario, given, "", _plain_name(node), drawn)
        name = _name_in(around.scenario, node)
        return _Frame(scenario, given, f"{around.path}{name}.", f"{around.who}.{name}", drawn)

    def _lengths(self, node: ir.Behavior, frame: _Frame) -> Lengths:
        if getattr(node, "until", ()):
            raise _Undecided
        duration = getattr(node, "duration", None)
        if duration is not None:
            if is_range(duration):
                raise _Undecided
            return (Lasting((self._term(duration, frame),)),)
        match node:
            case ir.Wait(trigger=ir.Trigger(event=None, condition=ir.Elapsed(duration=time))):
                return (Lasting((self._term(time, frame),)),)
            case ir.InvokeScenario():
                inner = self._invoked(node, frame, frame.drawn)
                return self._lengths(inner.scenario.body, inner)
            case ir.OneOf(members=members):
                return tuple(each for member in members for each in self._lengths(member, frame))
            case ir.Serial(members=members):
                return tuple(map(self._serial, self._choices(members, frame)))
            case ir.Parallel():
                lasting = [member for member in node.members if not ir.is_instant(member)]
                is_plain = node.start_to_start is None and node.end_to_end is None
                if not lasting or not is_plain or node.overlap not in (None, "start"):
                    raise _Undecided
                return tuple(map(self._parallel, self._choices(lasting, frame)))
        if ir.is_instant(node):
            return (Lasting(),)
        if ir.is_open(node):
            return (Lasting(goes_on=True),)
        raise _Undecided

    def _choices(self, members: Sequence[ir.Behavior], frame: _Frame) -> list[Lengths]:
        """Return the lengths of members for each choice of the alternatives inside."""
        found = list(product(*(self._lengths(member, frame) for member in members)))
        if len(found) > MOST_CHOICES:
            raise _Undecided
        return found

    def _serial(self, members: Lengths) -> Lasting:
        if len(members) == 1:
            return members[0]
        if any(member.goes_on for member in members[:-1]):
            raise _Undecided
        terms = tuple(term for member in members for term in member.terms)
        return Lasting(terms, members[-1].goes_on)

    def _parallel(self, members: Lengths) -> Lasting:
        if len(members) == 1:
            return members[0]
        if any(member.goes_on for member in members):
            raise _Undecided
        found = tuple(member.terms for member in members)
        return Lasting(self.longest(found), members=found)

    # --- times ---

    def _term(self, time: ir.Expression, frame: _Frame | None) -> ir.Expression:
        """Return a time of an invoked scenario in terms of the invoker."""
        if frame is None:
            return time
        if not all(isinstance(part, _PLAIN) for part in ir.walk(time)):
            raise _Undecided

        def told(part: ir.Expression) -> ir.Expression | None:
            return self._field(part, frame) if isinstance(part, ir.FieldRef) else None

        return ir.rewrite(time, told)

    def _field(self, read: ir.FieldRef, frame: _Frame) -> ir.Expression:
        path = f"{frame.path}{read.name}"
        if path in frame.drawn:
            return frame.drawn[path]
        if read.name in frame.given:
            value, scope = frame.given[read.name]
            if isinstance(value, ir.RangeValue):
                raise _Undecided  # it draws what lies in its own domain too
            return self._term(value, scope)
        declared = {each.name: each for each in frame.scenario.declarations}.get(read.name)
        match declared:
            case ir.Parameter(is_global=True):
                raise _Undecided
            case ir.Parameter(value=constant, is_fixed=True) if constant is not None:
                return self._term(constant, frame)
            case ir.Parameter(value=None, domain=ir.RangeValue() as domain):
                return self._draw(declared, domain, path, frame)
        raise _Undecided

    def _draw(
        self, declared: ir.Parameter, domain: ir.RangeValue, path: str, frame: _Frame
    ) -> ir.FieldRef:
        bounds = [self._term(end, frame) for end in (domain.lower, domain.upper)]
        within = replace(domain, lower=bounds[0], upper=bounds[1])
        name = f"{declared.name} of {frame.who}"
        ref = self.ctx.draw(name, within, declared.type, declared.span)
        drawn = self.ctx.state.drawn[-1]
        assert isinstance(drawn, ir.Parameter)
        self.ctx.state.drawn[-1] = self._as_drawn[ref.name] = replace(drawn, unit=declared.unit)
        frame.drawn[path] = ref
        return ref


def _plain_name(node: ir.InvokeScenario) -> str:
    return node.label or node.scenario.rpartition(".")[2]


def _name_in(scenario: ir.Scenario, node: ir.InvokeScenario) -> str:
    """Return the name of an invocation in its scenario: equal ones are numbered in their order."""
    inside = ir.walk_behaviors(scenario.body)
    invoked = [each for each in inside if isinstance(each, ir.InvokeScenario)]
    alike = [node]
    if node.label is None:
        alike = [e for e in invoked if e.label is None and _plain_name(e) == _plain_name(node)]
    if len(alike) > 1 and any(ir.is_live(a.value) for each in alike for a in each.arguments):
        raise _Undecided  # they are made, and numbered, when they start
    place = alike.index(node) + 1
    name = _plain_name(node) if place == 1 else f"{_plain_name(node)}_{place}"
    if node.label is None and any(each.label in (name, _plain_name(node)) for each in inside):
        raise _Undecided  # a label has this name
    return name


_PLAIN = (ir.Literal, ir.Quantity, ir.FieldRef, ir.Unary, ir.Binary, ir.Conditional)


def _with_times(
    tree: ir.Behavior, times: Mapping[Hashable, tuple[ir.Argument, ...]]
) -> ir.Behavior:
    """Return a tree whose invocations, by position, are passed their times."""
    match tree:
        case ir.InvokeScenario(span=span) if span in times:
            return replace(tree, times=times[span])
        case ir.Serial(members=members) | ir.Parallel(members=members) | ir.OneOf(members=members):
            return replace(tree, members=tuple(_with_times(each, times) for each in members))
    return tree
