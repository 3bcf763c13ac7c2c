"""Resolves type names, bases and actors (§7.2.2.2, §7.3)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar, assert_never

from osc2tx.catalogue import catalogue
from osc2tx.diagnostics.fixes import Help, write, write_one_of
from osc2tx.diagnostics.suggestions import name_meant, one_of
from osc2tx.semantics.declarations.undeclared_models import undeclared_model
from osc2tx.semantics.dialects import PRELUDE_BEHAVIORS, TYPE_ALIASES
from osc2tx.semantics.names.aliases import (
    behavior_alias,
    standard_behavior,
    type_alias,
    write_instead,
)
from osc2tx.semantics.names.colloquial_names import BEHAVIORS, NO_BEHAVIORS, TYPES, plain_word
from osc2tx.semantics.names.other_dialects import advise
from osc2tx.semantics.names.unknown_names import report_unimported
from osc2tx.semantics.resolution import Resolution, declared_here
from osc2tx.semantics.scope import CallableBehavior, Context, NamedSymbol, is_subtype, supertypes
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    EnumSymbol,
    PhysicalTypeSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
)
from osc2tx.semantics.types import (
    ERROR,
    PRIMITIVES,
    ActorType,
    BehaviorType,
    EnumType,
    ListType,
    PhysicalType,
    PrimitiveType,
    RangeType,
    StructType,
    Type,
)
from osc2tx.syntax import ast

S = TypeVar("S", bound=Symbol)


def type_of_symbol(symbol: NamedSymbol) -> Type:
    """Return the type that a declaration defines."""
    match symbol:
        case PhysicalTypeSymbol():
            return PhysicalType(symbol.name, symbol.dimension)
        case EnumSymbol():
            return EnumType(symbol)
        case StructSymbol():
            return StructType(symbol)
        case ActorSymbol():
            return ActorType(symbol)
        case ScenarioSymbol() | ActionSymbol():
            return BehaviorType(symbol)
        case _:
            assert_never(symbol)


def resolve_type(r: Resolution, node: ast.TypeName, context: Context) -> Type:
    """Return the type of a type name."""
    match node:
        case ast.NamedType():
            return _resolve_named(r, node, context)
        case ast.ListType():
            return _resolve_list(r, node, context)
        case ast.RangeType():
            return _resolve_range(r, node, context)
        case _:
            assert_never(node)


def _resolve_named(r: Resolution, node: ast.NamedType, context: Context) -> Type:
    name = node.name
    if name.actor is not None:
        behavior = resolve_behavior_name(r, name, context)
        return BehaviorType(behavior) if behavior else ERROR
    if name.name.namespace is None and name.name.text in PRIMITIVES:
        return PRIMITIVES[name.name.text]
    symbol = resolve_type_name(r, name.name, context)
    return type_of_symbol(symbol) if symbol else ERROR


def _resolve_list(r: Resolution, node: ast.ListType, context: Context) -> Type:
    element = resolve_type(r, node.element, context)
    return ERROR if element == ERROR else ListType(element)


def _resolve_range(r: Resolution, node: ast.RangeType, context: Context) -> Type:
    if node.span.text.startswith("range"):  # otherwise a remnant of a syntax error
        r.needs_standard(node.span, "the type `range of`")
    element = resolve_type(r, node.element, context)
    match element:
        case PhysicalType():
            return RangeType(element)
        case PrimitiveType(name="int" | "uint" | "float"):
            return RangeType(element)
        case _:
            if element != ERROR:
                r.report("OSC310", node.element.span, f"`{element}` is not a numeric type")
            return ERROR


def resolve_type_name(r: Resolution, name: ast.Name, context: Context) -> NamedSymbol | None:
    """Return the type of a name; report it if there is none."""
    candidates = r.scope.types_named(name.text)
    symbol = choose(r, candidates, name, context)
    if symbol is not None:
        _note_prelude_type(r, symbol, name)
        r.references[name] = symbol
        return symbol
    if candidates:
        return None
    if standard := type_alias(r, name):
        symbol = resolve_type_name(r, standard, context)
        if symbol is not None:
            r.references[name] = symbol
        return symbol
    if report_unimported(r, name):
        return None
    if (model := undeclared_model(r, name)) is not None:
        r.references[name] = model
        return model
    if associated := r.scope.behaviors_named(name.text):
        r.report(
            "OSC202",
            name.span,
            f"no type `{name}`",
            help=f"name the behavior with its actor: `{associated[0].qualified_name}`",
        )
    elif r.scope.modifiers_named(name.text):
        r.report("OSC311", name.span, f"`{name}` is a modifier, not a type")
    else:
        known = [text for layer in r.scope.layers() for text in layer.types]
        advice = advise(r, "type", name, [*known, *PRIMITIVES])
        help_: Help = write_instead(name.span, TYPE_ALIASES.get(name.text))
        help_ = help_ or plain_word(name.span, TYPES) or advice["help"]
        r.report("OSC202", name.span, f"no type `{name}`", notes=advice["notes"], help=help_)
    return None


def _note_prelude_type(r: Resolution, symbol: NamedSymbol, name: ast.Name) -> None:
    if symbol.origin == "prelude" and r.scope.parent is not None:
        r.relaxes(
            "OSC610",
            name.span,
            f"type `{name}` belongs to dialect `{r.relaxations.dialect.name}`, "
            "not to the standard library",
            key=symbol.name,
        )


def choose(r: Resolution, candidates: Sequence[S], name: ast.Name, context: Context) -> S | None:
    """Return the candidate that a name means here; report why if there are some but none fits."""
    selected = r.scope.select(candidates, name, context)
    if len(selected) == 1:
        return selected[0]
    if selected:
        homes = [f"{symbol.namespace}::{symbol.name}" for symbol in selected]
        r.report(
            "OSC204",
            name.span,
            f"`{name}` is ambiguous",
            help=write_one_of(name.span, homes),
            labels=[label for s in selected for label in declared_here(s)],
        )
        return None
    return _report_invisible(r, candidates[0], name, context) if candidates else None


def _report_invisible(r: Resolution, found: S, name: ast.Name, context: Context) -> S:
    """Report a name of an unused namespace, and continue as if it were used.

    For the namespaces of the library this is one mistake for all names.
    """
    home = found.namespace
    key = f"{context.namespace} {home}"
    is_library = found.origin == "library"
    if not is_library or r.relaxations.is_new("OSC215", name.span.source.name, key):
        remedy = (
            f"export it from `{home}`: `export {found.name}`"
            if home in context.uses
            else f"`namespace {context.namespace} use {home}` above it"
        )
        qualified = f"{home}::{found.name}"
        r.report(
            "OSC215",
            name.span,
            f"`{name}` is not visible here: it is declared in namespace `{home}`",
            help=write(name.span, qualified, f"write `{qualified}`, or {remedy}"),
        )
    return found


def resolve_actor_name(r: Resolution, name: ast.Name, context: Context) -> ActorSymbol | None:
    """Return the actor type before the dot of a behavior name."""
    symbol = resolve_type_name(r, name, context)
    if symbol is None or isinstance(symbol, ActorSymbol):
        return symbol
    r.report(
        "OSC301",
        name.span,
        f"`{name}` is not an actor type",
        labels=declared_here(symbol),
    )
    return None


def resolve_behavior_name(
    r: Resolution, name: ast.BehaviorName, context: Context
) -> CallableBehavior | None:
    """Return the scenario or action of `[actor.]name`."""
    if name.actor is None:
        symbol = resolve_type_name(r, name.name, context)
        if symbol is None or isinstance(symbol, ScenarioSymbol | ActionSymbol):
            return symbol
        r.report("OSC211", name.span, f"`{name}` is not a scenario or action")
        return None
    actor = resolve_actor_name(r, name.actor, context)
    if actor is None:
        return None
    behavior = find_behavior(r, actor, name.name, context)
    if behavior is None:
        report_unknown_behavior(r, actor, name.name)
    else:
        r.references[name.name] = behavior
    return behavior


def find_behavior(
    r: Resolution, actor: ActorSymbol, name: ast.Name, context: Context
) -> CallableBehavior | None:
    """Return the behavior of that name of an actor type, the nearest in its ancestry."""
    fitting = [
        b
        for b in r.scope.behaviors_named(name.text)
        if b.actor is not None and is_subtype(actor, b.actor)
    ]
    if not fitting and (standard := behavior_alias(r, actor, name)):
        return find_behavior(r, actor, standard, context)
    visible = r.scope.select(fitting, name, context)
    if fitting and not visible:
        choose(r, fitting, name, context)
    best: CallableBehavior | None = None
    for behavior in visible or fitting:
        if best is None or _is_nearer(behavior, best):
            best = behavior
    return best


def _is_nearer(behavior: CallableBehavior, other: CallableBehavior) -> bool:
    return (
        behavior.actor is not None
        and other.actor is not None
        and behavior.actor is not other.actor
        and is_subtype(behavior.actor, other.actor)
    )


def report_modifier(r: Resolution, name: ast.Name) -> None:
    """Report a modifier that is invoked like an action."""
    help_ = f"end the line of the action with `with:`, and write `{name}(…)` indented below"
    r.report("OSC211", name.span, f"`{name}` is a modifier, not a behavior", help=help_)


def report_unknown_behavior(r: Resolution, actor: ActorSymbol, name: ast.Name) -> None:
    """Report that an actor type has no behavior of that name, with similar names."""
    elsewhere = [b for b in r.scope.behaviors_named(name.text) if b.actor is not None]
    ancestry = [(s.name, name.text) for s in supertypes(actor)]
    hint = next((PRELUDE_BEHAVIORS[key] for key in ancestry if key in PRELUDE_BEHAVIORS), None)
    if hint is not None:
        r.report(
            "OSC211",
            name.span,
            f"`{actor.name}` has no action `{name}` in the standard library",
            notes=[f"{hint.instead}; dialect `{hint.dialect}` has it"],
            help=f"check with `--dialect {hint.dialect}`",
            labels=declared_here(elsewhere[0], "for other actors") if elsewhere else (),
        )
    elif r.scope.modifiers_named(name.text):
        report_modifier(r, name)
    elif elsewhere:
        owner = elsewhere[0].actor
        kind = "action" if isinstance(elsewhere[0], ActionSymbol) else "scenario"
        r.report(
            "OSC211",
            name.span,
            f"`{actor.name}` has no {kind} `{name}`; it belongs to `{owner.name if owner else ''}`",
            labels=declared_here(elsewhere[0]),
        )
    else:
        known = {
            b.name
            for layer in r.scope.layers()
            for group in layer.behaviors.values()
            for b in group
            if b.actor is not None and is_subtype(actor, b.actor)
        }
        acts = sorted(known - {n.rpartition(".")[2] for n in catalogue().abstract})
        r.report(
            "OSC211",
            name.span,
            f"`{actor.name}` has no behavior `{name}`",
            help=write_instead(name.span, standard_behavior(actor, name))
            or (plain_word(name.span, BEHAVIORS) if BEHAVIORS.get(name.text) in known else None)
            or NO_BEHAVIORS.get(name.text)
            or name_meant(name.span, known)
            or one_of(f"declare it, `scenario {actor.name}.{name}:`; there are", acts)
            or f"declare it, `scenario {actor.name}.{name}:`; `osc2tx reference {actor.name}` "
            "lists the actions",
        )
