"""The printable form of the IR, for people and golden files."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from osc2tx.ir import behaviors as tree
from osc2tx.ir.coverage import Coverage
from osc2tx.ir.declarations import (
    Actor,
    Declaration,
    Event,
    FieldValue,
    Method,
    Parameter,
    Struct,
    Variable,
)
from osc2tx.ir.expression_text import show, show_arguments
from osc2tx.ir.expressions import Expression
from osc2tx.ir.nodes import AbstractScenario, Module, Placement, Scenario
from osc2tx.ir.user_types import UserAction, UserEnum, UserModifier, UserType

INDENT = "  "


def dump_ir(module: Module) -> str:
    """Return the module as indented text, one node a line, each with its source line."""
    lines = [
        f"module {module.source} (standard {module.standard}, dialect {module.dialect}, "
        f"one_of {module.one_of})"
    ]
    for own in module.types:
        lines.extend(_indented(_own_type(own)))
    lines.extend(_indented(map(_enum, module.enums)))
    lines.extend(_indented(map(_user_action, module.actions)))
    for modifier in module.modifiers:
        lines.extend(_indented(_user_modifier(modifier)))
    names = {each.key: each.name for each in (*module.bases, *module.scenarios)}
    for scenario in (*module.bases, *module.scenarios):
        lines.extend(_indented(_scenario(scenario, names.get(scenario.base or ""))))
    return "\n".join(lines) + "\n"


def _indented(lines: Iterator[str]) -> Iterator[str]:
    return (INDENT + line for line in lines)


def _own_type(own: UserType) -> Iterator[str]:
    base = f" inherits {', '.join(own.bases)}" if own.bases else ""
    yield f"{'actor' if own.is_actor else 'struct'} {own.name}{base} @{own.span.line}"
    for field in own.all_fields:
        default = "" if field.default is None else f" = {show(field.default)}"
        optional = " optional" if field.is_optional else ""
        yield f"{INDENT}{field.name}: {field.type}{default}{optional} @{field.span.line}"
    yield from _indented(map(_method, own.methods))


def _enum(own: UserEnum) -> str:
    return f"enum {own.name}: {', '.join(own.members)} @{own.span.line}"


def _method(method: Method) -> str:
    parameters = ", ".join(f"{p.name}: {p.type}" for p in method.parameters)
    result = "" if method.result is None else f" -> {method.result}"
    body = "" if method.expression is None else show(method.expression)
    if method.external is not None:
        body = f"external {method.external.module}.{method.external.function}"
    return f"method {method.name}({parameters}){result} = {body} @{method.span.line}"


def _user_action(action: UserAction) -> str:
    parameters = ", ".join(f"{p.name}: {p.type}" for p in action.parameters)
    base = "" if action.base is None else f" inherits {action.base}"
    return f"declared action {action.qualified_name}({parameters}){base} @{action.span.line}"


def _user_modifier(modifier: UserModifier) -> Iterator[str]:
    parameters = ", ".join(
        f"{p.name}: {p.type}" + ("" if p.default is None else f" = {show(p.default)}")
        for p in modifier.parameters
    )
    yield f"modifier {modifier.name}({parameters}) @{modifier.span.line}"
    yield from _indented(map(_modifier, modifier.calls))


def _scenario(scenario: AbstractScenario, base: str | None) -> Iterator[str]:
    origin = f" of {scenario.span.source.name}" if scenario.is_imported else ""
    word = "action" if scenario.is_action else "scenario"
    above = "" if base is None else f" inherits {base}"
    yield f"{word} {scenario.name}{above}{origin} @{scenario.span.line}"
    for declaration in scenario.declarations:
        yield from _indented(_declaration(declaration))
    yield from _indented(map(_method, scenario.methods))
    for constraint in scenario.constraints:
        yield f"{INDENT}keep {show(constraint.expression)} @{constraint.span.line}"
    for item in scenario.coverage:
        yield f"{INDENT}{_coverage(item)}"
    for placement in scenario.placements:
        yield from _indented(_placement(placement))
    for override in scenario.overrides:
        yield f"{INDENT}override {override.overridden} by {override.by} {override.mode}"
    if isinstance(scenario, Scenario):
        yield from _indented(_behavior(scenario.body))


def _coverage(item: Coverage) -> str:
    what = ", ".join(item.items) if item.expression is None else show(item.expression)
    event = item.event.value if isinstance(item.event, tree.Moment) else item.event.name
    options = {
        "unit": item.unit and item.unit.name,
        "range": item.within,
        "every": item.every,
        "buckets": item.buckets,
        "ignore": item.ignore and show(item.ignore),
        "illegal": item.illegal and show(item.illegal),
        "target": item.target,
        "text": item.text,
    }
    given = "".join(f" {name}={value}" for name, value in options.items() if value)
    return f"{item.kind} {item.name} = {what} at {event}{given} @{item.span.line}"


def _declaration(declaration: Declaration) -> Iterator[str]:
    line = declaration.span.line
    match declaration:
        case Actor(name=name, type=type_):
            yield f"{_scope(declaration)}actor {name}: {type_} @{line}"
            yield from _indented(_field_values(declaration.values))
        case Struct(name=name, type=type_, value=value):
            whole = "" if value is None else f" = {show(value)}"
            yield f"{_scope(declaration)}struct {name}: {type_}{whole} @{line}"
            yield from _indented(_field_values(declaration.values))
        case Parameter(name=name, type=type_, value=value, domain=domain):
            word = "constant" if declaration.is_fixed else "parameter"
            default = f" = {show(value)}" if value is not None else ""
            within = f" in {show(domain)}" if domain is not None else ""
            yield f"{_scope(declaration)}{word} {name}: {type_}{default}{within} @{line}"
        case Variable(name=name, type=type_, value=value, sample=sample):
            initial = "" if value is None else f" = {show(value)}"
            sampled = ""
            if sample is not None:
                when = sample.trigger
                at = f"@{when.value}" if isinstance(when, tree.Moment) else _trigger(when)
                sampled = f" sampled {show(sample.expression)} at {at}"
            yield f"variable {name}: {type_}{initial}{sampled} @{line}"
        case Event(name=name, trigger=trigger):
            given = f" is {_trigger(trigger)}" if trigger is not None else ""
            implicit = " (implicit)" if declaration.is_implicit else ""
            taken = ", ".join(f"{p.name}: {p.type}" for p in declaration.parameters)
            yield f"event {name}{f'({taken})' if taken else ''}{given}{implicit} @{line}"
        case _:
            assert_never(declaration)


def _scope(declaration: Actor | Struct | Parameter) -> str:
    return "global " if declaration.is_global else ""


def _field_values(values: tuple[FieldValue, ...]) -> Iterator[str]:
    for value in values:
        yield f"{'.'.join(value.path)} = {show(value.value)} @{value.span.line}"


def _placement(placement: Placement) -> Iterator[str]:
    implied = " implied" if placement.is_implied else ""
    yield f"place {placement.actor}{implied} @{placement.span.line}"
    yield from _indented(_modifier(modifier) for modifier in placement.modifiers)


def _modifier(modifier: tree.ModifierCall) -> str:
    at = "" if modifier.at == "all" else f" at {modifier.at}"
    of = "".join(f" of @{application.span.line}" for application in reversed(modifier.applied))
    return f"{modifier.name}({show_arguments(modifier.arguments)}){at} @{modifier.span.line}{of}"


def _behavior(node: tree.Behavior) -> Iterator[str]:
    label = f" [{node.label}]" if node.label else ""
    place = f"{label} @{node.span.line}"
    match node:
        case tree.Serial() | tree.Parallel() | tree.OneOf():
            yield f"{type(node).__name__} {node.name!r}{place}"
            yield from _indented(_composition_details(node))
            for member in node.members:
                yield from _indented(_behavior(member))
        case tree.Invoke(action=action, arguments=arguments):
            who = f"{show(node.actor)}." if node.actor is not None else ""
            own = "own " if node.is_own else ""
            called = f"{who}{action}({show_arguments(arguments)})"
            yield f"Invoke {own}{node.qualified_name}: {called}{place}"
            yield from _indented(_modifier(modifier) for modifier in node.modifiers)
            yield from _indented(_limits(node.duration, node.until))
        case tree.InvokeScenario(scenario=scenario, actor=actor, arguments=arguments):
            who = f"{show(actor)}." if actor is not None else ""
            yield f"InvokeScenario {who}{scenario}({show_arguments(arguments)}){place}"
            for special in node.specials:
                chosen = f"{special.scenario} if {show_arguments(special.values)}"
                yield from _indented(iter((chosen,)))
            if node.times:
                yield from _indented(iter((f"times {show_arguments(node.times)}",)))
            yield from _indented(_limits(node.duration, node.until))
        case tree.Wait(trigger=trigger):
            yield f"Wait {_trigger(trigger)}{place}"
        case tree.Emit(event=event, arguments=arguments):
            yield f"Emit {event.name}({show_arguments(arguments)}){place}"
        case tree.Finish(succeeds=succeeds):
            yield f"Finish {'end' if succeeds else 'fail'}{place}"
        case tree.Call(call=call):
            yield f"Call {show(call)}{place}"
        case tree.On(trigger=trigger, reactions=reactions):
            yield f"On {_trigger(trigger)}{place}"
            for reaction in reactions:
                yield from _indented(_behavior(reaction))
        case _:
            assert_never(node)


def _composition_details(node: tree.Serial | tree.Parallel | tree.OneOf) -> Iterator[str]:
    if isinstance(node, tree.Parallel) and node.overlap is not None:
        yield f"overlap {node.overlap}"
    yield from _limits(node.duration, node.until)


def _limits(duration: Expression | None, until: tuple[tree.Trigger, ...]) -> Iterator[str]:
    if duration is not None:
        yield f"duration {show(duration)}"
    for trigger in until:
        yield f"until {_trigger(trigger)}"


def _trigger(trigger: tree.Trigger) -> str:
    parts = []
    match trigger.event:
        case tree.EventRef(name=name):
            parts.append(f"@{name}")
        case tree.LabelEvent(label=label, moment=moment):
            parts.append(f"@{label}.{moment.value}")
        case tree.InnerEvent(label=label, name=name):
            parts.append(f"@{label}.{name}")
        case None:
            pass
    if trigger.condition is not None:
        parts.append(_condition(trigger.condition))
    return " if ".join(parts)


def _condition(condition: tree.Condition) -> str:
    match condition:
        case tree.Level(expression=expression):
            return show(expression)
        case tree.Edge(rising=rising, expression=expression):
            return f"{'rise' if rising else 'fall'}({show(expression)})"
        case tree.Elapsed(duration=duration):
            return f"elapsed({show(duration)})"
        case tree.Every(period=period, offset=offset):
            shift = f", offset: {show(offset)}" if offset is not None else ""
            return f"every({show(period)}{shift})"
