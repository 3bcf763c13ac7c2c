"""Values of enum members (§7.3.3)."""

from __future__ import annotations

from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx.semantics.declarations.resolve_types import resolve_type_name
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import Context
from osc2tx.semantics.symbols import EnumMemberSymbol, EnumSymbol
from osc2tx.syntax import ast


def resolve_enum_values(r: Resolution) -> None:
    """Count the members of every enum of the layer, extensions included."""
    pending: dict[EnumMemberSymbol, EnumMemberSymbol] = {}
    for symbol in (*r.scope.declared, *r.scope.extended):
        if isinstance(symbol, EnumSymbol):
            _count(r, symbol, pending)
    done: set[EnumMemberSymbol] = set()
    for member in pending:
        _follow(r, member, pending, done)


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
    done: set[EnumMemberSymbol],
) -> None:
    """Take over the value at the end of a chain of references, for all of the chain."""
    chain: dict[EnumMemberSymbol, None] = {}
    current = member
    while current in pending and current not in done and current not in chain:
        chain[current] = None
        current = pending[current]
    if current in chain:
        r.report("OSC312", current.span, f"the value of `{current.name}` depends on itself")
    for link in chain:
        link.value = current.value
    done.update(chain)
