"""Type names instead of objects: `map.set_map_file(…)` without a field of type `map`.

Examples of the standard use this form (§6.3.1.3, §8.5.4) without a definition. It can only denote
the only object of the type.
"""

from __future__ import annotations

from osc2tx.diagnostics.fixes import Help, write
from osc2tx.semantics.conversions import type_of_owner
from osc2tx.semantics.names.member_lookup import actor_field
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import is_subtype, supertypes
from osc2tx.semantics.symbols import ActorSymbol, FieldSymbol, StructSymbol
from osc2tx.semantics.types import ERROR, ActorType, Type
from osc2tx.syntax import ast

# Actors of the library of which there is one in a run, declared or not.
SINGLETONS = frozenset({"map", "environment"})


def type_as_receiver(r: Resolution, node: ast.NameExpression, env: Environment) -> Type | None:
    """Return the type of the only object of the actor type with a name.

    `None` if the name is not that of an actor type. An ambiguous name is reported.
    """
    named = r.scope.select(r.scope.types_named(node.name.text), node.name, env.context)
    if len(named) != 1 or not isinstance(named[0], ActorSymbol):
        return None
    actor = named[0]
    objects = _objects(r, actor, env)
    if len(objects) == 1:
        _warn(r, node, f"it is taken as `{objects[0].name}`", write(node.span, objects[0].name))
        return _refer(r, node, objects[0])
    declare = f"declare one: `{node.name.text}: {node.name}`"
    if objects:
        listed = " or ".join(f"`{each.name}`" for each in objects)
        _report(r, node, actor, f"write {listed}")
    elif _is_singleton(actor):
        _warn(r, node, "it is taken as the only one", declare)
        return _refer(r, node, implied_object(r, actor, node))
    elif actor.origin == "user" and r.relaxes(
        "OSC622",
        node.span,
        f"`{node.name}` is an actor type; it is taken as an actor of that type",
        key=actor.name,
        help=declare,
    ):
        return _refer(r, node, implied_object(r, actor, node))
    else:
        _report(r, node, actor, declare)
    return ERROR


def _objects(r: Resolution, actor: ActorSymbol, env: Environment) -> list[FieldSymbol]:
    """Return the actors of a type that a place sees."""
    own = (
        [] if env.owner is None else [m for t in supertypes(env.owner) for m in t.members.values()]
    )
    shared = [g for layer in r.scope.layers() for group in layer.globals.values() for g in group]
    found = [
        member
        for member in (*own, *shared)
        if isinstance(member, FieldSymbol)
        and isinstance(member.type, ActorType)
        and is_subtype(member.type.symbol, actor)
    ]
    if env.actor is not None and is_subtype(env.actor, actor):
        found.append(actor_field(r, env.actor))
    return found


def _is_singleton(actor: ActorSymbol) -> bool:
    return any(t.origin == "library" and t.name in SINGLETONS for t in supertypes(actor))


def implied_object(
    r: Resolution, named: ActorSymbol | StructSymbol, node: ast.NameExpression
) -> FieldSymbol:
    """Return the object that a program has without declaring it: one for all scenarios."""
    if named not in r.implied_objects:
        type_ = ast.NamedType(
            span=node.span, name=ast.BehaviorName(span=node.span, actor=None, name=node.name)
        )
        declaration = ast.ParameterDeclaration(
            span=node.span, names=(node.name,), type=type_, default=None, constraints=()
        )
        symbol = FieldSymbol(
            name=named.name,
            namespace=named.namespace,
            span=node.span,
            owner=None,
            type=type_of_owner(named),
            node=declaration,
        )
        r.types[type_] = symbol.type
        r.scope.declared.append(symbol)
        r.implied_objects[named] = symbol
    return r.implied_objects[named]


def _refer(r: Resolution, node: ast.NameExpression, field: FieldSymbol) -> Type:
    r.references[node] = field
    return field.type


def _warn(r: Resolution, node: ast.NameExpression, taken: str, help: Help) -> None:
    if r.relaxations.is_new("OSC415", node.span.source.name, node.name.text):
        r.report("OSC415", node.span, f"`{node.name}` is an actor type; {taken}", help=help)


def _report(r: Resolution, node: ast.NameExpression, actor: ActorSymbol, help: str) -> None:
    r.report(
        "OSC316",
        node.span,
        f"`{node.name}` is an actor type, not an actor",
        help=help,
        labels=declared_here(actor) if actor.origin == "user" else (),
    )
