"""Rejects constructs that the runtime library does not have, before any module is written."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import PurePosixPath

from osc2tx import ir
from osc2tx.backends.py_trees.naming import identifier, module_name
from osc2tx.backends.py_trees.own_names import declarations, has_module, is_own
from osc2tx.backends.py_trees.runtime_api import ANNOTATIONS
from osc2tx.catalogue import object_tables
from osc2tx.catalogue.constructors import (
    ACTOR_CLASSES,
    STRUCT_CLASSES,
)
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.support.python_modules import is_taken

# CPython gives up on expressions of about 3,000 parts; one of this length is unreadable anyway.
MAX_PARTS = 1000

# Names that constructors of actions and `Scenario.invoke` use: no parameter is passed by them.
ACTION_KEYWORDS = frozenset({"actor", "label", "modifiers", "self"})
INVOKE_KEYWORDS = frozenset({"caller", "known_as", "self", "settings"})


def check_support(module: ir.Module, sink: DiagnosticSink) -> None:
    """Report every part of a module that the runtime does not know, and a name it cannot have."""
    check_name(module, sink)
    own = {each.name: each for each in module.types}
    for scenario in (*module.bases, *module.scenarios):
        _SupportCheck(scenario.declarations, own, sink).run(scenario)


def has_support(method: ir.Method, types: Iterable[ir.UserType]) -> bool:
    """Return whether a class may have an unused method."""
    sink = DiagnosticSink()
    _SupportCheck((), {each.name: each for each in types}, sink).method(method)
    return not sink.has_errors


def check_name(module: ir.Module, sink: DiagnosticSink) -> None:
    """Report that the module is not called as its file is, where that would hide another one."""
    stem = PurePosixPath(module.source).stem
    own = next((d.span.source for d in declarations(module) if is_own(d, module)), None)
    if own is None or not has_module(module) or not is_taken(stem):
        return
    message = (
        f"the module has the name `{module_name(module.source)}`: Python has a module `{stem}`"
    )
    sink.report("OSC517", Span(own, 0, 0), message, help="rename the file")


def _late_labels(scenario: ir.AbstractScenario) -> set[str]:
    """Return the labels of invocations that are made when they start."""
    nodes = ir.walk_behaviors(scenario.body) if isinstance(scenario, ir.Scenario) else ()
    return {
        node.label
        for node in nodes
        if isinstance(node, ir.InvokeScenario)
        and node.label is not None
        and any(ir.is_live(argument.value) for argument in node.arguments)
    }


class _SupportCheck:
    def __init__(
        self,
        declarations: Sequence[ir.Declaration],
        own: dict[str, ir.UserType],
        sink: DiagnosticSink,
    ) -> None:
        self.declarations = declarations
        self.own_fields = {(t.name, f.name) for t in own.values() for f in t.fields}
        self.own = own
        self.sink = sink
        self.objects = object_tables()
        self.late_labels: set[str] = set()

    def run(self, scenario: ir.AbstractScenario) -> None:
        self.late_labels = _late_labels(scenario)
        for declaration in scenario.declarations:
            self.declaration(declaration)
        for method in scenario.methods:
            self.method(method)
        for item in scenario.coverage:
            parts = (item.expression, item.ignore, item.illegal)
            self.expressions(part for part in parts if part is not None)
        self.expressions(constraint.expression for constraint in scenario.constraints)
        for placement in scenario.placements:
            self.modifiers(placement.modifiers)
        if isinstance(scenario, ir.Scenario):
            for node in ir.walk_behaviors(scenario.body):
                self.behavior(node)

    def declaration(self, declaration: ir.Declaration) -> None:
        match declaration:
            case ir.Actor() | ir.Struct():
                self.object(declaration)
            case ir.Parameter(value=value, domain=domain):
                self.expressions(part for part in (value, domain) if part is not None)
            case ir.Variable(value=value, sample=sample):
                self.expressions(() if value is None else (value,))
                if sample is not None:
                    self.expressions((sample.expression,))
                    if isinstance(sample.trigger, ir.Trigger):
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
        is_plain = type_.kind is ir.Kind.ENUM or type_.kind.value in ANNOTATIONS
        return is_plain or any(type_.name in names for names in known)

    def method(self, method: ir.Method) -> None:
        for type_ in (method.result, *(parameter.type for parameter in method.parameters)):
            if type_ is not None and not self.is_known(type_):
                self.sink.report(
                    "OSC501", method.span, f"a method over `{type_}` is not supported yet"
                )
        if method.expression is not None:
            self.expressions((method.expression,))

    def object(self, declaration: ir.Actor | ir.Struct) -> None:
        if isinstance(declaration, ir.Actor) and declaration.is_given:
            return
        if isinstance(declaration, ir.Struct) and declaration.value is not None:
            self.expressions((declaration.value,))
            return
        self.expressions(value.value for value in declaration.values)

    def behavior(self, node: ir.Behavior) -> None:
        match node:
            case ir.Invoke():
                if node.is_own:
                    self.free_names(node, ACTION_KEYWORDS)
                self.expressions(() if node.actor is None else (node.actor,))
                self.expressions(argument.value for argument in node.arguments)
                self.modifiers(node.modifiers)
                self.limits(node.duration, node.until)
            case ir.InvokeScenario():
                self.free_names(node, INVOKE_KEYWORDS)
                self.expressions(a.value for a in (*node.arguments, *node.times))
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

    def modifiers(self, modifiers: Iterable[ir.ModifierCall]) -> None:
        for modifier in modifiers:
            self.expressions(argument.value for argument in modifier.arguments)

    def free_names(self, node: ir.Invoke | ir.InvokeScenario, taken: frozenset[str]) -> None:
        for argument in node.arguments:
            if argument.parameter in taken:
                self.sink.report(
                    "OSC509",
                    argument.span,
                    f"`{argument.parameter}` is a reserved name of the runtime here; rename it",
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
                "OSC503",
                value.span,
                "a time limit cannot depend on the state of the world",
                help="end it at a condition instead: `until expression`, or `until elapsed(…)`",
            )
        self.expressions((value,))

    def trigger(self, trigger: ir.Trigger) -> None:
        event = trigger.event
        if isinstance(event, ir.InnerEvent) and event.label in self.late_labels:
            self.sink.report(
                "OSC503",
                event.span,
                f"the events of `{event.label}` are there only once it has started, as an argument"
                " of it depends on the state of the world",
                help=f"wait for `@{event.label}.end`, or pass the actor and read its state",
            )
        match trigger.condition:
            case ir.Every():
                for value in ir.condition_expressions(trigger.condition):
                    self.time(value)
            case ir.Level() | ir.Edge() | ir.Elapsed():
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
                is_own = owner in self.own and not self.own[owner].is_of_library
                if is_own and not self.is_readable(part):
                    self.sink.report(
                        "OSC503",
                        part.span,
                        f"`{name}` of `{owner}` has no value",
                        help="give it a default, or `keep(it.member == value)`",
                    )
                elif not self.is_readable(part) and self.is_readable(base):
                    self.unreadable(part.span, f"member `{name}` of `{owner}`")
                elif f"{owner}.{name}" in self.objects.unknown:
                    self.said(part, base)
            case ir.MethodCall(base=ir.ScenarioSelf()):
                pass  # checked where it is declared
            case ir.MethodCall(owner="string" | "range"):
                pass  # Python has them
            case ir.TypeTest(tested=name) | ir.Downcast(type=ir.ValueType(name=name)):
                if name not in ACTOR_CLASSES and name not in self.own:
                    self.unreadable(part.span, f"a test for actor type `{name}`")
            case ir.MethodCall(owner=owner, method=method, arguments=arguments):
                key = f"{owner}.{method}"
                if key not in self.objects.methods:
                    self.unreadable(part.span, f"method `{key}`")
                else:
                    known = self.objects.methods[key]
                    for argument in arguments:
                        if identifier(argument.parameter) not in known:
                            self.unreadable(
                                argument.span, f"argument `{argument.parameter}` of `{key}`"
                            )
            case _:
                pass  # everything else is plain Python

    def said(self, part: ir.Attribute, base: ir.Expression) -> None:
        """Report an unstated member of an actor that no catalogue has."""
        name = base.name if isinstance(base, ir.FieldRef) else None
        actors = (d for d in self.declarations if isinstance(d, ir.Actor))
        actor = next((each for each in actors if each.name == name), None)
        if actor is not None and all(value.path[0] != part.name for value in actor.values):
            self.sink.report(
                "OSC503",
                part.span,
                f"no constraint states the `{part.name}` of `{name}`",
                help=f"`keep({name}.{part.name} == value)`",
            )

    def is_readable(self, part: ir.Expression) -> bool:
        if not isinstance(part, ir.Attribute):
            return True
        if (part.owner, part.name) in self.own_fields:
            return True
        return part.owner in STRUCT_CLASSES or f"{part.owner}.{part.name}" in self.objects.fields

    def unreadable(self, span: Span, what: str) -> None:
        self.sink.report("OSC503", span, f"{what} is not supported by the runtime yet")
