"""First half of the resolution pass: bases, actors, extensions, enum values, signatures.

Afterwards every symbol of the layer is complete except for the types of labels; nothing below
the level of declarations has been looked at. `check` does the rest.
"""

from __future__ import annotations

from collections.abc import Callable

from osc2tx.diagnostics.fixes import Help, insert_before
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.builtins import LIFE_CYCLE
from osc2tx.semantics.declarations.collect import Collector, report_duplicate
from osc2tx.semantics.declarations.enums import resolve_enum_values
from osc2tx.semantics.declarations.exports import resolve_exports
from osc2tx.semantics.declarations.extensions import apply_extension
from osc2tx.semantics.declarations.inheritance import check_inheritance
from osc2tx.semantics.declarations.physical import check_physical_types, resolve_unit
from osc2tx.semantics.declarations.resolve_types import (
    find_behavior,
    resolve_actor_name,
    resolve_behavior_name,
    resolve_type,
    resolve_type_name,
)
from osc2tx.semantics.names.member_lookup import find_member
from osc2tx.semantics.resolution import Resolution, declared_here
from osc2tx.semantics.scope import CallableBehavior, Context, base_of, supertypes
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    Member,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
    TypeSymbol,
)
from osc2tx.semantics.types import VOID, ActorType, StructType
from osc2tx.syntax import ast


def resolve_declarations(r: Resolution, collector: Collector) -> None:
    """Complete the symbols of the layer that the collector filled."""
    resolve_exports(r)
    for check in (_resolve_type_base, _resolve_actor, _resolve_behavior_base, resolve_unit):
        _for_each_symbol(r, check)
    check_physical_types(r)
    _check_behaviors_unique(r)
    _for_each_symbol(r, check_inheritance)
    for extension in r.scope.extensions:
        apply_extension(r, collector, extension)
    resolve_enum_values(r)
    owners = r.scope.own_types()
    for owner in owners:
        _resolve_members(r, owner)
    # Bases first: an overriding method takes the namespace of the overridden one.
    for owner in sorted(owners, key=lambda owner: len(list(supertypes(owner)))):
        for member in owner.members.values():
            _check_redefinition(r, owner, member)
    for symbol in r.scope.declared:
        if isinstance(symbol, FieldSymbol):
            _resolve_field(r, symbol)


def _for_each_symbol(r: Resolution, check: Callable[[Resolution, Symbol, Context], None]) -> None:
    for symbol in r.scope.declared:
        check(r, symbol, r.scope.contexts.get(r.scope.nodes[symbol], Context()))


def _resolve_actor(r: Resolution, symbol: Symbol, context: Context) -> None:
    if isinstance(symbol, ScenarioSymbol | ActionSymbol | ModifierSymbol):
        actor = symbol.node.name.actor
        if actor is not None:
            symbol.actor = resolve_actor_name(r, actor, context)


def _resolve_type_base(r: Resolution, symbol: Symbol, context: Context) -> None:
    match symbol, r.scope.nodes[symbol]:
        case StructSymbol(), ast.StructDeclaration(base=ast.Name() as name):
            struct = resolve_type_name(r, name, context)
            if isinstance(struct, StructSymbol):
                symbol.base = struct
            elif struct is not None:
                _report_kind(r, name, "struct")
        case ActorSymbol(), ast.ActorDeclaration(base=ast.Name() as name):
            actor = resolve_type_name(r, name, context)
            if isinstance(actor, ActorSymbol):
                symbol.base = actor
            elif actor is not None:
                _report_kind(r, name, "actor")
        case _:
            return


def _resolve_behavior_base(r: Resolution, symbol: Symbol, context: Context) -> None:
    match symbol:
        case ScenarioSymbol(node=ast.ScenarioDeclaration(base=ast.BehaviorName() as base)):
            scenario = resolve_behavior_name(r, base, context)
            if isinstance(scenario, ScenarioSymbol):
                symbol.base = scenario
            elif scenario is not None:
                _report_kind(r, base, "scenario")
        case ActionSymbol(node=ast.ActionDeclaration(base=ast.BehaviorName() as base)):
            action = resolve_behavior_name(r, base, context)
            if isinstance(action, ActionSymbol):
                symbol.base = action
                if action.origin == "user":
                    action.derived.append(symbol)
            elif action is not None:
                _report_kind(r, base, "action")
        case ModifierSymbol(node=ast.ModifierDeclaration(behavior=ast.BehaviorName() as name)):
            symbol.target = _modified_behavior(r, symbol, name, context)
        case _:
            return


def _modified_behavior(
    r: Resolution, modifier: ModifierSymbol, name: ast.BehaviorName, context: Context
) -> CallableBehavior | None:
    """Return the target of a modifier; a simple name prefers a behavior of its actor."""
    if name.actor is None and modifier.actor is not None:
        behavior = find_behavior(r, modifier.actor, name.name, context)
        if behavior is not None:
            r.references[name.name] = behavior
            return behavior
    return resolve_behavior_name(r, name, context)


def _report_kind(r: Resolution, name: ast.Name | ast.BehaviorName, kind: str) -> None:
    article = "an" if kind[0] == "a" else "a"
    r.report(
        "OSC306", name.span, f"`{name}` is not {article} {kind}, so no {kind} inherits from it"
    )


def _check_behaviors_unique(r: Resolution) -> None:
    seen: dict[tuple[str, str, ActorSymbol | None], Symbol] = {}
    for group in r.scope.behaviors.values():
        for symbol in group:
            key = (symbol.namespace, symbol.name, symbol.actor)
            if symbol.actor is not None and key in seen:
                report_duplicate(r.sink, symbol, seen[key])
            seen.setdefault(key, symbol)
    for name, modifiers in r.scope.modifiers.items():
        for index, modifier in enumerate(modifiers):
            for other in modifiers[:index]:
                same = (other.actor, other.target) == (modifier.actor, modifier.target)
                if same and other.namespace == modifier.namespace and name:
                    report_duplicate(r.sink, modifier, other)


def _resolve_members(r: Resolution, owner: TypeSymbol) -> None:
    """Resolve the types in the signatures of a type's own members."""
    _drop_redeclared_life_cycle(owner)
    for member in owner.members.values():
        _resolve_member(r, member)


def _drop_redeclared_life_cycle(owner: TypeSymbol) -> None:
    """Identify `event start` and the like with the predefined events (§7.3.10.3).

    An event with parameters or a specification is an event of the scenario itself, which overrides
    the predefined one (§7.3.10.2).
    """
    if isinstance(owner, ScenarioSymbol | ActionSymbol):
        for name in LIFE_CYCLE:
            member = owner.members.get(name)
            node = member.node if isinstance(member, EventSymbol) else None
            if node is not None and not node.parameters and node.specification is None:
                del owner.members[name]


def _resolve_member(r: Resolution, member: Member) -> None:
    match member:
        case FieldSymbol():
            _resolve_field(r, member)
        case EventSymbol(node=ast.EventDeclaration() as event):
            context = r.scope.context_of(event)
            _resolve_parameters(r, member.parameters, event.parameters, context)
        case MethodSymbol(node=ast.MethodDeclaration() as method):
            context = r.scope.context_of(method)
            _resolve_parameters(r, member.parameters, method.parameters, context)
            member.result = resolve_type(r, method.result, context) if method.result else VOID
        case _:
            return


def _resolve_field(r: Resolution, symbol: FieldSymbol) -> None:
    if symbol.node is None:
        return
    first = symbol.node.names[0].span == symbol.span
    if first or symbol.node.type not in r.types:
        r.types[symbol.node.type] = resolve_type(
            r, symbol.node.type, r.scope.context_of(symbol.node)
        )
    symbol.type = r.types[symbol.node.type]
    if isinstance(symbol.type, ActorType | StructType) and isinstance(
        symbol.node, ast.ParameterDeclaration
    ):
        own = (c for c in symbol.node.constraints if isinstance(c, ast.KeepConstraint))
        symbol.constraints = (*_constraints_of(symbol.type.symbol), *own)


def _constraints_of(type_: TypeSymbol) -> list[ast.KeepConstraint]:
    """Return the requirements of a type on its instances, those of its supertypes first."""
    ancestry = reversed(list(supertypes(type_)))
    return [s for t in ancestry for s in t.statements if isinstance(s, ast.KeepConstraint)]


def _resolve_parameters(
    r: Resolution,
    parameters: tuple[ParameterSymbol, ...],
    specifications: tuple[ast.ParameterSpecification, ...],
    context: Context,
) -> None:
    for parameter, specification in zip(parameters, specifications, strict=True):
        parameter.type = resolve_type(r, specification.type, context)


def _check_redefinition(r: Resolution, owner: TypeSymbol, member: Member) -> None:
    """Check a member against the inherited one of the same name (§7.3.7, §7.3.8)."""
    overrides = isinstance(member, MethodSymbol) and member.node is not None and member.node.is_only
    earlier = _extended_method(r, owner, member) or inherited_member(owner, member)
    if earlier is None and overrides:
        earlier = _overridden_elsewhere(r, owner, member)
    if earlier is None:
        if overrides:
            _warn_of_no_override(r, owner, member)
        return
    if isinstance(member, EventSymbol) and isinstance(earlier, EventSymbol):
        return
    if isinstance(member, MethodSymbol) and isinstance(earlier, MethodSymbol):
        if not overrides:
            r.report(
                "OSC319",
                member.span,
                f"`{member.name}` overrides a method without `only`",
                help=_with_only(member),
                labels=declared_here(earlier, "overridden here"),
            )
        elif _signature(member) != _signature(earlier):
            r.report(
                "OSC319",
                member.span,
                f"`{member.name}` differs in its signature from the method that it overrides",
                labels=declared_here(earlier, "overridden here"),
            )
        return
    if member.origin != "prelude" and not isinstance(member, LabelSymbol):
        report_duplicate(r.sink, member, earlier)


def _with_only(method: MethodSymbol) -> Help:
    help_ = "write `is only …`"
    node = method.node
    if not isinstance(node, ast.MethodDeclaration):
        return help_
    return insert_before(node.body.span, "only ", help_)


def _warn_of_no_override(r: Resolution, owner: TypeSymbol, member: Member) -> None:
    """Warn about an `only` that overrides nothing, where a method has nearly that name.

    The standard allows it (§7.3.7.2), so a text may use it for all its methods.
    """
    methods = [
        name
        for ancestor in supertypes(owner)
        for name, other in ancestor.members.items()
        if isinstance(other, MethodSymbol) and other is not member
    ]
    meant = name_meant(member.span, methods, 0.75)
    if meant is not None:
        what = f"`{member.name}` overrides nothing: no base of `{owner.name}` has such a method"
        r.report("OSC417", member.span, what, help=meant)


def _extended_method(r: Resolution, owner: TypeSymbol, member: Member) -> MethodSymbol | None:
    """Return the method of the same type that a method of an extension replaces."""
    earlier = r.scope.overridden.get(member) if isinstance(member, MethodSymbol) else None
    if earlier is not None:
        _resolve_member(r, earlier)
        if earlier.node in r.scope.contexts:  # else it was checked with the layer below
            _check_redefinition(r, owner, earlier)
    return earlier


def inherited_member(owner: TypeSymbol, member: Member) -> Member | None:
    """Return the member of the same name and namespace in a supertype."""
    for ancestor in supertypes(owner):
        if ancestor is owner:
            continue
        earlier = ancestor.members.get(member.name)
        if earlier is not None and earlier.namespace == member.namespace:
            return earlier
    return None


def _overridden_elsewhere(r: Resolution, owner: TypeSymbol, member: Member) -> Member | None:
    """Return the method of a used namespace that is overridden; its name is the same name."""
    base = base_of(owner)
    if base is None or not isinstance(member, MethodSymbol) or member.node is None:
        return None
    context = r.scope.context_of(member.node)
    earlier = find_member(r, base, member.node.name, context, quiet=True)
    visible = isinstance(earlier, MethodSymbol) and r.scope.select(
        [earlier], member.node.name, context
    )
    if earlier is None or not visible:
        return None
    member.namespace = earlier.namespace
    return earlier


def _signature(method: MethodSymbol) -> tuple[object, ...]:
    return (method.result, *((p.name, p.type) for p in method.parameters))
