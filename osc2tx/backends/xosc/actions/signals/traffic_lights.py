"""Traffic lights (§8.15): actions that switch them, and conditions on their states.

The text of a state is up to the tool. Written here: one word for each lamp, in the order of the
lamps, as in `off;off;on`; ScenarioRunner knows one colour for the whole light.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Globals
from osc2tx.backends.xosc.actions.registry import global_action
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.maps import Roads
from osc2tx.backends.xosc.values.constants import Constant, Member, MethodResult, Named
from osc2tx.losses.entries import GENERIC, Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import replace

WORDS: Mapping[str, str] = {"is_off": "off", "is_on": "on", "is_flashing": "flashing"}
"""State of a lamp -> its word."""

OFF = "is_off"

States: TypeAlias = tuple[str, ...]


# --- actions ------------------------------------------------------------------------------------


@global_action("set_semantic_state", "set_group_semantic_state")
def _set_meaning(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    meaning = arguments.member("state", "off")
    actions = []
    for signal in _addressed(ctx, node, arguments):
        states = roads_of(ctx).meaning(signal, meaning)
        if states is not None:  # a light that cannot say it goes on as it is
            actions.append(switch(ctx, signal, states))
    return tuple(actions)


@global_action("set_state", "set_group_state")
def _set_state(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    given = arguments.get("state")
    signals = _addressed(ctx, node, arguments)
    return tuple(switch(ctx, signal, states_of(ctx, given, signal)) for signal in signals)


@global_action("set_bulb_state", "set_group_bulb_state")
def _set_lamp(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    color = arguments.member("bulb_color", "unknown")
    icon = arguments.member("bulb_kind", "unknown")
    wanted = arguments.member("bulb_state", OFF)
    actions = []
    for signal in _addressed(ctx, node, arguments):
        lamps = _lamps(ctx, signal)
        if (color, icon) not in lamps:
            raise Inexpressible(f"traffic light {signal} has no {color} lamp with `{icon}`")
        shown = ctx.lamps.get(signal, (OFF,) * len(lamps))
        if shown is None:
            raise Inexpressible("what the other lamps show is only known during the run")
        states = tuple(
            wanted if lamp == (color, icon) else state
            for lamp, state in zip(lamps, shown, strict=True)
        )
        actions.append(switch(ctx, signal, states))
    return tuple(actions)


def switch(ctx: Context, signal: str, states: States) -> xml.GlobalAction:
    """Return the action that lets a light show something, and note that it does."""
    ctx.lamps[signal] = states
    return infrastructure(
        xml.TrafficSignalStateAction(name=_name(ctx, signal), state=state_text(ctx, signal, states))
    )


def infrastructure(action: xml.TrafficSignalActionPart) -> xml.GlobalAction:
    """Return the global action around one on traffic lights."""
    return xml.GlobalAction(xml.InfrastructureAction(xml.TrafficSignalAction(action)))


# --- conditions ---------------------------------------------------------------------------------


def lamps_condition(expression: ir.Expression) -> ir.MethodCall | None:
    """Return the condition on lamps that an expression is, `None` if it is another one.

    What a light means, compared with a constant, is a condition on its lamps.
    """
    match expression:
        case ir.MethodCall(method="state_equal"):
            return expression
        case ir.Binary(
            operator="==",
            left=ir.MethodCall(
                method="state_to_semantic_state",
                base=light,
                arguments=(ir.Argument(value=ir.Attribute(base=shown, name="bulbs")) as given,),
            ) as call,
            right=meaning,
        ) if shown.span.text == light.span.text and not ir.is_live(meaning):
            state = replace(given, parameter="state", value=meaning)
            lamps = replace(call, method="semantic_state_to_state", arguments=(state,))
            bulbs = replace(given, parameter="bulbs", value=lamps)
            return replace(call, method="state_equal", arguments=(bulbs,))
    return None


def shows(ctx: Context, call: ir.MethodCall) -> tuple[xml.ConditionPart, ...]:
    """Return the conditions that all hold if a light, or all lights of a group, show something."""
    owner = ctx.values.of(call.base)
    given = next((ctx.values.of(a.value) for a in call.arguments if a.parameter == "bulbs"), None)
    is_group = call.owner == "traffic_light_group"
    signals = lights_of_group(ctx, owner) if is_group else (_map_id(ctx, owner),)
    texts = [(signal, state_text(ctx, signal, states_of(ctx, given, signal))) for signal in signals]
    return tuple(
        xml.ByValueCondition(xml.TrafficSignalCondition(name=_name(ctx, signal), state=text))
        for signal, text in texts
    )


# --- lights, groups and what they show ----------------------------------------------------------


def _addressed(ctx: Context, node: ir.Invoke, arguments: Arguments) -> tuple[str, ...]:
    """Return the lights that an action mentions."""
    if arguments.get("sync"):
        raise Inexpressible("a switch in step with a cycle")
    light = arguments.get("traffic_light")
    group = arguments.get("traffic_light_group") or arguments.get("group")
    if light is not None:
        signal = _map_id(ctx, light)
        if "_group_" not in node.action:
            return (signal,)
        group = ctx.values.field(light.name, "group") if isinstance(light, Named) else None
        if group is None:
            return roads_of(ctx).group_of(signal)
    return lights_of_group(ctx, group)


def lights_of_group(ctx: Context, group: Constant | None) -> tuple[str, ...]:
    """Return the ids of the lights of a group."""
    listed = ctx.values.field(group.name, "traffic_lights") if isinstance(group, Named) else None
    if isinstance(listed, tuple):
        return tuple(_map_id(ctx, light) for light in listed)
    return roads_of(ctx).group(_map_id(ctx, group))


def _map_id(ctx: Context, value: Constant | None) -> str:
    id_ = ctx.values.field(value.name, "map_id") if isinstance(value, Named) else None
    if not isinstance(id_, str):
        raise Inexpressible("a traffic light without `map_id` is in no map")
    return id_


def roads_of(ctx: Context) -> Roads:
    """Return the map, which has the lights."""
    return ctx.required_roads("traffic lights need")


def _lamps(ctx: Context, signal: str) -> tuple[tuple[str, str], ...]:
    """Return colour and symbol of the lamps of a light."""
    for declaration in ctx.scenario.declarations:
        if isinstance(declaration, ir.Struct) and declaration.type == "traffic_light":
            light = Named(declaration.name)
            listed = ctx.values.field(light.name, "bulbs")
            if isinstance(listed, tuple) and ctx.values.field(light.name, "map_id") == signal:
                return tuple(_lamp(ctx, bulb) for bulb in listed)
    return tuple((lamp.color, lamp.icon) for lamp in roads_of(ctx).lamps(signal))


def _lamp(ctx: Context, bulb: Constant) -> tuple[str, str]:
    name = bulb.name if isinstance(bulb, Named) else ""
    color, icon = (ctx.values.member_in(name, part) for part in ("color", "icon"))
    if color is None or icon is None:
        raise Inexpressible("a lamp needs `color` and `icon`")
    return color, icon


def states_of(ctx: Context, given: Constant | None, signal: str) -> States:
    """Return the states of the lamps of a light, from a list or from a meaning."""
    if isinstance(given, MethodResult) and given.method == "semantic_state_to_state":
        meaning = given.get("state")
        name = meaning.name if isinstance(meaning, Member) else ""
        states = roads_of(ctx).meaning(signal, name)
        if states is None:
            raise Inexpressible(f"traffic light {signal} has no lamps that mean {name}")
        return states
    if not isinstance(given, tuple):
        raise Inexpressible("the states of the lamps are not known before the run")
    lamps = _lamps(ctx, signal)
    if len(given) != len(lamps):
        raise Inexpressible(f"traffic light {signal} has {len(lamps)} lamps, not {len(given)}")
    return tuple(_state(ctx, each) for each in given)


def _state(ctx: Context, given: Constant) -> str:
    state = ctx.values.field(given.name, "state") if isinstance(given, Named) else given
    if not isinstance(state, Member):
        raise Inexpressible("the state of a lamp is not known before the run")
    return state.name


def _name(ctx: Context, signal: str) -> str:
    """Return what the tool calls a light."""
    if not ctx.profile.signals_by_place:
        return signal
    x, y = roads_of(ctx).signal_position(signal)
    return f"pos={x:.2f},{-y:.2f}"


def state_text(ctx: Context, signal: str, states: States) -> str:
    """Return what the tool calls the state."""
    is_plain = ctx.profile.name != "scenario_runner"
    for state in states:
        if state not in WORDS or (WORDS[state] == "flashing" and not is_plain):
            raise Inexpressible(f"there is no word for a lamp whose state is `{state}`")
    if is_plain:
        return ";".join(WORDS[state] for state in states)
    lit = [lamp[0] for lamp, s in zip(_lamps(ctx, signal), states, strict=True) if s != OFF]
    if len(lit) > 1:
        reason = f"scenario_runner knows one colour for a light, not {' and '.join(lit)}"
        raise Inexpressible(reason, None, GENERIC)
    return lit[0] if lit else "off"
