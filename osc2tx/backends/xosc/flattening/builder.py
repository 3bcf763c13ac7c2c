"""Storyboard builder: the current act, marks, and triggers as flows."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import construct_of_action
from osc2tx.backends.xosc.conditions.expressions import condition_flow
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow, Test, run_start, single, state_of
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.events import EventTable
from osc2tx.backends.xosc.flattening.storyboard import ACTION, Act, Event
from osc2tx.backends.xosc.flattening.tree_queries import claims
from osc2tx.backends.xosc.names import member_name
from osc2tx.backends.xosc.state import LATERAL, ActorState, merged
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import replace

RUN_START = single(run_start())

VERDICT = "verdict"
"""Name of the monitor that says whether the scenario has succeeded."""


class StoryboardBuilder:
    """The acts of one scenario while they are made.

    A mark is an event that only sets a variable: it keeps that a flow has become true.

    Attributes:
        ctx: The scenario.
        act: The one that events go to.
        mark_actor: The actor whose maneuver holds marks and emissions.
        finished: When the scenario ends before its tree does.
        is_race: The action that is written down now may lose a race before it is done.
        place: Where the member stands that is written down now.
    """

    def __init__(self, ctx: Context) -> None:
        """Begin with one act for all."""
        self.ctx = ctx
        ctx.names.new(ACTION)
        self.act = Act(ctx.names.new("act"), RUN_START)
        self.mark_actor: str | None = None
        self.finished = NEVER
        self.is_race = False
        self.place = ctx.scenario.span
        self._outermost = self.act
        self._closed: list[Act] = []
        self._around: list[Act] = []
        self._stop_states: list[dict[str, ActorState]] = []
        self._tables = {id(scope): EventTable(ctx, scope) for scope in ctx.scope.all()}

    @property
    def events(self) -> EventTable:
        """The events of the scenario that is being written down."""
        return self._tables[id(self.ctx.scope)]

    @property
    def acts(self) -> tuple[Act, ...]:
        """All acts, inner ones first: so tools see their ends in the step in which they end."""
        return (*self._closed, self._outermost)

    @property
    def is_outermost(self) -> bool:
        """Whether nothing can stop what is written down now but the end of the scenario."""
        return self.act is self._outermost

    # --- events and acts --------------------------------------------------------------------------

    def add(
        self,
        name: str,
        actions: tuple[xml.ActionPart, ...],
        start: Flow,
        *,
        actor: str | None = None,
        repeats: int | None = None,
        lasting: float = 0.0,
        is_step: bool = False,
    ) -> Flow:
        """Add an event to the maneuver of an actor, or of none; return when it is complete.

        It surely lasts so many seconds; for the others see `Event`.
        """
        made = Event(name, actions, start, self.place, repeats=repeats, is_step=is_step)
        self.act.add(actor, made)
        # Which of two ends is the later one must not depend on open parameters.
        is_open = bool(self.ctx.choosing.parameters)
        follows = () if is_open else start.followed_after(lasting)
        return single(replace(state_of("event", name), follows=follows))

    def tell_failure(self, name: str, start: Flow) -> Flow:
        """Add the event that lets the monitor tell that the scenario has failed; return its end.

        An event that is stopped with its act is complete too, so there a mark tells that it was.
        """
        self.ctx.monitors[VERDICT] = True
        name = self.ctx.names.new(name)
        action = xml.GlobalAction(xml.SetMonitorAction(monitorRef=VERDICT, value=False))
        if self.is_outermost:
            return self.add(name, (action,), start, actor=self.mark_actor)
        self.add(name, (action, self.ctx.mark(name)), start, actor=self.mark_actor)
        return self.is_set(name)

    def add_signals(self) -> None:
        """Add the events from outside whose time is given."""
        for table in self._tables.values():
            for event in table.signals():
                self.act.add(None, event)

    def open_act(self, name: str, start: Flow) -> Act:
        """Let events go to a new act."""
        act = Act(self.ctx.names.new(name), start, around=self.act)
        self._around.append(self.act)
        self._stop_states.append(
            {name: replace(state, unfinished=()) for name, state in self.ctx.states.items()}
        )
        self.act = act
        return act

    def close_act(self) -> None:
        """Let events go to the act around; what was going on may have been stopped anywhere."""
        self._closed.append(self.act)
        for name, state in self._stop_states.pop().items():
            is_aside = state.offset is None and self.ctx.states[name].offset is not None
            left = ((LATERAL, self.act.name),) if is_aside else ()
            self.ctx.states[name] = replace(state, unfinished=left)
        self.act = self._around.pop()

    def note(self, entity: str, state: ActorState) -> None:
        """Note a state in which an act that is open now may be stopped."""
        for states in self._stop_states:
            states[entity] = merged(states[entity], state)

    def finish_acts(self) -> None:
        """Give acts without events one, as the schema asks for it, and pass stops on inwards."""
        for act in self.acts:
            if not act.events:
                name = self.ctx.names.new(f"mark_{act.name}")
                is_outermost = act is self._outermost
                start = RUN_START if is_outermost else _is_running(act)
                actions = (self.ctx.mark(name),)
                act.add(None, Event(name, actions, start, self.ctx.scenario.span))
            around = dict.fromkeys(act.stops_around())
            for mark in around:  # what is complete because it was stopped must start nothing
                condition = self.ctx.variable_is(mark, "equalTo", "false")
                act.start = act.start & single(Test(condition))
            for mark in (*act.stops, *around):
                act.stop = act.stop | self.is_set(mark)

    def running(self, act: Act) -> Flow:
        """Return when the present act runs; tools that do not know such states want a mark."""
        if "state/runningState" not in self.ctx.profile.unsupported:
            return _is_running(act)
        return self.keep(self.ctx.names.new(f"begin_{act.name}"), RUN_START)

    def is_with_run(self, flow: Flow) -> bool:
        """Whether a flow is the start of the present act, which begins with the run."""
        if self.is_outermost:
            return flow == RUN_START
        return self.act.start == RUN_START and flow == _is_running(self.act)

    def name_of(self, node: ir.Behavior) -> str:
        """Return what a member of the scenario that is being written down is called."""
        return member_name(self.ctx.scope.scenario, node)

    # --- flows ------------------------------------------------------------------------------------

    def latched(self, flow: Flow, name: str) -> Flow:
        """Return a flow that stays true, by means of a mark if need be."""
        if flow.is_latched:
            return flow
        return self.keep(self.ctx.names.new(f"before_{name}"), flow)

    def keep(self, mark: str, flow: Flow) -> Flow:
        """Add a mark; return when it is set."""
        self.add(mark, (self.ctx.mark(mark),), flow, actor=self.mark_actor)
        return self.is_set(mark)

    def is_set(self, variable: str) -> Flow:
        """Return the flow of a variable that stays set."""
        condition = self.ctx.variable_is(variable, "equalTo", "true")
        return single(Test(condition, latched=True))

    def mark_start(self, node: ir.Behavior, start: Flow) -> Flow:
        """Keep the start of a member whose label is waited for; return when it starts."""
        mark = self.events.mark(node, ir.Moment.START)
        if mark is None:
            return start
        kept = self.keep(mark, start)
        return start if start.is_latched else kept

    def mark_end(self, node: ir.Behavior, end: Flow) -> Flow:
        """Keep the end of a member whose label is waited for; return when it ends."""
        mark = self.events.mark(node, ir.Moment.END)
        return end if mark is None or end.is_never else self.keep(mark, end)

    # --- triggers ---------------------------------------------------------------------------------

    def after(self, trigger: ir.Trigger, start: Flow) -> Flow:
        """Return when a trigger occurs that is looked at from a flow on."""
        flow, trigger = start, self.events.as_used(trigger)
        match trigger.event:
            case None:
                pass
            case ir.InnerEvent(label=label, name=name) as event:
                if "." in name:
                    raise Inexpressible("an event deep inside of an invoked scenario", event.span)
                with self.ctx.within(self.ctx.scope.by_label[label]):
                    flow = flow & self.events.of_event(name, event, is_early=False)
            case _:
                flow = flow & self.events.occurrence(trigger)
        match trigger.condition:
            case None:
                return flow
            case ir.Elapsed(duration=duration) if trigger.event is None:
                return flow.later(self.ctx.values.number(duration))
            case ir.Every(offset=offset) if trigger.event is None:  # its first time, which ends it
                return flow if offset is None else flow.later(self.ctx.values.number(offset))
            case ir.Elapsed() | ir.Every():
                raise Inexpressible("this condition has no counterpart here", trigger.span)
            case condition:
                if trigger.event is not None and isinstance(condition, ir.Edge):
                    raise Inexpressible("an edge of a condition at an event", trigger.span)
                tests = condition_flow(self.ctx, condition)
                self.ctx.report.exact("condition", condition.span)
                return flow & tests

    def limit(self, node: ir.Composition | ir.Invoke | ir.InvokeScenario, start: Flow) -> Flow:
        """Return when a member that starts with a flow is over at the latest."""
        lasting = self.length_of(node)
        ends = NEVER if lasting is None else start.later(lasting)
        return ends | self.until(node, start) | self.overridden(node, start)

    def until(self, node: ir.Composition | ir.Invoke | ir.InvokeScenario, start: Flow) -> Flow:
        """Return when one of the `until` of a member occurs."""
        ends = NEVER
        for trigger in node.until:
            ends = ends | self.after(trigger, start)
            self.ctx.report.exact("until", trigger.span)
        return ends

    def overridden(self, node: ir.Behavior, start: Flow) -> Flow:
        """Return when a member starts that overrides this one, which starts with a flow."""
        ends = NEVER
        for label in self.overriding(node):
            is_first = start == RUN_START  # else the other one may have started before
            ends = ends | start & self.events.of_label(label, ir.Moment.START, is_early=is_first)
        return ends

    def overriding(self, node: ir.Behavior) -> list[str]:
        """Return the labels of the members that end this one when they start."""
        found = []
        for override in self.ctx.scope.scenario.overrides:
            if node.label is None or override.overridden != node.label:
                continue
            self.ctx.report.exact("override", override.span)
            found.append(override.by)
        return found

    def is_unset(self, variable: str) -> Flow:
        """Return the flow of a variable that is not set, or not yet."""
        self.ctx.declare(variable, "boolean", "false")
        return single(Test(self.ctx.variable_is(variable, "equalTo", "false")))

    def length_of(self, node: ir.Composition | ir.Invoke | ir.InvokeScenario) -> float | None:
        """Return the duration (s) that is written for a member; of a range the least."""
        if node.duration is None:
            return None
        least, _ = self.ctx.values.bounds(node.duration)
        self.ctx.report.exact("duration", node.duration.span)
        return least

    # --- actors -----------------------------------------------------------------------------------

    def acting(self, member: ir.Behavior) -> list[str]:
        """Return the entities that act in a member, in source order."""
        cast = self.ctx.cast
        found = [cast[name].name for name in ir.actors_of(member) if name in cast]
        for node in ir.walk_behaviors(member):
            if isinstance(node, ir.InvokeScenario):
                with self.ctx.within(self.ctx.scope.of(node)):
                    found.extend(self.acting(self.ctx.scope.scenario.body))
        return list(dict.fromkeys(found))

    def claimed(self, node: ir.Behavior) -> frozenset[tuple[str, str]]:
        """Return the entities and domains that a member takes over when it starts."""
        cast = self.ctx.cast
        return frozenset(
            (cast[actor].name, domain) for actor, domain in claims(node) if actor in cast
        )

    def claimed_by(self, labels: list[str]) -> frozenset[tuple[str, str]]:
        """Return the same for labelled members."""
        nodes = ir.walk_behaviors(self.ctx.scope.scenario.body)
        found = (self.claimed(node) for node in nodes if node.label in labels)
        return frozenset[tuple[str, str]]().union(*found)


def construct_of(node: ir.Behavior) -> str:
    """Return what a member is called in reports."""
    match node:
        case ir.Invoke():
            return construct_of_action(node)
        case ir.OneOf():
            return "one_of"
        case ir.InvokeScenario():
            return "scenario invocation"
        case ir.Finish(succeeds=succeeds):
            return "emit end" if succeeds else "emit fail"
    return type(node).__name__.lower()


def _is_running(act: Act) -> Flow:
    return single(state_of("act", act.name, "runningState"))
