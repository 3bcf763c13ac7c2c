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

# CPython gives up on expressions of about 3,000 parts; nobody reads one of this length anyway.
MAX_PARTS = 1000

# Names that `Scenario.invoke` takes for itself, so that parameters cannot be handed in by them.
INVOKE_KEYWORDS = frozenset({"caller", "label", "settings"})

# Modifiers that say nothing without at least one of these parameters.
NEEDS_ONE_OF = {
    "acceleration": frozenset({"acceleration"}),
    "change_speed": frozenset({"speed"}),
    "position": frozenset({"distance", "time", "at_point", "x"}),
    "speed": frozenset({"speed", "faster_than", "slower_than", "same_as"}),
    "yaw": frozenset({"angle"}),
}


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
            case ir.Variable(value=value, sample=sample):
                self.expressions(() if value is None else (value,))
                if sample is not None:
                    self.expressions((sample.expression,))
                    self.trigger(sample.trigger)
            case ir.Event(trigger=trigger, parameters=parameters):
                self.expressions(p.default for p in parameters if p.default is not None)
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
        self.content(modifier)

    def behavior(self, node: ir.Behavior) -> None:
        match node:
            case ir.Invoke():
                self.invocation(node)
                self.limits(node.duration, node.until)
            case ir.InvokeScenario():
                self.free_names(node)
                self.expressions(argument.value for argument in node.arguments)
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
                for offset in (node.start_to_start, node.end_to_end):
                    if offset is not None:
                        self.time(offset)
                self.limits(node.duration, node.until)
            case ir.Serial() | ir.OneOf():
                self.limits(node.duration, node.until)

    def free_names(self, node: ir.InvokeScenario) -> None:
        for argument in node.arguments:
            if argument.parameter in INVOKE_KEYWORDS:
                self.sink.report(
                    "OSC509",
                    argument.span,
                    f"`{argument.parameter}` is a word of the runtime's own here; rename it",
                )

    def limits(self, duration: ir.Expression | None, until: tuple[ir.Trigger, ...]) -> None:
        if duration is not None:
            self.time(duration)
        for trigger in until:
            self.trigger(trigger)

    def time(self, value: ir.Expression) -> None:
        """Check a time that the tree is built with."""
        if ir.is_live(value):
            self.sink.report(
                "OSC503", value.span, "a time limit cannot depend on the state of the world yet"
            )
        self.expressions((value,))

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
        self.required(node, key, support.required)
        self.exclusive(node)
        for index, modifier in enumerate(node.modifiers):
            self.modifier(modifier, key, support.modifiers)
            earlier = (m for m in node.modifiers[:index] if m.name == modifier.name)
            if any(other.at == modifier.at for other in earlier):
                self.sink.report(
                    "OSC508", modifier.span, f"modifier `{modifier.name}` stands here twice"
                )

    def exclusive(self, node: ir.Invoke) -> None:
        """Report modifiers that speak of the same thing."""
        for group in self.runtime.exclusive:
            found = [modifier for modifier in node.modifiers if modifier.name in group]
            for other in found[1:]:
                if other.name != found[0].name:
                    self.sink.report(
                        "OSC508",
                        other.span,
                        f"`{found[0].name}` and `{other.name}` speak of the same thing",
                        help="give one of them",
                    )

    def required(self, node: ir.Invoke, action: str, needed: frozenset[str]) -> None:
        given = {identifier(argument.parameter) for argument in node.arguments}
        missing = sorted(needed - given)
        if missing:
            names = ", ".join(f"`{name}`" for name in missing)
            self.sink.report(
                "OSC509", node.span, f"action `{action}` cannot do without {names} yet"
            )

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
        self.content(modifier)

    def content(self, modifier: ir.ModifierCall) -> None:
        needed = NEEDS_ONE_OF.get(modifier.name, frozenset())
        given = {argument.parameter for argument in modifier.arguments}
        if needed and not needed & given:
            names = " or ".join(f"`{name}`" for name in sorted(needed))
            self.sink.report(
                "OSC509", modifier.span, f"modifier `{modifier.name}` cannot do without {names} yet"
            )

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
        match trigger.condition:
            case ir.Elapsed() | ir.Every():
                for value in ir.condition_expressions(trigger.condition):
                    self.time(value)
            case ir.Level() | ir.Edge():
                self.expressions(ir.condition_expressions(trigger.condition))
            case None:
                pass

    def expressions(self, expressions: Iterable[ir.Expression]) -> None:
        for expression in expressions:
            parts = ir.walk(expression)
            if len(parts) > MAX_PARTS:
                self.sink.report(
                    "OSC503",
                    expression.span,
                    f"an expression of {len(parts)} parts is too long for a Python module",
                    help="compute parts of it in variables",
                )
            for part in parts:
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
