"""Refuses what the runtime library cannot carry out, before any module is written."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.backends.py_trees.call_support import CallCheck
from osc2tx.backends.py_trees.naming import identifier
from osc2tx.backends.py_trees.runtime_api import (
    ACTOR_CLASSES,
    ANNOTATIONS,
    NESTED_OBJECTS,
    STRUCT_CLASSES,
    constructor_keyword,
    runtime_support,
)
from osc2tx.diagnostics import DiagnosticSink, Span

# CPython gives up on expressions of about 3,000 parts; nobody reads one of this length anyway.
MAX_PARTS = 1000

# Names that `Scenario.invoke` takes for itself, so that parameters cannot be handed in by them.
INVOKE_KEYWORDS = frozenset({"caller", "label", "settings"})


def check_support(module: ir.Module, sink: DiagnosticSink) -> None:
    """Report every part of a module that the runtime does not know."""
    own = {each.name: each for each in module.types}
    for each in module.types:
        if each.is_actor:
            check_fields(each, sink)
    for scenario in module.scenarios:
        _SupportCheck(scenario, own, sink).run()


def check_fields(own: ir.OwnType, sink: DiagnosticSink) -> None:
    """Report fields of an own actor that would hide what the runtime keeps there."""
    for field in own.fields:
        if identifier(field.name) in runtime_support().reserved | {"fields", "self"}:
            sink.report(
                "OSC501",
                field.span,
                f"the runtime has something else by the name `{field.name}`; rename the field",
            )


class _SupportCheck:
    def __init__(
        self, scenario: ir.Scenario, own: dict[str, ir.OwnType], sink: DiagnosticSink
    ) -> None:
        self.scenario = scenario
        self.own_fields = {(t.name, f.name) for t in own.values() for f in t.fields}
        self.own = own
        self.sink = sink
        self.runtime = runtime_support()
        self.calls = CallCheck(self.runtime, sink, self.expressions)

    def run(self) -> None:
        for declaration in self.scenario.declarations:
            self.declaration(declaration)
        for method in self.scenario.methods:
            self.method(method)
        for item in self.scenario.coverage:
            parts = (item.expression, item.ignore, item.illegal)
            self.expressions(part for part in parts if part is not None)
        self.expressions(constraint.expression for constraint in self.scenario.constraints)
        for placement in self.scenario.placements:
            for modifier in placement.modifiers:
                self.calls.placing(modifier)
        for node in ir.walk_behaviors(self.scenario.body):
            self.behavior(node)

    def declaration(self, declaration: ir.Declaration) -> None:
        match declaration:
            case ir.Actor(lineage=lineage):
                kind = next((name for name in lineage if name in ACTOR_CLASSES), None)
                self.object(declaration, kind)
            case ir.Struct(lineage=lineage):
                self.object(declaration, next((n for n in lineage if n in STRUCT_CLASSES), None))
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

    def is_known(self, type_: ir.ValueType) -> bool:
        """Whether values of a type can be handed to a method."""
        if type_.element is not None:
            return self.is_known(type_.element)
        known = (ANNOTATIONS, ACTOR_CLASSES, STRUCT_CLASSES, self.own)
        return type_.kind.value in ANNOTATIONS or any(type_.name in names for names in known)

    def method(self, method: ir.Method) -> None:
        for type_ in (method.result, *(parameter.type for parameter in method.parameters)):
            if type_ is not None and not self.is_known(type_):
                self.sink.report(
                    "OSC501", method.span, f"a method over `{type_}` is not supported yet"
                )
        if method.expression is not None:
            self.expressions((method.expression,))

    def object(self, declaration: ir.Actor | ir.Struct, kind: str | None) -> None:
        bases = [name for name in declaration.lineage if name not in self.own]
        is_own = isinstance(declaration, ir.Struct) and not bases
        if not is_own and (kind is None or kind not in self.runtime.objects):
            self.sink.report(
                "OSC501",
                declaration.span,
                f"the runtime has no objects of type `{declaration.type}`",
            )
            return
        if isinstance(declaration, ir.Struct):
            if declaration.value is not None:
                self.expressions((declaration.value,))
                return
            if kind is not None:
                self.needed(declaration, kind)
        for value in declaration.values:
            own = len(value.path) == 1 and any(
                (name, value.path[0]) in self.own_fields for name in declaration.lineage
            )
            if not own and (kind is None or not self.can_fix(kind, value.path)):
                self.sink.report(
                    "OSC502",
                    value.span,
                    f"the runtime cannot fix `{'.'.join(value.path)}` of a `{declaration.type}`",
                )
            self.expressions((value.value,))

    def can_fix(self, kind: str, path: tuple[str, ...]) -> bool:
        """Whether a constructor takes a member."""
        inner = NESTED_OBJECTS.get((kind, path[0]))
        if inner is not None and len(path) > 1:
            return self.can_fix(inner, path[1:])
        return constructor_keyword(path) in self.runtime.objects[kind]

    def needed(self, declaration: ir.Struct, kind: str) -> None:
        """Report members that a value cannot do without."""
        given = {constructor_keyword(value.path) for value in declaration.values}
        given |= {value.path[0] for value in declaration.values}
        missing = ", ".join(f"`{name}`" for name in sorted(self.runtime.needed[kind] - given))
        if missing:
            self.sink.report(
                "OSC501",
                declaration.span,
                f"`{declaration.name}` does not say its {missing}",
                help="give it a whole value, or `keep(it.member == value)` for each member",
            )

    def behavior(self, node: ir.Behavior) -> None:
        match node:
            case ir.Invoke():
                self.calls.invocation(node)
                self.limits(node.duration, node.until)
            case ir.InvokeScenario():
                self.free_names(node)
                self.expressions(argument.value for argument in node.arguments)
                self.limits(node.duration, node.until)
            case ir.Wait(trigger=trigger):
                self.trigger(trigger)
            case ir.Emit(arguments=arguments):
                self.expressions(argument.value for argument in arguments)
            case ir.Call(call=call):
                self.expressions((call,))
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
            self.at_least_zero(duration)
        for trigger in until:
            self.trigger(trigger)

    def at_least_zero(self, duration: ir.Expression) -> None:
        for value in ir.children(duration) if isinstance(duration, ir.RangeValue) else (duration,):
            seconds = ir.constant(value)
            if seconds is not None and seconds < 0.0:
                self.sink.report("OSC513", value.span, "a duration cannot be negative")

    def time(self, value: ir.Expression) -> None:
        """Check a time that the tree is built with."""
        if ir.is_live(value):
            self.sink.report(
                "OSC503", value.span, "a time limit cannot depend on the state of the world yet"
            )
        self.expressions((value,))

    def trigger(self, trigger: ir.Trigger) -> None:
        if trigger.event is not None and not isinstance(trigger.condition, ir.Level | None):
            self.sink.report(
                "OSC506",
                trigger.span,
                "an event can only be combined with a plain condition yet",
            )
        match trigger.condition:
            case ir.Elapsed() | ir.Every():
                self.period(trigger.condition)
                for value in ir.condition_expressions(trigger.condition):
                    self.time(value)
            case ir.Level() | ir.Edge():
                self.expressions(ir.condition_expressions(trigger.condition))
            case None:
                pass

    def period(self, condition: ir.Elapsed | ir.Every) -> None:
        if isinstance(condition, ir.Every):
            seconds = ir.constant(condition.period)
            if seconds is not None and seconds <= 0.0:
                self.sink.report("OSC513", condition.period.span, "a period must be above zero")

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
                if owner in self.own and not self.is_readable(part):
                    self.sink.report(
                        "OSC503",
                        part.span,
                        f"`{name}` of `{owner}` has no value",
                        help="give it a default, or `keep(it.member == value)`",
                    )
                elif not self.is_readable(part) and self.is_readable(base):
                    self.unreadable(part.span, f"member `{name}` of `{owner}`")
            case ir.MethodCall(base=ir.ScenarioSelf()):
                pass  # checked where it is declared
            case ir.MethodCall(owner="string" | "range"):
                pass  # Python has them
            case ir.TypeTest(tested=name) | ir.Downcast(type=ir.ValueType(name=name)):
                if name not in ACTOR_CLASSES and name not in self.own:
                    self.unreadable(part.span, f"a test for actor type `{name}`")
            case ir.MethodCall(owner=owner, method=method, arguments=arguments):
                key = f"{owner}.{method}"
                if key not in self.runtime.methods:
                    self.unreadable(part.span, f"method `{key}`")
                else:
                    known = self.runtime.methods[key]
                    for argument in arguments:
                        if identifier(argument.parameter) not in known:
                            self.unreadable(
                                argument.span, f"argument `{argument.parameter}` of `{key}`"
                            )
            case _:
                pass  # everything else is plain Python

    def is_readable(self, part: ir.Expression) -> bool:
        if not isinstance(part, ir.Attribute):
            return True
        if (part.owner, part.name) in self.own_fields:
            return True
        return part.owner in STRUCT_CLASSES or f"{part.owner}.{part.name}" in self.runtime.fields

    def unreadable(self, span: Span, what: str) -> None:
        self.sink.report("OSC503", span, f"{what} is not supported by the runtime yet")
