"""Bare names, `it` and enum members."""

from __future__ import annotations

from osc2tx.diagnostics.fixes import Help, write, write_one_of
from osc2tx.diagnostics.suggestions import name_meant, nearest, one_of
from osc2tx.semantics.conversions import convertible_type, converts, symbol_of, type_of_owner
from osc2tx.semantics.declarations.resolve_types import choose, resolve_type_name
from osc2tx.semantics.dialects import ENUM_MEMBER_ALIASES
from osc2tx.semantics.expressions.type_receivers import type_as_receiver
from osc2tx.semantics.names.actors_by_name import actor_of_caller
from osc2tx.semantics.names.aliases import enum_member_alias, write_instead
from osc2tx.semantics.names.colloquial_names import ENUM_MEMBERS, NAMES, NOTHING, plain_word
from osc2tx.semantics.names.member_lookup import find_member, lookup_value, visible_names
from osc2tx.semantics.names.unknown_names import in_newest_version
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.symbols import (
    EnumMemberSymbol,
    EnumSymbol,
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    MethodSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    Symbol,
)
from osc2tx.semantics.types import ERROR, EVENT, OBJECT, EnumType, ListType, RangeType, Type
from osc2tx.syntax import ast


def infer_name(
    r: Resolution, node: ast.NameExpression, env: Environment, expected: Type | None
) -> Type:
    """Type a bare name; an enum member needs an expected enum type."""
    member = enum_member_of(node.name, expected) or _member_by_alias(r, node.name, expected)
    symbol = lookup_value(r, node.name, env, quiet=member is not None)
    if member is not None and (symbol is None or not _has_type(symbol, expected)):
        return _refer_to_member(r, node, member, env)
    if symbol is None:
        symbol = _lookup_in_invoked(r, node, env)
    if symbol is None and expected == OBJECT:
        receiver = type_as_receiver(r, node, env)
        if receiver is not None:
            return receiver
    if symbol is None and env.owner is not None:
        symbol = actor_of_caller(r, node.name, env)
    if symbol is None:
        return _infer_unknown(r, node, env, expected)
    r.references[node] = symbol
    return value_type(r, symbol, node)


def _refer_to_member(
    r: Resolution, node: ast.NameExpression, member: EnumMemberSymbol, env: Environment
) -> Type:
    """Take a bare name for an enum member; its namespace has to offer it here (§7.7.4.2)."""
    if member.origin != "builtin":
        choose(r, [member], node.name, env.context)
    r.references[node] = member
    return EnumType(member.enum)


def _has_type(symbol: Symbol, expected: Type | None) -> bool:
    if not isinstance(symbol, FieldSymbol | ParameterSymbol | LabelSymbol) or expected is None:
        return False
    return converts(symbol.type, expected)


def enum_member_of(name: ast.Name, expected: Type | None) -> EnumMemberSymbol | None:
    """Return the member of that name of the expected enum type."""
    if isinstance(expected, ListType | RangeType):
        expected = expected.element
    expected = expected and (convertible_type(expected) or expected)
    if isinstance(expected, EnumType):
        return expected.symbol.members.get(name.text)
    return None


def _member_by_alias(
    r: Resolution, name: ast.Name, expected: Type | None
) -> EnumMemberSymbol | None:
    if not isinstance(expected, EnumType):
        return None
    standard = enum_member_alias(r, expected.symbol, name)
    return enum_member_of(standard, expected) if standard else None


def value_type(r: Resolution, symbol: Symbol, node: ast.Expression) -> Type:
    """Return the type of a name or path; report one that is not a value."""
    match symbol:
        case FieldSymbol() | ParameterSymbol() | LabelSymbol():
            return symbol.type
        case EventSymbol():
            return EVENT
        case EnumMemberSymbol():
            return EnumType(symbol.enum)
        case MethodSymbol():
            r.report(
                "OSC316",
                node.span,
                f"`{symbol.name}` is a method, not a value",
                help=f"call it: `{node.span.text}(…)`",
                labels=declared_here(symbol),
            )
            return ERROR
        case _:
            r.report("OSC316", node.span, f"`{symbol.name}` does not denote a value")
            return ERROR


def _lookup_in_invoked(r: Resolution, node: ast.NameExpression, env: Environment) -> Symbol | None:
    """Look in the invoked behavior, which a plain name may only mean with a warning."""
    if env.invoked is None:
        return None
    symbol = find_member(r, env.invoked, node.name, env.context)
    if isinstance(symbol, FieldSymbol):
        r.report(
            "OSC413",
            node.span,
            f"`{node.name}` is taken as parameter of `{env.invoked.qualified_name}`",
            help=write(node.span, f"it.{node.name}"),
        )
        return symbol
    return None


def _infer_unknown(
    r: Resolution, node: ast.NameExpression, env: Environment, expected: Type | None
) -> Type:
    name = node.name
    members = [] if expected == OBJECT else r.scope.enum_members_named(name.text)
    members = [m for m in members if r.scope.select([m], name, env.context)] or members
    if isinstance(expected, EnumType):
        r.report(
            "OSC208",
            node.span,
            f"enum `{expected.symbol.name}` has no member `{name}`",
            help=write_instead(
                name.span, ENUM_MEMBER_ALIASES.get((expected.symbol.name, name.text))
            )
            or _member_meant(r, name, expected.symbol),
            labels=declared_here(expected.symbol),
        )
        return ERROR
    if members and expected == ERROR:
        return ERROR
    if members and expected is None:
        return _infer_unexpected_member(r, node, members, env)
    if members and symbol_of(expected or ERROR) is None:
        return _refer_to_member(r, node, members[0], env)
    if types := r.scope.select(r.scope.types_named(name.text), name, env.context):
        r.report(
            "OSC316",
            node.span,
            f"`{name}` is a type, not a value",
            labels=declared_here(types[0]) if types[0].origin == "user" else (),
        )
        return ERROR
    base = env.owner.base if isinstance(env.owner, ScenarioSymbol) else None
    r.report(
        "OSC201",
        node.span,
        f"`{name}` is not defined",
        help=_name_meant(r, name, env),
        labels=declared_here(base, f"no `{name}` is inherited from here") if base else (),
    )
    return ERROR


def _name_meant(r: Resolution, name: ast.Name, env: Environment) -> Help:
    """Return the help for a name that is not defined."""
    if name.text in NOTHING:
        return "there is no empty value; omit arguments and members without a value"
    inherits = isinstance(env.owner, ScenarioSymbol) and env.owner.base is not None
    elsewhere = None if inherits else _field_elsewhere(r, name)
    if found := plain_word(name.span, NAMES) or elsewhere:
        return found
    meant = nearest(name.text, visible_names(r, env))
    if meant is None:
        return None
    help_ = f"did you mean `{meant}`?"
    field = lookup_value(r, ast.Name(span=name.span, text=meant), env, quiet=True)
    digits = "0123456789"
    if isinstance(field, FieldSymbol) and name.text.rstrip(digits) == meant.rstrip(digits):
        help_ += f" If it is another one, declare it: `{name}: {field.type}`"
    return write(name.span, meant, help_, is_safe=False)


def _member_meant(r: Resolution, name: ast.Name, enum: EnumSymbol) -> Help:
    """Return the help for an unknown member of an enum."""
    if enum.origin != "user" and (newer := in_newest_version(r, enum.name, name)):
        return newer
    if ENUM_MEMBERS.get(name.text) in enum.members:
        return plain_word(name.span, ENUM_MEMBERS)
    return name_meant(name.span, enum.members) or one_of("its members are", enum.members)


def _field_elsewhere(r: Resolution, name: ast.Name) -> str | None:
    """Return a line of help if another scenario of the program has a field of that name."""
    for symbol in r.scope.declared:
        if isinstance(symbol, ScenarioSymbol):
            field = symbol.members.get(name.text)
            if isinstance(field, FieldSymbol) and field.node is not None:
                return f"`{name}` is a field of `{symbol.qualified_name}`; pass it as an argument"
    return None


def _infer_unexpected_member(
    r: Resolution, node: ast.NameExpression, members: list[EnumMemberSymbol], env: Environment
) -> Type:
    if len(members) == 1:
        return _refer_to_member(r, node, members[0], env)
    choices = [f"{member.enum.name}!{member.name}" for member in members[:4]]
    r.report(
        "OSC313",
        node.span,
        f"`{node.name}` is a member of several enums",
        help=write_one_of(node.span, choices),
    )
    return ERROR


def infer_it(r: Resolution, node: ast.ItExpression, env: Environment) -> Type:
    """Type `it` (§7.4.1.3)."""
    if env.it is not None:
        return env.it
    if env.owner is not None:
        return type_of_owner(env.owner)
    r.report("OSC201", node.span, "there is no `it` here")
    return ERROR


def infer_enum_literal(r: Resolution, node: ast.EnumLiteral, env: Environment) -> Type:
    """Type `enum!member`."""
    symbol = resolve_type_name(r, node.enum, env.context)
    if symbol is None:
        return ERROR
    if not isinstance(symbol, EnumSymbol):
        r.report("OSC301", node.enum.span, f"`{node.enum}` is not an enum")
        return ERROR
    member = symbol.members.get(node.member.text)
    if member is None:
        r.report(
            "OSC208",
            node.member.span,
            f"enum `{symbol.name}` has no member `{node.member}`",
            help=_member_meant(r, node.member, symbol),
            labels=declared_here(symbol),
        )
        return EnumType(symbol)
    r.references[node] = member
    r.references[node.member] = member
    return EnumType(symbol)
