"""Refuses what the runtime library cannot carry out, before any module is written."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from osc2tx import ir
from osc2tx.backends.py_trees.naming import identifier
from osc2tx.backends.py_trees.runtime_api import (
    ACTOR_CLASSES,
    ANNOTATIONS,
    STRUCT_CLASSES,
    constructor_keyword,
    runtime_support,
)
from osc2tx.diagnostics import DiagnosticSink, Span

OVERLAPS = frozenset({"start", "equal"})


def check_support(module: ir.Module, sink: DiagnosticSink) -> None:
    """Report every part of a module that the runtime does not know."""
    for scenario in module.scenarios:
        _SupportCheck(scenario, sink).run()


class _SupportCheck:
    def __init__(self, scenario: ir.Scenario, sink: DiagnosticSink) -> None:
        self.scenario = scenario
        self.sink = sink
        self.runtime = runtime_support()

    def run(self) -> None:
        for declaration in self.scenario.declarations:
            self.declaration(declaration)
        for method in self.scenario.methods:
            self.method(method)
        for placement in self.scenario.placements:
            for modifier in placement.modifiers:
                self.placing(modifier)
        for node in ir.walk_behaviors(self.scenario.body):
            self.behavior(node)

    def declaration(self, declaration: ir.Declaration) -> None:
        match declaration:
            case ir.Actor(lineage=lineage):
                kind = next((name for name in lineage if name in ACTOR_CLASSES), None)
                self.object(declaration, kind)
            case ir.Struct(type=type_):
                self.object(declaration, type_ if type_ in STRUCT_CLASSES else None)
            case ir.Parameter(value=value, domain=domain):
                self.expressions(part for part in (value, domain) if part is not None)
            case ir.Variable(value=value):
                self.expressions((value,))
            case ir.Event(trigger=trigger):
                if trigger is not None:
                    self.trigger(trigger)

    def method(self, method: ir.Method) -> None:
        for type_ in (method.result, *(parameter.type for parameter in method.parameters)):
            if type_.kind.value not in ANNOTATIONS and type_.name not in ACTOR_CLASSES:
                self.sink.report(
                    "OSC501", method.span, f"a method over `{type_}` is not supported yet"
                )
        self.expressions((method.expression,))

    def object(self, declaration: ir.Actor | ir.Struct, kind: str | None) -> None:
        if kind is None or kind not in self.runtime.objects:
            self.sink.report(
                "OSC501",
                declaration.span,
                f"the runtime has no objects of type `{declaration.type}`",
            )
            return
        for value in declaration.values:
            if constructor_keyword(value.path) not in self.runtime.objects[kind]:
                self.sink.report(
                    "OSC502",
                    value.span,
                    f"the runtime cannot fix `{'.'.join(value.path)}` of a `{declaration.type}`",
                )
            self.expressions((value.value,))

    def placing(self, modifier: ir.ModifierCall) -> None:
        if modifier.name not in self.runtime.placement:
            self.sink.report(
                "OSC508", modifier.span, f"modifier `{modifier.name}` cannot place an actor"
            )
            return
        self.arguments(
            modifier.arguments, self.runtime.placement[modifier.name], f"modifier `{modifier.name}`"
        )

    def behavior(self, node: ir.Behavior) -> None:
        match node:
            case ir.Invoke():
                self.invocation(node)
                self.limits(node.duration, node.until)
            case ir.Wait(trigger=trigger):
                self.trigger(trigger)
            case ir.Emit(arguments=arguments):
                self.expressions(argument.value for argument in arguments)
            case ir.On(trigger=trigger, reactions=reactions):
                self.trigger(trigger)
                for reaction in reactions:
                    self.behavior(reaction)
            case ir.Parallel():
                self.overlap(node)
                self.limits(node.duration, node.until)
            case ir.Serial() | ir.OneOf():
                self.limits(node.duration, node.until)

    def overlap(self, node: ir.Parallel) -> None:
        if node.overlap not in OVERLAPS:
            self.sink.report(
                "OSC506",
                node.span,
                f"`overlap: {node.overlap}` is not supported by the runtime yet",
            )
        for offset in (node.start_to_start, node.end_to_end):
            if offset is not None:
                self.sink.report(
                    "OSC506", offset.span, "offsets of `parallel` are not supported yet"
                )

    def limits(self, duration: ir.Expression | None, until: tuple[ir.Trigger, ...]) -> None:
        self.expressions(() if duration is None else (duration,))
        for trigger in until:
            self.trigger(trigger)

    def invocation(self, node: ir.Invoke) -> None:
        key = f"{node.owner}.{node.action}"
        support = self.runtime.actions.get(key)
        if support is None:
            near = get_close_matches(key, self.runtime.actions, 1)
            help_ = f"the runtime has `{near[0]}`" if near else None
            self.sink.report(
                "OSC507", node.span, f"the runtime has no action `{key}` yet", help=help_
            )
            return
        self.expressions((node.actor,))
        self.arguments(node.arguments, support.arguments, f"action `{key}`")
        for modifier in node.modifiers:
            self.modifier(modifier, key, support.modifiers)

    def modifier(self, modifier: ir.ModifierCall, action: str, accepted: frozenset[str]) -> None:
        if modifier.name not in accepted:
            self.sink.report(
                "OSC508",
                modifier.span,
                f"action `{action}` cannot honour modifier `{modifier.name}` yet",
            )
            return
        known = self.runtime.modifiers[modifier.name]
        if modifier.at == "end" and "at" not in known:
            self.sink.report(
                "OSC509",
                modifier.span,
                f"modifier `{modifier.name}` cannot be asked for `at: end` yet",
            )
        self.arguments(modifier.arguments, known, f"modifier `{modifier.name}`")

    def arguments(
        self, arguments: tuple[ir.Argument, ...], known: frozenset[str], what: str
    ) -> None:
        for argument in arguments:
            if identifier(argument.parameter) not in known:
                self.sink.report(
                    "OSC509",
                    argument.span,
                    f"argument `{argument.parameter}` of {what} is not supported yet",
                )
            self.expressions((argument.value,))

    def trigger(self, trigger: ir.Trigger) -> None:
        if trigger.event is not None and not isinstance(trigger.condition, ir.Level | None):
            self.sink.report(
                "OSC506",
                trigger.span,
                "an event can only be combined with a plain condition yet",
            )
        if trigger.condition is not None:
            self.expressions(ir.condition_expressions(trigger.condition))

    def expressions(self, expressions: Iterable[ir.Expression]) -> None:
        for expression in expressions:
            for part in ir.walk(expression):
                self.expression(part)

    def expression(self, part: ir.Expression) -> None:
        match part:
            case ir.Attribute(base=base, owner=owner, name=name):
                if not self.is_readable(part) and self.is_readable(base):
                    self.unreadable(part.span, f"member `{name}` of `{owner}`")
            case ir.MethodCall(base=ir.ScenarioSelf()):
                pass  # checked where it is declared
            case ir.MethodCall(owner=owner, method=method, arguments=arguments):
                key = f"{owner}.{method}"
                if key not in self.runtime.methods:
                    self.unreadable(part.span, f"method `{key}`")
                else:
                    known = self.runtime.methods[key]
                    for argument in arguments:
                        if argument.parameter not in known:
                            self.unreadable(
                                argument.span, f"argument `{argument.parameter}` of `{key}`"
                            )
            case _:
                pass  # everything else is plain Python

    def is_readable(self, part: ir.Expression) -> bool:
        if not isinstance(part, ir.Attribute):
            return True
        return part.owner in STRUCT_CLASSES or f"{part.owner}.{part.name}" in self.runtime.fields

    def unreadable(self, span: Span, what: str) -> None:
        self.sink.report("OSC503", span, f"{what} is not supported by the runtime yet")
