"""Events of a scenario, and the variables that carry them.

An event is a variable that is set when it occurs; who waits for it looks for the edge. So a wait
that begins after the occurrence does not see it, as in the DSL.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.conditions.expressions import condition_flow
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow, Test, at_time, single
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.start_places import read_signal
from osc2tx.backends.xosc.flattening.storyboard import Event
from osc2tx.backends.xosc.scopes import Scope
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.names import plain


class EventTable:
    """The events of one scenario at one place."""

    def __init__(self, ctx: Context, scope: Scope) -> None:
        """Find out who emits what and which labels are waited for."""
        self._ctx = ctx
        self._scope = scope
        self.occurrences = ir.Occurrences(scope.scenario)
        self._early = ir.early_triggers(scope.scenario.body)
        recurring = self.occurrences.recurring()
        self._fleeting = {ctx.variable_name(scope.prefix + name) for name in recurring}
        self._signals = dict(map(read_signal, ctx.options.signals))
        self._following: list[str] = []  # events whose trigger is being looked at
        self._marks = {
            key: ctx.names.new(f"{key[1].value}_of_{plain(scope.prefix + key[0])}")
            for key in dict.fromkeys(self.occurrences.waited())
        }

    def signals(self) -> list[Event]:
        """Return the occurrences of events from outside whose time is given."""
        events = []
        for name, declared in self.occurrences.declared.items():
            time = self._signals.get(self._scope.prefix + name)
            if time is None:
                continue
            called = self._ctx.names.new(f"signal_{plain(self._scope.prefix + name)}")
            at = single(at_time(time))
            events.append(Event(called, (self.setting(name),), at, declared.span))
            self._ctx.report.exact(f"signal {name}", declared.span, f"at {time:g} s, as given")
        return events

    def occurrence(self, trigger: ir.Trigger) -> Flow:
        """Return the tests for an occurrence of the event of a trigger from now on."""
        is_early = id(trigger) in self._early
        match trigger.event:
            case ir.EventRef(name=name) as event:
                return self.of_event(name, event, is_early=is_early)
            case ir.LabelEvent(label=label, moment=moment) if moment in ir.WAITABLE:
                return self.of_label(label, moment, is_early=is_early)
        raise Inexpressible(f"`{trigger.span.text}` has no counterpart here", trigger.span)

    def as_used(self, trigger: ir.Trigger) -> ir.Trigger:
        """Return a trigger where it is used: times that an event declares count from there."""
        meant, names = trigger, set[str]()
        while isinstance(meant.event, ir.EventRef) and meant.condition is None:
            declared = self.occurrences.declared[meant.event.name].trigger
            if declared is None or meant.event.name in names:
                return trigger
            names.add(meant.event.name)
            meant = declared
        counts = isinstance(meant.condition, ir.Elapsed | ir.Every)
        return meant if meant.event is None and counts else trigger

    def of_label(self, label: str, moment: ir.Moment, *, is_early: bool) -> Flow:
        """Return the tests for the start or the end of a member."""
        return self._is_set(self._marks[label, moment], is_early=is_early)

    def activity(self, label: str) -> tuple[str, str]:
        """Return the variables that are set when a labelled member starts and ends, declared."""
        marks = self._marks[label, ir.Moment.START], self._marks[label, ir.Moment.END]
        for mark in marks:
            self._ctx.declare(mark, "boolean", "false")
        return marks

    def mark(self, node: ir.Behavior, moment: ir.Moment) -> str | None:
        """Return the event that keeps the start or end of a labelled member, if one is needed."""
        return None if node.label is None else self._marks.get((node.label, moment))

    def of_event(self, name: str, at: ir.EventRef | ir.InnerEvent, *, is_early: bool) -> Flow:
        """Return the tests for an occurrence of a declared event that is waited for somewhere.

        An early wait surely begins before the event can occur.
        """
        declared = self.occurrences.declared[name]
        trigger = declared.trigger
        if trigger is not None:
            if trigger.condition is None and trigger.event is not None:
                return self._of_followed(name, trigger)
            if trigger.event is not None or trigger.condition is None:
                raise Inexpressible("an event that follows another one under a condition", at.span)
            return condition_flow(self._ctx, trigger.condition)
        if name not in self.occurrences.emitted and self._scope.prefix + name not in self._signals:
            return self._from_outside(name, at, is_early=is_early)
        if not is_early and self.occurrences.lasts(name):
            return self._while_it_lasts(name, at)
        return self._is_set(self.variable(name), is_early=is_early)

    def _while_it_lasts(self, name: str, at: ir.EventRef | ir.InnerEvent) -> Flow:
        """Return the tests for an event that occurs for as long as the reactions see reasons.

        Who begins to wait then does not wait for the next time at which such a time begins.
        """
        reactions = self.occurrences.reacting.get(name, ())
        flow = NEVER
        for node in reactions:
            condition, event = node.trigger.condition, node.trigger.event
            if isinstance(event, ir.EventRef) and condition is None:
                flow = flow | self.of_event(event.name, event, is_early=False)
            elif event is None and isinstance(condition, ir.Level):
                flow = flow | condition_flow(self._ctx, condition)
            else:
                raise Inexpressible("a reaction to an event under a condition", at.span)
        return flow

    def _of_followed(self, name: str, followed: ir.Trigger) -> Flow:
        """Return the tests for the event that another one, `name`, follows."""
        if name in self._following:
            raise Inexpressible("events that only follow each other never occur", followed.span)
        self._following.append(name)
        try:
            return self.occurrence(followed)
        finally:
            self._following.pop()

    def _from_outside(self, name: str, at: ir.EventRef | ir.InnerEvent, *, is_early: bool) -> Flow:
        ctx = self._ctx
        if ctx.version >= "1.2":
            note = f"set the variable `{name}` from outside, or give its time with --signal"
            ctx.report.exact(f"signal {name}", at.span, note)
            return self._is_set(self.variable(name), is_early=is_early)
        if ctx.can("UserDefinedValueCondition", "1.0"):
            value = xml.UserDefinedValueCondition(name=name, rule="equalTo", value="true")
            return single(Test(xml.ByValueCondition(value), "rising"))
        reason = f"`{name}` comes from outside: give its time with --signal {name}@1s"
        raise Inexpressible(reason, at.span, Remedy(version="1.2"))

    def _is_set(self, variable: str, *, is_early: bool) -> Flow:
        """Return the test for a variable; it is looked for its edge unless it cannot be set yet."""
        condition = self._ctx.variable_is(variable, "equalTo", "true")
        if not is_early:
            return single(Test(condition, "rising"))
        return single(Test(condition, latched=variable not in self._fleeting))

    def setting(self, name: str, value: str = "true") -> xml.ActionPart:
        """Return the action that sets the variable of an event."""
        return self._ctx.set_variable(self.variable(name), value)

    def variable(self, name: str) -> str:
        """Return the variable of an event, declared."""
        variable = self._ctx.variable_name(self._scope.prefix + name)
        self._ctx.declare(variable, "boolean", "false")
        return variable
