"""Member access, conversion, type test and indexing."""

from __future__ import annotations

from osc2tx.diagnostics.fixes import insert
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.bodies.binding import find_parameter
from osc2tx.semantics.builtins import COMPOSITION, LIST_METHODS, RANGE_METHODS
from osc2tx.semantics.conversions import INTEGERS, are_related, can_cast, symbol_of
from osc2tx.semantics.declarations.resolve_types import resolve_type
from osc2tx.semantics.dialects import PRELUDE_MEMBERS
from osc2tx.semantics.expressions.names import value_type
from osc2tx.semantics.names.aliases import member_alias, standard_member, write_instead
from osc2tx.semantics.names.colloquial_names import MEMBERS, plain_word
from osc2tx.semantics.names.member_lookup import find_member, member_names
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import LabelSymbol, Member, Symbol, TypeSymbol
from osc2tx.semantics.types import BOOL, ERROR, EVENT, OBJECT, ListType, RangeType, Type
from osc2tx.syntax import ast


def infer_member(r: Resolution, node: ast.MemberAccess, env: Environment) -> Type:
    """Type `base.name`."""
    base = r.type_of(node.base, env, OBJECT)
    if base == EVENT:
        return _infer_event_parameter(r, node, env)
    symbol = resolve_member(r, node, base, env)
    if symbol is None:
        return ERROR
    return value_type(r, symbol, node)


def resolve_member(
    r: Resolution, node: ast.MemberAccess, base: Type, env: Environment
) -> Member | None:
    """Return the member that `base.name` names; report it if there is none."""
    if base == ERROR:
        return None
    owner = symbol_of(base)
    if owner is None:
        is_method = isinstance(base, ListType) and node.name.text in LIST_METHODS
        is_method |= isinstance(base, RangeType) and node.name.text in RANGE_METHODS
        call = f"it is a method: write `{node.span.text}()`"
        help_ = insert(node.span, "()", call) if is_method else None
        r.report("OSC208", node.name.span, f"`{base}` has no member `{node.name}`", help=help_)
        return None
    member = _labelled_inside(r, node, owner) or find_member(r, owner, node.name, env.context)
    if member is None and (standard := member_alias(r, owner, node.name)):
        member = find_member(r, owner, standard, env.context)
    if member is None:
        report_unknown_member(r, owner, node.name)
        return None
    r.references[node] = member
    note_prelude_member(r, member, owner, node.name)
    return member


def _labelled_inside(r: Resolution, node: ast.MemberAccess, owner: TypeSymbol) -> Member | None:
    """Return a member that has a label inside a labelled composition, `phase.cut`."""
    around = r.references.get(node.base)
    if owner is not COMPOSITION or not isinstance(around, LabelSymbol):
        return None
    inside = around.owner.members.get(node.name.text)
    if not isinstance(inside, LabelSymbol) or inside is around:
        return None
    extent = around.node.span
    return inside if extent.start <= inside.span.start < extent.end else None


def note_prelude_member(r: Resolution, member: Symbol, owner: TypeSymbol, name: ast.Name) -> None:
    """Warn about a member that the prelude of the dialect declares."""
    if member.origin == "prelude" and owner.origin != "prelude":
        r.relaxes(
            "OSC607",
            name.span,
            f"`{member.name}` of `{owner.name}` belongs to dialect "
            f"`{r.relaxations.dialect.name}`, not to the standard library",
            key=member.name,
        )


def report_unknown_member(r: Resolution, owner: TypeSymbol, name: ast.Name) -> None:
    """Report a member that a type does not have."""
    hint = PRELUDE_MEMBERS.get(name.text)
    is_object = any(s.name == "osc_actor" for s in supertypes(owner))
    if hint is not None and is_object:
        r.report(
            "OSC208",
            name.span,
            f"`{owner.name}` has no member `{name}` in the standard library",
            notes=[f"{hint.instead}; dialect `{hint.dialect}` has it"],
            help=f"check with `--dialect {hint.dialect}`",
        )
        return
    r.report(
        "OSC208",
        name.span,
        f"`{owner.name}` has no member `{name}`",
        help=write_instead(name.span, standard_member(owner, name))
        or (plain_word(name.span, MEMBERS) if is_object else None)
        or name_meant(name.span, member_names(owner)),
        labels=declared_here(owner),
    )


def _infer_event_parameter(r: Resolution, node: ast.MemberAccess, env: Environment) -> Type:
    field = r.references.get(node.base)
    event = r.event_fields.get(field) if field is not None else None
    if event is None:
        r.report("OSC316", node.base.span, "an event has no value; bind it with `as`")
        return ERROR
    parameter = find_parameter(r, node.name, event.parameters, env)
    if parameter is not None:
        r.references[node] = parameter
        return parameter.type
    r.report(
        "OSC208",
        node.name.span,
        f"event `{event.name}` has no parameter `{node.name}`",
        help=name_meant(node.name.span, [p.name for p in event.parameters]),
    )
    return ERROR


def infer_cast(r: Resolution, node: ast.Cast, env: Environment) -> Type:
    """Type `base.as(T)`."""
    target = resolve_type(r, node.type, env.context)
    source = r.type_of(node.base, env, target)
    if ERROR not in (source, target) and not can_cast(source, target):
        r.report("OSC315", node.span, f"a value of `{source}` cannot be converted to `{target}`")
    return target


def infer_type_test(r: Resolution, node: ast.TypeTest, env: Environment) -> Type:
    """Type `base.is(T)`."""
    r.types[node.type] = target = resolve_type(r, node.type, env.context)
    source = r.type_of(node.base, env)
    if ERROR not in (source, target) and not are_related(source, target):
        r.report("OSC315", node.span, f"a value of `{source}` is never `{target}`")
    return BOOL


def infer_index(r: Resolution, node: ast.Index, env: Environment) -> Type:
    """Type `base[index]`."""
    base = r.type_of(node.base, env)
    index = r.type_of(node.index, env)
    if index != ERROR and index not in INTEGERS:
        r.report("OSC301", node.index.span, f"an index must be an integer, not `{index}`")
    if base == ERROR:
        return ERROR
    if not isinstance(base, ListType):
        r.report("OSC304", node.base.span, f"`{base}` cannot be indexed; it is not a list")
        return ERROR
    return base.element
