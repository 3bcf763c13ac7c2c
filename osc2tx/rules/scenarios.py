"""Applies the rules to all objects, calls, durations and periods of a program."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from osc2tx import ir
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.rules.calls import CallCheck
from osc2tx.rules.given import domains_of
from osc2tx.rules.objects import ObjectCheck


def check_rules(module: ir.Module, sink: DiagnosticSink) -> None:
    """Report the objects, calls and times in a program that break a rule of the library."""
    objects = ObjectCheck({each.name: each for each in module.types}, sink)
    for scenario in (*module.bases, *module.scenarios):
        check = _Check(scenario.declarations, sink)
        for declaration in scenario.declarations:
            objects.check(declaration)
            check.triggers(_triggers_of(declaration))
        for placement in scenario.placements:
            for modifier in placement.modifiers:
                check.calls.placing(modifier)
        if isinstance(scenario, ir.Scenario):
            unknown = {id(node) for node in _with_unknown_end(scenario)}
            for node in ir.walk_behaviors(scenario.body):
                check.behavior(node, ends_unknown=id(node) in unknown)


def _triggers_of(declaration: ir.Declaration) -> Iterator[ir.Trigger]:
    match declaration:
        case ir.Variable(sample=ir.Sample(trigger=ir.Trigger() as trigger)):
            yield trigger
        case ir.Event(trigger=ir.Trigger() as trigger):
            yield trigger


def _with_unknown_end(scenario: ir.Scenario) -> Iterator[ir.Invoke]:
    """Yield the actions that have no duration, and that no duration around them ends.

    Such a duration is that of a composition that they end with. What invokes the scenario may state
    one as well.
    """
    pending: list[tuple[ir.Behavior, bool]] = [(scenario.body, scenario.is_runnable)]
    while pending:
        node, is_unknown = pending.pop()
        match node:
            case ir.Invoke(duration=None) if is_unknown or node.until:
                yield node
            case ir.CompositionBase():
                inside = node.duration is None and (is_unknown or bool(node.until))
                *others, last = node.members
                pending.append((last, inside or isinstance(node, ir.OneOf)))
                ends_with = inside or not isinstance(node, ir.Parallel)
                pending += ((member, ends_with) for member in others)


class _Check:
    def __init__(self, declarations: Sequence[ir.Declaration], sink: DiagnosticSink) -> None:
        self.calls = CallCheck(declarations, sink)
        self._domains = domains_of(declarations)
        self._sink = sink

    def behavior(self, node: ir.Behavior, *, ends_unknown: bool) -> None:
        if isinstance(node, ir.Invoke):
            self.calls.invocation(node, ends_unknown=ends_unknown)
        match node:
            case (
                ir.Invoke(duration=ir.ExpressionBase() as duration)
                | ir.InvokeScenario(duration=ir.ExpressionBase() as duration)
                | ir.CompositionBase(duration=ir.ExpressionBase() as duration)
            ):
                self._at_least_zero(duration)
        self.triggers(ir.triggers_of(node))

    def triggers(self, triggers: Iterable[ir.Trigger]) -> None:
        for trigger in triggers:
            match trigger.condition:
                case ir.Every(period=period):
                    self._above_zero(period)
                case ir.Elapsed(duration=duration):
                    self._at_least_zero(duration)

    def _at_least_zero(self, duration: ir.Expression) -> None:
        for value in ir.children(duration) if isinstance(duration, ir.RangeValue) else (duration,):
            seconds = ir.bounds(value, self._domains)
            if seconds is not None and seconds[1] < 0.0:
                self._sink.report("OSC513", value.span, "a duration cannot be negative")

    def _above_zero(self, period: ir.Expression) -> None:
        seconds = ir.constant(period)
        if seconds is not None and seconds <= 0.0:
            self._sink.report("OSC513", period.span, "a period must be above zero")
