"""What a tool does otherwise than the standard, applied to a storyboard that is made already.

Some tools count delays from when they begin to look, and take a condition that was true once for
true from then on. For those a delay, and a condition that has to wait for its turn, go to an act
of their own: it starts when it is time to look, and sets a mark that others wait for.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeVar

from osc2tx.backends.xosc.conditions.flow import (
    Flow,
    Group,
    Test,
    at_time,
    run_start,
    single,
    state_of,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.storyboard import Act, Event
from osc2tx.losses.entries import GENERIC
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx_shared.classes import replace


def adapted(ctx: Context, acts: Sequence[Act], end: Flow) -> tuple[tuple[Act, ...], Flow]:
    """Return acts, the outermost one last, and the end as the tool understands them.

    What it cannot do is reported.
    """
    if ctx.profile.stop_name:
        name, span = ctx.names.new("end_of_the_run"), ctx.scenario.span
        acts[-1].add(None, Event(name, (ctx.mark(name),), end, span))
        end = single(state_of("event", name))
    if ctx.profile.unsupported or ctx.profile.deviates:
        _check_all(ctx, acts)
    if not ctx.profile.has_delays:
        acts = _Watch(ctx).through(acts)
    if ctx.profile.begins_with_texts:
        acts = (*_beginning(ctx, acts), *acts)
    return tuple(acts), end


def _check_all(ctx: Context, acts: Sequence[Act]) -> None:
    kinds = {member.name: member.kind for member in ctx.entities}
    for act in acts:
        for actor, events in act.events.items():
            for event in events:
                for part in (*event.actions, *_conditions(event)):
                    for node in part.walk():
                        _check(ctx, event, node, kinds.get(actor or "", ""))


def _beginning(ctx: Context, acts: Sequence[Act]) -> Iterator[Act]:
    """Yield the act that gives their first value to variables that something compares with it."""
    first = {name: value for name, (_, value) in ctx.variables.items()}
    conditions = (
        (node.parameterRef, node.value)
        for act in acts
        for event in act.all_events()
        for part in _conditions(event)
        for node in part.below(xml.ParameterCondition)
    )
    compared = {name for name, value in conditions if first.get(name) == value}
    if compared:
        name, span = ctx.names.new("begin"), ctx.scenario.span
        act = Act(ctx.names.new(f"act_{name}"), single(run_start()))
        actions = tuple(ctx.set_variable(each, first[each]) for each in sorted(compared))
        act.add(None, Event(name, actions, single(run_start()), span))
        yield act


def _conditions(event: Event) -> Iterator[Element]:
    for group in event.start.groups:
        yield from (test.condition for test in group)


def _features(node: Element, kind: str) -> Iterator[str]:
    """Yield what an element asks of a tool for an entity of a kind, as in `ToolProfile`."""
    yield f"{node.tag}/{kind}"
    for name in ("dynamicsDimension", "relativeDistanceType", "rule"):
        yield f"{node.tag}/{node.get(name)}"
    yield f"state/{node.get('state')}"
    for flag in ("alongRoute", "freespace"):
        if node.get(flag) == "true":
            yield f"{node.tag}/{flag}"
    if node.get("dynamicsShape") != "step":
        yield node.tag


def _check(ctx: Context, event: Event, node: Element, kind: str) -> None:
    """Report what a tool does not carry out for an entity, or carries out in another way."""
    profile, span = ctx.profile, event.place
    construct = ctx.report.construct_at(span, "action ")
    for feature in _features(node, kind):
        if feature in profile.unsupported:
            reason = f"{profile.name} does not carry out {feature}: {profile.unsupported[feature]}"
            ctx.report.cannot(construct, span, reason, GENERIC)
            return
        if feature in profile.deviates and not event.is_step:
            does, bound = profile.deviates[feature]
            ctx.report.approximate(construct, span, f"in {profile.name} {does}", bound, GENERIC)


# What does not hold while a comparison does; where the two sides are equal, both may.
_OPPOSITE_RULES = {"greaterThan": "lessThan", "lessThan": "greaterThan"}
_OPPOSITE_VALUES = {"0": "1", "1": "0", "false": "true", "true": "false"}


E = TypeVar("E", bound=Element)


def _opposite(test: Test) -> Test | None:
    """Return the test that holds while another one does not; `None` if none is sure to."""
    for node in test.condition.walk():
        if node.get("rule") == "equalTo" and node.get("value") not in _OPPOSITE_VALUES:
            return None
    return replace(test, edge="none", condition=_turned(test.condition))


def _turned(node: E) -> E:
    attributes = dict(node.attributes)
    rule = attributes.get("rule")
    if rule is None:
        return node.with_children(*map(_turned, node.children))
    if rule == "equalTo":
        attributes["value"] = _OPPOSITE_VALUES[attributes["value"]]
    else:
        attributes["rule"] = _OPPOSITE_RULES[rule]
    return node.with_attributes(attributes)


class _Watch:
    """Lets acts of their own watch what events cannot watch themselves."""

    def __init__(self, ctx: Context) -> None:
        self._ctx = ctx
        self._made: list[Act] = []
        self._marks: dict[Group, Test] = {}

    def through(self, acts: Sequence[Act]) -> tuple[Act, ...]:
        for act in acts:
            for event in act.all_events():
                groups = (self._group(group, event) for group in event.start.groups)
                event.start = Flow(tuple(groups))
        return (*self._made, *acts)

    def _group(self, group: Group, event: Event) -> Group:
        """Return a group in which all conditions stay true, and none is delayed or an edge."""
        group = tuple(test for each in group for test in self._without_edge(each, group, event))
        lasting = tuple(self._undelayed(test, event) for test in group if test.latched)
        passing = tuple(test for test in group if not test.latched)
        if not passing or (all(test.reached == 0.0 for test in lasting) and len(passing) == 1):
            return lasting + passing
        if len(passing) > 1:
            span = event.place
            reason = f"{self._ctx.profile.name} takes what was true once for true from then on"
            self._ctx.report.cannot("condition", span, reason, GENERIC)
            return group
        return (self._mark((*lasting, *passing), Flow((lasting,)), Flow((passing,)), event),)

    def _without_edge(self, test: Test, group: Group, event: Event) -> Group:
        """Return tests for a change: that it was not so once the rest held, and that it is so."""
        if test.edge == "none":
            return (test,)
        level, opposite = replace(test, edge="none"), _opposite(test)
        if opposite is None:
            reason = f"{self._ctx.profile.name} cannot tell when a value begins to be that one"
            self._ctx.report.cannot("condition", event.place, reason, GENERIC)
            return (level,)
        if test.edge == "falling":
            level, opposite = opposite, level
        since = tuple(self._undelayed(each, event) for each in group if each.latched)
        return (self._mark((*since, opposite), Flow((since,)), single(opposite), event), level)

    def _undelayed(self, test: Test, event: Event) -> Test:
        if test.delay == 0.0:
            return test
        begin = replace(test, delay=0.0)
        return self._mark((test,), single(begin), single(at_time(test.delay)), event)

    def _mark(self, what: Group, look: Flow, occurs: Flow, event: Event) -> Test:
        """Add an act that looks for something from a flow on; return the test for it."""
        known = self._marks.get(what)
        if known is not None:
            return known
        ctx = self._ctx
        name = ctx.names.new(f"until_{event.name}")
        act = Act(ctx.names.new(f"act_{name}"), look)
        act.add(None, Event(name, (ctx.mark(name),), occurs, event.place))
        self._made.append(act)
        made = Test(ctx.variable_is(name, "equalTo", "true"), latched=True)
        return self._marks.setdefault(what, made)
