"""The printable form of the IR, for people and golden files."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from osc2tx.ir.behaviors import (
    Behavior,
    Condition,
    Edge,
    Elapsed,
    Emit,
    EventRef,
    Every,
    InnerEvent,
    Invoke,
    InvokeScenario,
    LabelEvent,
    Level,
    ModifierCall,
    On,
    OneOf,
    Parallel,
    Serial,
    Trigger,
    Wait,
)
from osc2tx.ir.expressions import (
    Argument,
    Attribute,
    Binary,
    Conditional,
    EnumValue,
    EventArgument,
    Expression,
    FieldRef,
    ListValue,
    Literal,
    MethodCall,
    ParameterRef,
    Quantity,
    RangeValue,
    ScenarioSelf,
    Unary,
)
from osc2tx.ir.nodes import (
    Actor,
    Declaration,
    Event,
    FieldValue,
    Module,
    Parameter,
    Placement,
    Scenario,
    Struct,
    Variable,
)

INDENT = "  "


def dump_ir(module: Module) -> str:
    """Return the module as indented text, one node a line, each with its source line."""
    lines = [
        f"module {module.source} (standard {module.standard}, dialect {module.dialect}, "
        f"one_of {module.one_of})"
    ]
    for scenario in module.scenarios:
        lines.extend(_indented(_scenario(scenario)))
    return "\n".join(lines) + "\n"


def _indented(lines: Iterator[str]) -> Iterator[str]:
    return (INDENT + line for line in lines)


def _scenario(scenario: Scenario) -> Iterator[str]:
    origin = f" of {scenario.span.source.name}" if scenario.is_imported else ""
    yield f"scenario {scenario.name}{origin} @{scenario.span.line}"
    for declaration in scenario.declarations:
        yield from _indented(_declaration(declaration))
    for method in scenario.methods:
        parameters = ", ".join(f"{p.name}: {p.type}" for p in method.parameters)
        signature = f"{method.name}({parameters}) -> {method.result}"
        yield f"{INDENT}method {signature} = {show(method.expression)} @{method.span.line}"
    for placement in scenario.placements:
        yield from _indented(_placement(placement))
    for override in scenario.overrides:
        yield f"{INDENT}override {override.overridden} by {override.by} {override.mode}"
    yield from _indented(_behavior(scenario.body))


def _declaration(declaration: Declaration) -> Iterator[str]:
    line = declaration.span.line
    match declaration:
        case Actor(name=name, type=type_):
            yield f"actor {name}: {type_} @{line}"
            yield from _indented(_field_values(declaration.values))
        case Struct(name=name, type=type_):
            yield f"struct {name}: {type_} @{line}"
            yield from _indented(_field_values(declaration.values))
        case Parameter(name=name, type=type_, value=value, domain=domain):
            word = "constant" if declaration.is_fixed else "parameter"
            word = f"global {word}" if declaration.is_global else word
            default = f" = {show(value)}" if value is not None else ""
            within = f" in {show(domain)}" if domain is not None else ""
            yield f"{word} {name}: {type_}{default}{within} @{line}"
        case Variable(name=name, type=type_, value=value, sample=sample):
            initial = "" if value is None else f" = {show(value)}"
            sampled = ""
            if sample is not None:
                sampled = f" sampled {show(sample.expression)} at {_trigger(sample.trigger)}"
            yield f"variable {name}: {type_}{initial}{sampled} @{line}"
        case Event(name=name, trigger=trigger):
            given = f" is {_trigger(trigger)}" if trigger is not None else ""
            implicit = " (implicit)" if declaration.is_implicit else ""
            taken = ", ".join(f"{p.name}: {p.type}" for p in declaration.parameters)
            yield f"event {name}{f'({taken})' if taken else ''}{given}{implicit} @{line}"
        case _:
            assert_never(declaration)


def _field_values(values: tuple[FieldValue, ...]) -> Iterator[str]:
    for value in values:
        yield f"{'.'.join(value.path)} = {show(value.value)} @{value.span.line}"


def _placement(placement: Placement) -> Iterator[str]:
    yield f"place {placement.actor} @{placement.span.line}"
    yield from _indented(_modifier(modifier) for modifier in placement.modifiers)


def _modifier(modifier: ModifierCall) -> str:
    at = "" if modifier.at == "all" else f" at {modifier.at}"
    return f"{modifier.name}({_arguments(modifier.arguments)}){at} @{modifier.span.line}"


def _behavior(node: Behavior) -> Iterator[str]:
    label = f" [{node.label}]" if node.label else ""
    place = f"{label} @{node.span.line}"
    match node:
        case Serial() | Parallel() | OneOf():
            yield f"{type(node).__name__} {node.name!r}{place}"
            yield from _indented(_composition_details(node))
            for member in node.members:
                yield from _indented(_behavior(member))
        case Invoke(action=action, arguments=arguments):
            called = f"{show(node.actor)}.{action}({_arguments(arguments)})"
            yield f"Invoke {node.owner}.{action}: {called}{place}"
            yield from _indented(_modifier(modifier) for modifier in node.modifiers)
            yield from _indented(_limits(node.duration, node.until))
        case InvokeScenario(scenario=scenario, actor=actor, arguments=arguments):
            who = f"{show(actor)}." if actor is not None else ""
            yield f"InvokeScenario {who}{scenario}({_arguments(arguments)}){place}"
            yield from _indented(_limits(node.duration, node.until))
        case Wait(trigger=trigger):
            yield f"Wait {_trigger(trigger)}{place}"
        case Emit(event=event, arguments=arguments):
            yield f"Emit {event.name}({_arguments(arguments)}){place}"
        case On(trigger=trigger, reactions=reactions):
            yield f"On {_trigger(trigger)}{place}"
            for reaction in reactions:
                yield from _indented(_behavior(reaction))
        case _:
            assert_never(node)


def _composition_details(node: Serial | Parallel | OneOf) -> Iterator[str]:
    if isinstance(node, Parallel) and node.overlap is not None:
        yield f"overlap {node.overlap}"
    yield from _limits(node.duration, node.until)


def _limits(duration: Expression | None, until: tuple[Trigger, ...]) -> Iterator[str]:
    if duration is not None:
        yield f"duration {show(duration)}"
    for trigger in until:
        yield f"until {_trigger(trigger)}"


def _trigger(trigger: Trigger) -> str:
    parts = []
    match trigger.event:
        case EventRef(name=name):
            parts.append(f"@{name}")
        case LabelEvent(label=label, moment=moment):
            parts.append(f"@{label}.{moment.value}")
        case InnerEvent(label=label, name=name):
            parts.append(f"@{label}.{name}")
        case None:
            pass
    if trigger.condition is not None:
        parts.append(_condition(trigger.condition))
    return " if ".join(parts)


def _condition(condition: Condition) -> str:
    match condition:
        case Level(expression=expression):
            return show(expression)
        case Edge(rising=rising, expression=expression):
            return f"{'rise' if rising else 'fall'}({show(expression)})"
        case Elapsed(duration=duration):
            return f"elapsed({show(duration)})"
        case Every(period=period, offset=offset):
            shift = f", offset: {show(offset)}" if offset is not None else ""
            return f"every({show(period)}{shift})"


def _arguments(arguments: tuple[Argument, ...]) -> str:
    return ", ".join(f"{a.parameter}: {show(a.value)}" for a in arguments)


def show(expression: Expression) -> str:
    """Return an expression as DSL text, fully parenthesised."""
    match expression:
        case Literal(value=value):
            return str(value).lower() if isinstance(value, bool) else repr(value)
        case Quantity(value=value, unit=unit):
            return f"{value}{unit.name}"
        case EnumValue(member=member, type=type_):
            return f"{type_.name}!{member}"
        case FieldRef(name=name):
            return name
        case ParameterRef(name=name):
            return name
        case ScenarioSelf():
            return "it"
        case EventArgument(event=event, parameter=parameter):
            return f"@{event}.{parameter}"
        case Attribute(base=base, name=name):
            return f"{show(base)}.{name}"
        case MethodCall(base=base, method=method, arguments=arguments):
            return f"{show(base)}.{method}({_arguments(arguments)})"
        case Unary(operator=operator, operand=operand):
            return f"({operator} {show(operand)})"
        case Binary(operator=operator, left=left, right=right):
            return f"({show(left)} {operator} {show(right)})"
        case Conditional(condition=condition, when_true=when_true, when_false=when_false):
            return f"({show(condition)} ? {show(when_true)} : {show(when_false)})"
        case ListValue(elements=elements):
            return f"[{', '.join(show(element) for element in elements)}]"
        case RangeValue(lower=lower, upper=upper):
            return f"[{show(lower)}..{show(upper)}]"
        case _:
            assert_never(expression)
