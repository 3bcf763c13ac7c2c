"""Which declared events, parameters and actors a program uses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import TypeAlias

from osc2tx.analysis.library_facts import is_library_actor
from osc2tx.analysis.tree_walk import NodesByKind, do_directives, nodes_below
from osc2tx.diagnostics import DiagnosticSink, Label
from osc2tx.diagnostics.fixes import write
from osc2tx.diagnostics.suggestions import nearest
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import is_subtype, supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Declared = tuple[sym.TypeSymbol, sym.EventSymbol]
"""A type and an event that it declares."""

SETTINGS: tuple[type[ast.Node], ...] = (
    ast.EmitDirective,
    ast.Invocation,
    ast.ParameterDeclaration,
    ast.VariableDeclaration,
    ast.ModifierApplication,
    ast.Call,
    ast.CallDirective,
)
DIVISIONS = frozenset({ast.BinaryOperator.DIVIDE, ast.BinaryOperator.MODULO})
Rule: TypeAlias = ast.KeepConstraint | ast.RemoveDefault
CONSTRAINTS = (ast.KeepConstraint, ast.RemoveDefault)
"""Types that are used as a whole: a constraint reads their fields only where it relates several."""


@dataclass(slots=True, eq=False)
class Usage:
    """The names that the user's files use.

    Attributes:
        emitted: Events that some `emit` emits.
        awaited: Events that some specification, coverage or expression names.
        read: Fields that are read; a constraint on one field alone does not read it.
        invoked: Behaviors that are invoked.
        waits: Event specifications of the root file.
        emits: `emit`s of the root file.
        settings: Declarations, calls and invocations that set fields and parameters.
        divisions: Divisions and remainders.
        demanded: Constraints and defaults.
        evaluated: Constraints and defaults of scenarios, which set values of an instance.
        casts: Conversions outside of constraints.
        declared: Events and the types that declare them, by the type at the top of the inheritance
            and their name.
    """

    emitted: set[sym.Symbol] = field(default_factory=set)
    awaited: set[sym.Symbol] = field(default_factory=set)
    read: set[sym.Symbol] = field(default_factory=set)
    invoked: set[sym.Symbol] = field(default_factory=set)
    waits: list[ast.EventSpecification] = field(default_factory=list)
    emits: list[ast.EmitDirective] = field(default_factory=list)
    settings: list[ast.Node] = field(default_factory=list)
    divisions: list[ast.Binary] = field(default_factory=list)
    demanded: list[ast.Expression] = field(default_factory=list)
    evaluated: set[ast.Expression] = field(default_factory=set)
    casts: list[ast.Cast] = field(default_factory=list)
    declared: dict[tuple[sym.TypeSymbol, str], list[Declared]] = field(default_factory=dict)


def find_usage(model: SemanticModel, nodes: Mapping[ast.File, NodesByKind]) -> Usage:
    """Return the names that the user's files use.

    Args:
        model: The checked program.
        nodes: The nodes of its files, those below constraints left out.
    """
    usage = Usage()
    for owner in model.symbols:
        if isinstance(owner, sym.TypeSymbol):
            for name, member in owner.members.items():
                if isinstance(member, sym.EventSymbol):
                    usage.declared.setdefault((_ancestor(owner), name), []).append((owner, member))
    for found in nodes.values():
        _look_at(model, usage, found)
    for scenario in model.scenarios:
        usage.evaluated |= {each for s in scenario.statements for each in _demanded(s)}
    usage.emits += nodes[model.root].of(ast.EmitDirective)
    usage.waits += nodes[model.root].of(ast.EventSpecification)
    return usage


def _look_at(model: SemanticModel, usage: Usage, nodes: NodesByKind) -> None:
    for name in (*nodes.of(ast.NameExpression), *nodes.of(ast.MemberAccess)):
        _note(model.symbol_of(name), usage)
    for condition in nodes.of(ast.InheritanceCondition):
        _note(model.symbol_of(condition.field), usage)
    for emit in nodes.of(ast.EmitDirective):
        symbol = model.symbol_of(emit.event)
        if symbol is not None:
            usage.emitted.add(symbol)
    for invocation in nodes.of(ast.Invocation):
        binding = model.bindings.get(invocation)
        if binding is not None:
            usage.invoked.add(binding.callee)
    for kind in SETTINGS:
        usage.settings += nodes.of(kind)
    usage.divisions += (n for n in nodes.of(ast.Binary) if n.operator in DIVISIONS)
    usage.casts += nodes.of(ast.Cast)
    usage.demanded += (keep.expression for keep in nodes.of(ast.KeepConstraint))
    for parameter in nodes.of(ast.ParameterDeclaration):
        usage.demanded += () if parameter.default is None else (parameter.default,)
    rules: list[Rule] = [*nodes.of(ast.KeepConstraint), *nodes.of(ast.RemoveDefault)]
    for rule in rules:
        _look_at_rule(model, usage, rule)


def _objects_of(model: SemanticModel, call: ast.Call) -> set[sym.Symbol]:
    """Return the fields whose methods a call invokes: they read the rest of the object."""
    binding = model.bindings.get(call)
    if binding is None or binding.receiver is None or binding.callee.origin == "builtin":
        return set()
    symbols = (model.symbol_of(node) for node in nodes_below(binding.receiver))
    return {symbol for symbol in symbols if isinstance(symbol, sym.FieldSymbol)}


def _demanded(statement: ast.Statement) -> Iterator[ast.Expression]:
    match statement:
        case ast.KeepConstraint():
            yield statement.expression
        case ast.ParameterDeclaration(default=default):
            yield from () if default is None else (default,)
            for rule in statement.constraints:
                yield from _demanded(rule)


def _note(symbol: sym.Symbol | None, usage: Usage) -> None:
    if isinstance(symbol, sym.EventSymbol):
        usage.awaited.add(symbol)
    elif isinstance(symbol, sym.FieldSymbol):
        usage.read.add(symbol)


def _look_at_rule(model: SemanticModel, usage: Usage, rule: Rule) -> None:
    """Note the fields of a constraint that relates several."""
    fields = set()
    for node in nodes_below(rule):
        if isinstance(node, ast.NameExpression | ast.MemberAccess):
            symbol = model.symbol_of(node)
            if isinstance(symbol, sym.FieldSymbol):
                fields.add(symbol)
        elif isinstance(node, ast.Call):
            usage.settings.append(node)
            usage.read |= _objects_of(model, node)
    if len(fields) > 1:
        usage.read |= fields


def report_usage(model: SemanticModel, usage: Usage, sink: DiagnosticSink) -> None:
    """Report events that nothing connects, and fields that nothing reads."""
    _report_waits(model, usage, sink)
    _report_emits(model, usage, sink)
    for scenario in model.scenarios:
        if do_directives(scenario):
            for member in scenario.members.values():
                if isinstance(member, sym.FieldSymbol):
                    _report_field(model, member, usage, sink)


def _report_waits(model: SemanticModel, usage: Usage, sink: DiagnosticSink) -> None:
    reported: set[sym.Symbol] = set()
    for wait in usage.waits:
        symbol = model.symbol_of(wait.event) if wait.event is not None else None
        if not isinstance(symbol, sym.EventSymbol) or symbol in reported or wait.event is None:
            continue
        if _comes_from_somewhere(model, usage, symbol):
            continue
        reported.add(symbol)
        sink.report(
            "OSC430",
            wait.event.span,
            f"nothing emits event `{symbol.name}`; it must come from outside",
            labels=[Label(symbol.span, "declared here, without a specification")],
            help=f"emit it, or pass it to the run: `--signal {symbol.name}@1s`",
        )


def _comes_from_somewhere(model: SemanticModel, usage: Usage, symbol: sym.EventSymbol) -> bool:
    if symbol.origin != "user" or symbol.is_implicit or symbol.node is None:
        return True  # of the library, of a dialect, or of every behavior
    family = [symbol, *_redeclared(usage, symbol)]
    return any(
        event in usage.emitted or (event.node is not None and event.node.specification is not None)
        for event in family
    )


def _redeclared(usage: Usage, symbol: sym.EventSymbol) -> list[sym.EventSymbol]:
    """Return the events that types above and below declare again under the same name."""
    own = symbol.owner
    if own is None:
        return []
    return [
        event
        for owner, event in usage.declared.get((_ancestor(own), symbol.name), ())
        if owner is not own and (is_subtype(owner, own) or is_subtype(own, owner))
    ]


def _ancestor(symbol: sym.TypeSymbol) -> sym.TypeSymbol:
    """Return the type at the top of an inheritance."""
    *_, top = supertypes(symbol)
    return top


def _report_emits(model: SemanticModel, usage: Usage, sink: DiagnosticSink) -> None:
    """Report an emitted event without use, if the one with a similar name is meant.

    Others mark an instant in the trace.
    """
    in_vain = {
        symbol.name
        for symbol in usage.awaited - usage.emitted
        if isinstance(symbol, sym.EventSymbol) and symbol.origin == "user"
    }
    for emit in usage.emits:
        symbol = model.symbol_of(emit.event)
        if not isinstance(symbol, sym.EventSymbol) or symbol.origin != "user":
            continue
        if _needs_an_invoker(symbol.owner):
            continue  # an invoker may wait for its events
        if symbol in usage.awaited or set(_redeclared(usage, symbol)) & usage.awaited:
            continue
        meant = nearest(symbol.name, in_vain)
        if meant is None:
            continue
        sink.report(
            "OSC431",
            emit.event.span,
            f"nothing waits for event `{symbol.name}`, and nothing emits `{meant}`",
            help=write(emit.event.span, meant, f"did you mean `{meant}`?", is_safe=False),
            labels=[] if symbol.is_implicit else [Label(symbol.span, "declared here")],
        )


def _needs_an_invoker(owner: sym.TypeSymbol | None) -> bool:
    """Whether a behavior has an actor, which only an invocation names; `dut` has none."""
    actor = owner.actor if isinstance(owner, sym.BehaviorSymbol) else None
    return actor is not None and actor.origin != "prelude"


def _report_field(
    model: SemanticModel, field: sym.FieldSymbol, usage: Usage, sink: DiagnosticSink
) -> None:
    if field in usage.read or field.is_variable or field.span.source is not model.root.span.source:
        return
    match field.type:
        case types.ActorType(symbol=actor):
            if not is_library_actor(actor, "map"):  # the road is there for all
                sink.report("OSC433", field.span, f"actor `{field.name}` is not used")
        case types.StructType() if field.constraints:
            pass  # as with `keep(about.requirement == "REQ-7")`: others read the values of members
        case _:
            sink.report("OSC437", field.span, f"parameter `{field.name}` is never read")
