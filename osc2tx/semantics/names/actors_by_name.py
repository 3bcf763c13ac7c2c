"""Actors that are identified by their names alone, as in ScenarioRunner.

There all scenarios of a program share the actor of a name. Here an actor has an owner, and an
invocation passes it. So a scenario that uses an actor of its caller gets a field of this name, and
an actor that an invocation omits is the caller's actor of that name.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.semantics.conversions import symbol_of
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import FieldSymbol, ScenarioSymbol
from osc2tx.semantics.types import ActorType
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


def actor_of_caller(r: Resolution, name: ast.Name, env: Environment) -> FieldSymbol | None:
    """Return the field of a scenario for an actor that only other scenarios declare."""
    scenario = env.owner
    if not isinstance(scenario, ScenarioSymbol):
        return None
    declared = [
        field
        for other in r.scope.declared
        if isinstance(other, ScenarioSymbol)
        and isinstance(field := other.members.get(name.text), FieldSymbol)
    ]
    if len({field.type for field in declared}) != 1 or not _is_actor(declared[0]):
        return None
    if not r.relaxes(
        "OSC628",
        name.span,
        f"`{name}` is an actor of another scenario; it is taken as that of the caller",
        key=f"{scenario.qualified_name} {name}",
        help=f"declare it in `{scenario.qualified_name}`: `{name}: {declared[0].type}`",
        labels=declared_here(declared[0]),
    ):
        return None
    return _adopt(r, scenario, declared[0], name)


def pass_actors(r: Resolution) -> None:
    """Bind actors that invocations omit to the caller's actors of the same names."""
    if "OSC628" not in r.relaxations.dialect.relaxed:
        return
    pending = [s for s in r.scope.declared if isinstance(s, ScenarioSymbol)]
    scenarios = list(pending)
    while pending:
        caller, adopted = pending.pop(0), len(r.adopted)
        for node in _invocations(caller):
            binding = r.bindings.get(node)
            if binding is None or not isinstance(binding.callee, ScenarioSymbol):
                continue
            given = {parameter for parameter, _ in binding.arguments}
            for field in binding.callee.members.values():
                if isinstance(field, FieldSymbol) and _is_actor(field) and field not in given:
                    _pass_actor(r, caller, node, field)
        if len(r.adopted) > adopted:
            pending += scenarios  # those that invoke it hand it over, too


def _pass_actor(
    r: Resolution, caller: ScenarioSymbol, node: ast.Invocation, field: FieldSymbol
) -> None:
    own = caller.members.get(field.name)
    if own is None and field in r.adopted:
        own = _adopt(r, caller, field, ast.Name(span=node.behavior.span, text=field.name))
    if not isinstance(own, FieldSymbol) or own is field or own.type != field.type:
        return
    binding = r.bindings[node]
    what = f"`{field.name}` of `{caller.name}`"
    if field not in r.adopted:
        r.relaxes(
            "OSC628",
            node.behavior.span,
            f"`{binding.callee.name}` uses {what}, its caller",
            key=f"{node.span.start} {field.name}",
            help=f"pass it: `{field.name}: {field.name}`",
        )
    name = ast.Name(span=node.behavior.span, text=field.name)
    value = ast.NameExpression(span=node.behavior.span, name=name)
    r.references[value] = own
    r.types[value] = own.type
    r.bindings[node] = replace(binding, arguments=(*binding.arguments, (field, value)))


def _adopt(
    r: Resolution, scenario: ScenarioSymbol, actor: FieldSymbol, name: ast.Name
) -> FieldSymbol:
    assert isinstance(actor.node, ast.ParameterDeclaration)
    declaration = ast.ParameterDeclaration(
        span=name.span, names=(name,), type=actor.node.type, default=None, constraints=()
    )
    field = FieldSymbol(
        name=actor.name,
        namespace=scenario.namespace,
        span=actor.span,
        owner=scenario,
        type=actor.type,
        node=declaration,
    )
    scenario.members[field.name] = field
    scenario.statements.append(declaration)
    r.adopted.add(field)
    return field


def _is_actor(field: FieldSymbol) -> bool:
    """Whether a field is an actor that a world moves, not a map or a path; and not another one."""
    symbol = symbol_of(field.type)
    return (
        isinstance(field.type, ActorType)
        and isinstance(field.node, ast.ParameterDeclaration)
        and field.default is None
        and symbol is not None
        and any(t.name == "physical_object" and t.origin == "library" for t in supertypes(symbol))
    )


def _invocations(scenario: ScenarioSymbol) -> Iterator[ast.Invocation]:
    stack = [s.member for s in scenario.statements if isinstance(s, ast.DoDirective)]
    while stack:
        member = stack.pop()
        if isinstance(member, ast.Composition):
            stack += reversed(member.members)
        elif isinstance(member, ast.Invocation):
            yield member
