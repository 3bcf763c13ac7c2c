"""Cycles of traffic lights (§8.15.9.7) as traffic signal controllers.

Where a scenario plays them from its start to its end they are controllers of the XML. Where it says
for how long, and for tools without controllers, they are written out as the switches they make.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import cycle as endless
from typing import NamedTuple

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Global, Globals, Later
from osc2tx.backends.xosc.actions.registry import global_action
from osc2tx.backends.xosc.actions.signals.traffic_lights import (
    States,
    infrastructure,
    lights_of_group,
    roads_of,
    state_text,
    states_of,
    switch,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.values.constants import Constant, Named
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import TrafficSignalSemantics

CONTROLLER = "TrafficSignalControllerAction"

MOST_SWITCHES = 1000
"""Switches that are written out one by one."""


# `semantic_traffic_light_state` (§8.15.3.1) -> literal.
_MEANINGS: Mapping[str, TrafficSignalSemantics] = {
    "attention": "attention_go",
    "caution": "caution",
    "go": "go",
    "go_exclusive": "go",
    "non_functional": "fallback",
    "off": "fallback",
    "stop": "stop",
    "stop_attention": "attention_stop",
}


class _Phase(NamedTuple):
    """What lights show for a while.

    Attributes:
        name: Its name.
        duration: Seconds.
        shown: States of the lamps by light.
    """

    name: str
    duration: float
    shown: tuple[tuple[str, States], ...]


class _Cycle(NamedTuple):
    """Phases that follow each other again and again, the first one `offset` seconds late."""

    name: str
    phases: tuple[_Phase, ...]
    offset: float


@global_action("play_cycles")
def _play_cycles(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    given = arguments.get("cycles")
    if not isinstance(given, tuple):
        raise Inexpressible("the cycles are not known before the run")
    cycles = [_cycle(ctx, each) for each in given]
    body = ctx.scenario.body
    has_end = node.duration is not None or bool(node.until)
    spans_run = ir.is_first(body, node) and (not has_end or ir.is_last(body, node))
    is_supported = ctx.can(CONTROLLER, "1.0")
    lasting = None if node.duration is None else ctx.values.number(node.duration)
    is_alone = not any(
        each.owner == "traffic_light_controller"
        for each in ir.invocations(body)
        if each is not node
    )
    if not (spans_run and is_supported) and lasting is not None and not node.until and is_alone:
        return tuple(each for cycle in cycles for each in _written_out(ctx, cycle, lasting))
    ctx.require_support(CONTROLLER)
    if not spans_run:
        arguments.approximate(
            "controllers of the XML play their cycles from the start of the run to its end",
            "phases and their lengths are exact; the lights also change before and after",
        )
    return tuple(_controller(ctx, cycle) for cycle in cycles)


# --- what a scenario says -----------------------------------------------------------------------


def _cycle(ctx: Context, cycle: Constant) -> _Cycle:
    if not isinstance(cycle, Named):
        raise Inexpressible("a cycle is not known before the run")
    phases = ctx.values.field(cycle.name, "phases")
    named = [each for each in phases if isinstance(each, Named)] if type(phases) is tuple else []
    if not named:
        raise Inexpressible(f"cycle `{cycle.name}` has no phases")
    late = ctx.values.number_in(cycle.name, "start_offset") or 0.0
    return _Cycle(cycle.name, tuple(_phase(ctx, phase.name) for phase in named), late)


def _phase(ctx: Context, name: str) -> _Phase:
    duration = ctx.values.number_in(name, "duration")
    if duration is None or duration <= 0.0:
        raise Inexpressible(f"phase `{name}` has no duration")
    shown = ctx.values.field(name, "bulbs_state")
    signals = lights_of_group(ctx, ctx.values.field(name, "group"))
    states = tuple((signal, states_of(ctx, shown, signal)) for signal in signals)
    return _Phase(name, duration, states)


# --- elements -----------------------------------------------------------------------------------


def _controller(ctx: Context, cycle: _Cycle) -> xml.GlobalAction:
    """Add a controller to the road network; return the action that starts it."""
    name = ctx.names.new(cycle.name)
    phases = []
    for phase in cycle.phases:
        states = []
        for signal, shown in phase.shown:
            text = state_text(ctx, signal, shown)
            states.append(xml.TrafficSignalState(trafficSignalId=signal, state=text))
            ctx.lamps[signal] = None
        meanings = {_MEANINGS[roads_of(ctx).meaning_of(*shown)] for shown in phase.shown}
        meaning = meanings.pop() if len(meanings) == 1 else None  # of all lights
        phases.append(
            xml.Phase(
                *states,
                name=phase.name,
                duration=phase.duration,
                semantics=meaning if ctx.version >= "1.4" else None,
            )
        )
    delay = cycle.offset or None
    ctx.controllers.append(xml.TrafficSignalController(*phases, name=name, delay=delay))
    first = cycle.phases[0].name
    return infrastructure(
        xml.TrafficSignalControllerAction(trafficSignalControllerRef=name, phase=first)
    )


def _written_out(ctx: Context, cycle: _Cycle, lasting: float) -> list[Global | Later]:
    """Return the switches that a cycle makes in a time (s)."""
    period = sum(phase.duration for phase in cycle.phases)
    end = cycle.offset % period - period  # of the phases before the start
    found: list[Global | Later] = []
    for phase in endless(cycle.phases):
        begin, end = end, end + phase.duration
        if begin >= lasting:
            return found
        if end <= 0.0:
            continue
        for signal, states in phase.shown:
            action = switch(ctx, signal, states)
            found.append(action if begin <= 0.0 else Later(round(begin, 9), action))
        if len(found) > MOST_SWITCHES:
            raise Inexpressible(f"the cycle makes more than {MOST_SWITCHES} switches")
    raise AssertionError("a cycle has no end")
