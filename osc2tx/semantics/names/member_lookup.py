"""Finding members of types and names in an environment (language.md 12.2)."""

from __future__ import annotations

from osc2tx.semantics.builtins import (
    COMPOSITION,
    COMPOSITION_FIELDS,
    DURATION,
    LIFE_CYCLE,
    builtin_field,
)
from osc2tx.semantics.declarations.resolve_types import choose
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.scope import Context, supertypes
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    BehaviorSymbol,
    EventSymbol,
    FieldSymbol,
    Member,
    ScenarioSymbol,
    Symbol,
    TypeSymbol,
)
from osc2tx.semantics.types import ActorType
from osc2tx.syntax import ast


def find_member(
    r: Resolution, owner: TypeSymbol, name: ast.Name, context: Context, *, quiet: bool = False
) -> Member | None:
    """Return a member of a type: own, inherited, from an extension, or built in.

    A member of a namespace that the place neither is in nor uses needs a prefix (§7.7.4); without
    it the member is returned all the same, after a report.
    """
    text = name.text
    candidates = [
        m
        for ancestor in supertypes(owner)
        if text in ancestor.members
        for m in ancestor.named(text)
    ]
    if not candidates:
        return _builtin_member(r, owner, name.text) if name.namespace is None else None
    first = candidates[0]
    if name.namespace is None and len(candidates) == 1 and first.namespace == context.namespace:
        return first
    selected = r.scope.select(candidates, name, context)
    homes = {m.namespace for m in selected}
    if len(homes) == 1:
        return selected[0]
    if not quiet:
        choose(r, selected or candidates, name, context)
    return first


def _builtin_member(r: Resolution, owner: TypeSymbol, text: str) -> Member | None:
    if not isinstance(owner, BehaviorSymbol):
        return None
    if text == "actor" and owner.actor is not None:
        return actor_field(r, owner.actor)
    if owner is COMPOSITION and text in COMPOSITION_FIELDS:
        return COMPOSITION_FIELDS[text]
    if isinstance(owner, ScenarioSymbol | ActionSymbol):
        return DURATION if text == "duration" else LIFE_CYCLE.get(text)
    return None


def actor_field(r: Resolution, actor: ActorSymbol) -> FieldSymbol:
    """Return the implicit field `actor` of behaviors of an actor type."""
    if actor not in r.actor_fields:
        r.actor_fields[actor] = builtin_field("actor", ActorType(actor))
    return r.actor_fields[actor]


def lookup_local(
    r: Resolution, name: ast.Name, env: Environment, *, quiet: bool = False
) -> Symbol | None:
    """Return the symbol of a name inside a type, its method or its event."""
    if name.namespace is None and name.text in env.locals:
        return env.locals[name.text]
    if env.owner is None:
        return None
    found = find_member(r, env.owner, name, env.context, quiet=quiet)
    if found is None and name.text == "actor" and env.actor is not None:
        return actor_field(r, env.actor)
    return found


def lookup_value(
    r: Resolution, name: ast.Name, env: Environment, *, quiet: bool = False
) -> Symbol | None:
    """Return the symbol of a name, except enum members."""
    found = lookup_local(r, name, env, quiet=quiet)
    if found is not None:
        return found
    candidates = r.scope.globals_named(name.text)
    return choose(r, candidates, name, env.context) if candidates else None


def visible_names(r: Resolution, env: Environment) -> frozenset[str]:
    """Return the names that could have been meant in an environment."""
    names = r.visible.get(env.owner)
    if names is None:
        members = set() if env.owner is None else member_names(env.owner)
        names = frozenset(members.union(*(layer.globals for layer in r.scope.layers())))
        r.visible[env.owner] = names
    return names.union(env.locals) if env.locals else names


def member_names(owner: TypeSymbol) -> set[str]:
    """Return the names of all members of a type, built-in ones included."""
    names = {
        name
        for ancestor in supertypes(owner)
        for name, member in ancestor.members.items()
        if not (isinstance(member, EventSymbol) and member.is_implicit)
    }
    if isinstance(owner, ScenarioSymbol | ActionSymbol):
        names |= {"duration", *LIFE_CYCLE}
    return names


def parameters_of(owner: BehaviorSymbol) -> list[FieldSymbol]:
    """Return the parameters of a behavior or modifier, own ones first, in order."""
    return [
        member
        for ancestor in supertypes(owner)
        for member in ancestor.members.values()
        if isinstance(member, FieldSymbol) and not member.is_variable
    ]
