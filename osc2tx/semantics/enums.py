"""Values of enum members (§7.3.3)."""

from __future__ import annotations

from osc2tx.semantics.resolution import Resolution, did_you_mean
from osc2tx.semantics.resolve_types import resolve_type_name
from osc2tx.semantics.scope import Context
from osc2tx.semantics.symbols import EnumMemberSymbol, EnumSymbol
from osc2tx.syntax import ast


def resolve_enum_values(r: Resolution) -> None:
    """Count the members of every enum of the layer, extensions included."""
    pending: dict[EnumMemberSymbol, EnumMemberSymbol] = {}
    for symbol in (*r.scope.declared, *r.scope.extended):
        if isinstance(symbol, EnumSymbol):
            _count(r, symbol, pending)
    for member in pending:
        _follow(r, member, pending)


def _count(
    r: Resolution, symbol: EnumSymbol, pending: dict[EnumMemberSymbol, EnumMemberSymbol]
) -> None:
    following = 0
    for member in symbol.members.values():
        node = r.scope.enum_node(member)
        value = node.value if node else None
        match value:
            case None:
                member.value = following
                following += 1
            case int():
                member.value = value
                following = value + 1
            case ast.EnumLiteral() | ast.NameExpression():
                if member in r.scope.enum_nodes:
                    r.needs_standard(value.span, "a reference as value of an enum member")
                target = _target(r, symbol, value)
                if target is not None:
                    pending[member] = target


def _target(
    r: Resolution, symbol: EnumSymbol, value: ast.EnumLiteral | ast.NameExpression
) -> EnumMemberSymbol | None:
    enum: object = symbol
    name = value.name if isinstance(value, ast.NameExpression) else value.member
    if isinstance(value, ast.EnumLiteral):
        node = r.scope.nodes.get(symbol)
        context = r.scope.contexts.get(node, Context()) if node else Context()
        enum = resolve_type_name(r, value.enum, context)
    if not isinstance(enum, EnumSymbol):
        return None
    target = enum.members.get(name.text)
    if target is None:
        r.report(
            "OSC208",
            name.span,
            f"enum `{enum.name}` has no member `{name}`",
            help=did_you_mean(name.text, enum.members),
        )
        return None
    r.references[value] = target
    return target


def _follow(
    r: Resolution,
    member: EnumMemberSymbol,
    pending: dict[EnumMemberSymbol, EnumMemberSymbol],
) -> None:
    seen = {member}
    target = pending[member]
    while target in pending:
        if target in seen:
            r.report("OSC312", member.span, f"the value of `{member.name}` depends on itself")
            return
        seen.add(target)
        target = pending[target]
    member.value = target.value
