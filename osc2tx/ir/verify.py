"""The verifier: a violated invariant of the IR is a bug of the compiler, not of the source."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from osc2tx.diagnostics import InternalCompilerError
from osc2tx.ir import behaviors as tree
from osc2tx.ir.declarations import Actor, Event, Parameter, Struct, Variable
from osc2tx.ir.expressions import Expression, FieldRef, ParameterRef
from osc2tx.ir.nodes import AbstractScenario, Module, Scenario
from osc2tx.ir.traversal import walk
from osc2tx.ir.user_types import UserModifier
from osc2tx.ir.values import Kind


def verify(module: Module) -> None:
    """Check a module.

    Raises:
        InternalCompilerError: A name is declared twice or not at all, a value is used before
            its declaration, a composition is empty, a reference dangles.
    """
    every = (*module.bases, *module.scenarios)
    _require_unique((s.key for s in every), f"scenarios of {module.source}")
    for modifier in module.modifiers:
        _verify_modifier(modifier)
    keys = set[str]()
    for scenario in every:
        if scenario.base is not None and scenario.base not in keys:
            raise InternalCompilerError(f"{scenario.name}: no base {scenario.base!r} above it")
        keys.add(scenario.key)
        _ScenarioVerifier(scenario).run()


def _verify_modifier(modifier: UserModifier) -> None:
    known = {parameter.name for parameter in modifier.parameters}
    for call in modifier.calls:
        for argument in call.arguments:
            for part in walk(argument.value):
                if isinstance(part, FieldRef):
                    raise InternalCompilerError(f"{modifier.name}: reads field {part.name!r}")
                if isinstance(part, ParameterRef) and part.name not in known:
                    raise InternalCompilerError(f"{modifier.name}: no parameter {part.name!r}")


def _require_unique(names: Iterator[str], what: str) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise InternalCompilerError(f"{what}: {name!r} stands twice")
        seen.add(name)


class _ScenarioVerifier:
    def __init__(self, scenario: AbstractScenario) -> None:
        self.scenario = scenario
        self.tree = walk_behaviors(scenario.body) if isinstance(scenario, Scenario) else ()
        self.fields = {d.name for d in scenario.declarations}
        self.actors = {
            d.name
            for d in scenario.declarations
            if isinstance(d, Actor) or (isinstance(d, Parameter) and d.type.kind is Kind.ACTOR)
        }
        self.events = {d.name for d in scenario.declarations if isinstance(d, Event)}
        self.labels: list[str] = []

    def run(self) -> None:
        scenario = self.scenario
        _require_unique((d.name for d in scenario.declarations), f"fields of {scenario.name}")
        for member in self.tree:
            if member.label is not None:
                self.labels.append(member.label)
        _require_unique(iter(self.labels), f"labels of {scenario.name}")
        self.check_declarations()
        self.check_methods()
        for constraint in scenario.constraints:
            self.check_expression(constraint.expression)
        for item in scenario.coverage:
            self.require(
                (item.expression is None) == bool(item.items), f"coverage item {item.name!r}"
            )
            for expression in (item.expression, item.ignore, item.illegal):
                if expression is not None:
                    self.check_expression(expression)
            if isinstance(item.event, tree.EventRef):
                self.check_event(item.event)
        for placement in scenario.placements:
            self.require(placement.actor in self.actors, f"placement of {placement.actor!r}")
            for modifier in placement.modifiers:
                self.check_modifier(modifier)
        for member in self.tree:
            self.check_behavior(member)

    def require(self, holds: bool, what: str) -> None:
        if not holds:
            raise InternalCompilerError(f"{self.scenario.name}: invalid {what}")

    def check_declarations(self) -> None:
        declared: set[str] = set()
        for declaration in self.scenario.declarations:
            match declaration:
                case Struct(value=whole) if whole is not None:
                    self.check_expression(whole, declared)
                case Actor(values=values) | Struct(values=values):
                    for given in values:
                        self.check_expression(given.value, declared)
                case Parameter(value=value, domain=domain):
                    for expression in (value, domain):
                        if expression is not None:
                            self.check_expression(expression, declared)
                case Variable(value=value, sample=sample):
                    self.require(
                        value is not None or sample is not None,
                        f"variable {declaration.name!r} without value and sample",
                    )
                    if value is not None:
                        self.check_expression(value, declared)
                    if sample is not None:
                        self.check_expression(sample.expression)
                        if not isinstance(sample.trigger, tree.Moment):
                            self.check_trigger(sample.trigger)
                case Event(trigger=trigger):
                    if trigger is not None:
                        self.check_trigger(trigger)
            declared.add(declaration.name)

    def check_methods(self) -> None:
        methods = self.scenario.methods
        _require_unique((m.name for m in methods), f"methods of {self.scenario.name}")
        for method in methods:
            known = {parameter.name for parameter in method.parameters}
            self.require(
                (method.expression is None) != (method.external is None),
                f"body of {method.name!r}",
            )
            if method.expression is None:
                continue
            for part in walk(method.expression):
                if isinstance(part, ParameterRef):
                    self.require(part.name in known, f"parameter {part.name!r} of {method.name!r}")
            self.check_expression(method.expression)

    def check_behavior(self, node: tree.Behavior) -> None:
        match node:
            case tree.Serial() | tree.Parallel() | tree.OneOf():
                self.require(bool(node.members), f"empty composition {node.name!r}")
                self.check_limits(node.duration, node.until)
            case tree.Invoke():
                self.require(
                    (node.actor is None) is (node.owner is None), f"owner of {node.name!r}"
                )
                if node.actor is not None:
                    self.require(node.actor.type.kind is Kind.ACTOR, f"actor of {node.name!r}")
                    self.check_expression(node.actor)
                for argument in node.arguments:
                    self.check_expression(argument.value)
                for modifier in node.modifiers:
                    self.check_modifier(modifier)
                self.check_limits(node.duration, node.until)
            case tree.InvokeScenario():
                for argument in (*node.arguments, *node.times):
                    self.check_expression(argument.value)
                given = {argument.parameter for argument in node.arguments}
                for value in (value for special in node.specials for value in special.values):
                    self.require(value.parameter in given, f"choice by {value.parameter!r}")
                    self.check_expression(value.value)
                if node.actor is not None:
                    self.check_expression(node.actor)
                self.check_limits(node.duration, node.until)
            case tree.Wait(trigger=trigger):
                self.check_trigger(trigger)
            case tree.Emit(event=event):
                self.check_event(event)
            case tree.On(trigger=trigger, reactions=reactions):
                self.check_trigger(trigger)
                for reaction in reactions:
                    self.check_behavior(reaction)
            case tree.Call(call=call):
                self.check_expression(call)

    def check_limits(self, duration: Expression | None, until: tuple[tree.Trigger, ...]) -> None:
        if duration is not None:
            self.check_expression(duration)
        for trigger in until:
            self.check_trigger(trigger)

    def check_modifier(self, modifier: tree.ModifierCall) -> None:
        self.require(modifier.at in ("start", "end", "all"), f"`at` of {modifier.name!r}")
        for argument in modifier.arguments:
            self.check_expression(argument.value)

    def check_trigger(self, trigger: tree.Trigger) -> None:
        self.require(
            trigger.event is not None or trigger.condition is not None, "trigger without content"
        )
        match trigger.event:
            case tree.EventRef():
                self.check_event(trigger.event)
            case tree.LabelEvent(label=label) | tree.InnerEvent(label=label):
                self.require(label in self.labels, f"reference to label {label!r}")
            case None:
                pass
        if trigger.condition is not None:
            for expression in condition_expressions(trigger.condition):
                self.check_expression(expression)

    def check_event(self, event: tree.EventRef) -> None:
        self.require(event.name in self.events, f"reference to event {event.name!r}")

    def check_expression(self, expression: Expression, declared: set[str] | None = None) -> None:
        known = self.fields if declared is None else declared
        for part in walk(expression):
            if isinstance(part, FieldRef):
                self.require(part.name in known, f"reference to field {part.name!r}")


def condition_expressions(condition: tree.Condition) -> tuple[Expression, ...]:
    """Return the expressions directly inside a condition."""
    match condition:
        case tree.Level(expression=expression) | tree.Edge(expression=expression):
            return (expression,)
        case tree.Elapsed(duration=duration):
            return (duration,)
        case tree.Every(period=period, offset=offset):
            return (period,) if offset is None else (period, offset)


@lru_cache(maxsize=512)  # back ends walk the same bodies for each member
def walk_behaviors(root: tree.Behavior) -> tuple[tree.Behavior, ...]:
    """Return a behavior and everything below it in source order, without recursion."""
    found: list[tree.Behavior] = []
    pending = [root]
    while pending:
        node = pending.pop()
        found.append(node)
        if isinstance(node, tree.Serial | tree.Parallel | tree.OneOf):
            pending.extend(reversed(node.members))
    return tuple(found)
