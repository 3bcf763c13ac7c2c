"""Flattens the tree of a scenario into acts and events.

Each invocation becomes an event; a composition has no element: its start and its end are flows
over the states of events. What can be cut short and holds more than one event becomes an act with
a stop trigger.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import assert_never

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow, all_of, any_of, are_few, chosen
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.builder import RUN_START, StoryboardBuilder, construct_of
from osc2tx.backends.xosc.flattening.directives import call, emit, finish, react
from osc2tx.backends.xosc.flattening.durations import end_within_duration
from osc2tx.backends.xosc.flattening.failures import Role
from osc2tx.backends.xosc.flattening.leaves import end_open_actions, invoke
from osc2tx.backends.xosc.flattening.lengths import fitting
from osc2tx.backends.xosc.flattening.parallel_overlaps import (
    report_conflicts,
    starts_of,
    unless_active,
)
from osc2tx.backends.xosc.flattening.storyboard import Act
from osc2tx.backends.xosc.flattening.tree_queries import follows_route, may_go_on
from osc2tx.backends.xosc.state import either
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc.element import Unwritable

WITHOUT_STOPS = Remedy(
    profile="generic",
    instead="a duration of each action, or a `parallel` of single actions, needs no stop",
)


class Flattener:
    """Makes the acts of one scenario."""

    def __init__(self, ctx: Context) -> None:
        """Take the scenario; the states of its actors are those after the placement."""
        self._ctx = ctx
        self._builder = StoryboardBuilder(ctx)
        self._racers: set[Span] = set()  # members of races
        self._entrants: set[Span] = set()  # those that have an act of their own
        self._is_racing = False  # the present place is inside a member of a race

    @property
    def acts(self) -> Sequence[Act]:
        """Those made so far."""
        return self._builder.acts

    def run(self) -> Flow:
        """Flatten the tree; return when it ends."""
        self._builder.add_signals()
        end = self._member(self._ctx.scenario.body, RUN_START)
        self._builder.finish_acts()
        return end | self._builder.finished

    def _member(self, node: ir.Behavior, start: Flow) -> Flow:
        """Flatten a member that starts with a flow; return when it ends, `NEVER` if it does not."""
        outer, self._builder.place = self._builder.place, node.span
        end = start
        try:
            start, skipped = unless_active(self._builder, node, start)
            end = self._flatten(node, self._builder.mark_start(node, start)) | skipped
        except Unwritable as error:
            self._ctx.report.refuse(construct_of(node), node.span, error)
        else:
            if not isinstance(node, ir.Invoke):  # actions report themselves
                self._ctx.report.exact(construct_of(node), node.span)
        self._builder.place = outer
        return end

    def _flatten(self, node: ir.Behavior, start: Flow) -> Flow:
        match node:
            case ir.Serial():
                return self._bounded(node, start, lambda at: self._serial(node, at))
            case ir.Parallel():
                return self._bounded(node, start, lambda at: self._parallel(node, at))
            case ir.OneOf():
                return self._bounded(node, start, lambda at: self._one_of(node, at))
            case ir.InvokeScenario():
                return self._bounded(node, start, lambda at: self._scenario(node, at))
            case ir.Invoke():
                return invoke(self._builder, node, start, self._role(node))
            case ir.Wait():
                begin = self._builder.latched(start, self._builder.name_of(node))
                end = self._builder.after(node.trigger, begin)
                return self._builder.mark_end(node, end)
            case ir.Emit():
                return emit(self._builder, node, start)
            case ir.Finish():
                return finish(self._builder, node, start)
            case ir.On():
                return react(self._builder, node, start)
            case ir.Call():
                return call(self._builder, node, start)
            case _:
                assert_never(node)

    # --- compositions -----------------------------------------------------------------------------

    def _serial(self, node: ir.Serial, start: Flow) -> Flow:
        flow = start
        for index, member in enumerate(node.members):
            began, flow = flow, self._member(member, flow)
            is_last = index + 1 == len(node.members)
            if not is_last:
                self._require_end(member, flow)
            if flow.is_never:
                if is_last and index and ir.is_open(member):
                    flow = Flow((), flow.open_since or began)
                break
            if not is_last:
                following = self._builder.claimed(node.members[index + 1])
                flow = end_open_actions(self._builder, flow, member, following)
        return flow

    def _require_end(self, member: ir.Behavior, end: Flow) -> None:
        """Refuse a member that never ends though others follow it.

        Raises:
            Inexpressible: No run gets past it.
        """
        content = member
        if isinstance(member, ir.InvokeScenario) and member.duration is None and not member.until:
            content = self._ctx.scope.of(member).scenario.body
        if not may_go_on(content, self._ctx.module.one_of):
            return
        instead = Remedy(instead="a duration or an `until` is exact")
        if end.is_never:
            reason = "it never ends by itself, so what follows would never start: every run fails"
            raise Inexpressible(reason, member.span, instead)
        if ir.is_open(content):  # what overrides it ends it
            return
        reason = "a run fails that draws a member without end, for what follows never starts"
        bound = "the same if another member is drawn"
        self._ctx.report.approximate(construct_of(member), member.span, reason, bound, instead)

    def _parallel(self, node: ir.Parallel, start: Flow) -> Flow:
        if len(node.members) > 1:
            start = self._builder.latched(start, self._builder.name_of(node))
        report_conflicts(self._ctx, node)
        ends: list[tuple[ir.Behavior, Flow]] = []
        mark_actor = self._builder.mark_actor
        for member, offset in zip(node.members, starts_of(self._ctx, node), strict=True):
            at = ends[0][1] if offset is None else start.later(offset)
            self._builder.mark_actor = next(iter(self._builder.acting(member)), mark_actor)
            end = self._member(member, at)
            if not end.is_never and len(node.members) > 1:  # a single one ends with the whole
                end = end_open_actions(self._builder, end, member, frozenset())
            ends.append((member, end))
        self._builder.mark_actor = mark_actor
        return self._joined(ends)

    def _joined(self, ends: Sequence[tuple[ir.Behavior, Flow]]) -> Flow:
        """Return when all bounded members have ended; members without duration bound nothing."""
        timed = [(member, end) for member, end in ends if not ir.is_instant(member)]
        for member, _ in timed if len(timed) > 1 else ():
            if follows_route(member):
                raise Inexpressible("a route of the map that others may end", member.span)
        bounding = [(m, end) for m, end in timed if not end.is_never] if timed else list(ends)
        bounded = [end for _, end in bounding]
        reached = [
            (member, end.open_since)
            for member, end in timed
            if end.open_since is not None
            and not any(each.is_surely_after(end.open_since) for each in bounded)
        ]
        if not bounding:
            return Flow((), self._all_of(reached) if reached else None)
        return self._all_of([*bounding, *reached])

    def _all_of(self, ends: Sequence[tuple[ir.Behavior, Flow]]) -> Flow:
        """Return when the flows of several members are true, each from then on."""
        if len(ends) == 1:
            return ends[0][1]
        named = [(self._builder.name_of(member), end) for member, end in ends]
        are_few_ends = are_few([end for _, end in named])
        return all_of(
            [
                (
                    self._builder.latched(end, name)
                    if are_few_ends or len(end.groups) == 1
                    else self._builder.keep(self._ctx.names.new(f"end_of_{name}"), end)
                )
                for name, end in named
            ]
        )

    def _one_of(self, node: ir.OneOf, start: Flow) -> Flow:
        policy = self._ctx.module.one_of
        if policy == "first":
            first = fitting(self._ctx, node).members[0]
            if len(node.members) > 1:
                note = f"`--one-of first` takes `{self._builder.name_of(first)}`"
                self._ctx.report.exact("one_of", node.span, note)
            return self._member(first, start)
        if ir.is_drawn(node, policy):
            return self._choice(node, start)
        if ir.is_partly_drawn(node, policy):
            reason = "of its members that control the same of one actor a run draws one"
            drawing = Remedy(
                instead="alternatives that all control the same of one actor are exact"
            )
            raise Inexpressible(reason, node.span, drawing)
        node = fitting(self._ctx, node)
        if len(node.members) > 1:
            start = self._builder.latched(start, self._builder.name_of(node))
        is_race = len(node.members) > 1
        single = [
            ir.is_single(member) and not (is_race and ir.is_timed(member))
            for member in node.members
        ]
        races = not all(single)
        acts: list[Act] = []
        ends: dict[str, Flow] = {}
        for member, is_leaf in zip(self._courses(node), single, strict=True):
            if is_race:
                self._racers.add(member.span)
            if not is_leaf:
                if is_race:
                    self._entrants.add(member.span)
                act, mark = self._region(
                    member, start, partial(self._racer, member, is_race, False)
                )
                acts.append(act)
                if mark is not None:
                    ends[mark] = self._builder.is_set(mark)
            elif not (end := self._racer(member, is_race, True, start)).is_never:
                mark = self._ctx.names.new(f"end_of_{self._builder.name_of(member)}")
                ends[mark] = self._builder.keep(mark, end) if races else end
        for act in acts:  # the first one stops the others
            act.stops.extend(mark for mark in ends if mark not in act.stops)
        return any_of(ends.values())

    def _choice(self, node: ir.OneOf, start: Flow) -> Flow:
        """Flatten members of which a parameter of the document chooses one for each run."""
        branch = self._ctx.choosing.drawn(self._ctx.scope, node)
        if branch is None:
            return self._member(node.members[0], start)
        self._ctx.require_support("ParameterCondition/text", node.span)
        start = self._builder.latched(start, self._builder.name_of(node))
        begins, ends = list[Flow](), list[Flow]()
        for member, choice in zip(self._courses(node), branch.choices, strict=True):
            begins.append(start & chosen(branch.name, str(choice)))
            ends.append(self._member(member, begins[-1]))
        self._ctx.report.exact("one_of", node.span, f"the parameter {branch.name} chooses")
        if any(end.open_since is not None for end in ends) and all(end.is_never for end in ends):
            since = (end.open_since or at for at, end in zip(begins, ends, strict=True))
            return Flow((), any_of(since))
        return any_of(ends)

    def _courses(self, node: ir.OneOf) -> Iterator[ir.Behavior]:
        """Yield the members, one of which a run takes: what is known after them is of any."""
        before, after, mark_actor = dict(self._ctx.states), None, self._builder.mark_actor
        for member in node.members:
            self._ctx.states = dict(before)
            self._builder.mark_actor = next(iter(self._builder.acting(member)), mark_actor)
            yield member
            states = self._ctx.states
            after = dict(states) if after is None else either(after, states)
        self._ctx.states = after or before
        self._builder.mark_actor = mark_actor

    def _racer(self, member: ir.Behavior, is_race: bool, is_cut: bool, start: Flow) -> Flow:
        """Flatten a member of a race; if it is no act of its own, its action may be cut short."""
        builder = self._builder
        outer = builder.is_race, self._is_racing
        builder.is_race = builder.is_race or (is_race and is_cut)
        self._is_racing = self._is_racing or is_race
        end = self._member(member, start)
        builder.is_race, self._is_racing = outer
        return end

    def _role(self, node: ir.Behavior) -> Role:
        if node.span in self._racers:
            return "racer"
        return "in a race" if self._is_racing else "alone"

    def _scenario(self, node: ir.InvokeScenario, start: Flow) -> Flow:
        """Write down an invoked scenario in place."""
        inner = self._ctx.scope.of(node)
        with self._ctx.within(inner):
            return self._member(inner.scenario.body, start)

    # --- what can be cut short --------------------------------------------------------------------

    def _bounded(
        self, node: ir.Composition | ir.InvokeScenario, start: Flow, body: Callable[[Flow], Flow]
    ) -> Flow:
        """Flatten a composition with its `until`, its duration and what overrides it."""
        builder = self._builder
        if not node.until and node.duration is None and not builder.overriding(node):
            return builder.mark_end(node, body(start))
        start = builder.latched(start, builder.name_of(node))
        if node.span in self._entrants:  # the act is its own already
            return builder.mark_end(
                node, end_within_duration(builder, node, start, body(start), "racer")
            )
        role = self._role(node)
        needs_no_stop = not self._ctx.profile.has_act_stop and ir.starts_at_once(node)
        if ir.is_single(node) or needs_no_stop:
            outer, builder.is_race = builder.is_race, True
            end = end_within_duration(builder, node, start, body(start), role)
            builder.is_race = outer
            return builder.mark_end(node, end)
        _, mark = self._region(
            node, start, lambda at: end_within_duration(builder, node, at, body(at), role)
        )
        return builder.mark_end(node, NEVER if mark is None else builder.is_set(mark))

    def _region(
        self, node: ir.Behavior, start: Flow, body: Callable[[Flow], Flow]
    ) -> tuple[Act, str | None]:
        """Flatten what can be cut short into an act of its own; return it and the mark of its end.

        The mark is needed, for an act is also complete when its events are, though what they stand
        for goes on.
        """
        ctx, builder = self._ctx, self._builder
        if not ctx.profile.has_act_stop and not ir.is_last(ctx.scenario.body, node):
            reason = f"{ctx.profile.name} looks at events of an act again that has been stopped"
            raise Inexpressible(reason, node.span, WITHOUT_STOPS)
        name = f"act_{builder.name_of(node)}"
        act = builder.open_act(name, start)
        end = body(builder.running(act))
        mark = None
        if not end.is_never:
            mark = ctx.names.new(f"end_{act.name}")
            builder.keep(mark, end)
            act.stops.append(mark)
        builder.close_act()
        return act, mark
