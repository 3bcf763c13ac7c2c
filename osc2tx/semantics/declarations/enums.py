"""Values of enum members (§7.3.3)."""

from __future__ import annotations

from osc2tx.diagnostics.fixes import write_one_of
from osc2tx.diagnostics.suggestions import name_meant
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
                target = _target(r, symbol, value, member)
                if target is not None:
                    pending[member] = target


def _target(
    r: Resolution,
    symbol: EnumSymbol,
    value: ast.EnumLiteral | ast.NameExpression,
    member: EnumMemberSymbol,
) -> EnumMemberSymbol | None:
    """Return the member whose value another member takes: of its enum, or of any (§7.3.3)."""
    node = r.scope.enum_node(member)
    context = Context() if node is None else r.scope.context_of(node)
    if isinstance(value, ast.EnumLiteral):
        enum = resolve_type_name(r, value.enum, context)
        if not isinstance(enum, EnumSymbol):
            return None
        found = [enum.members[value.member.text]] if value.member.text in enum.members else []
        name, where, known = value.member, f"enum `{enum.name}` has", list(enum.members)
    else:
        name, where, known = value.name, "no enum has a member", list(symbol.members)
        found = [symbol.members[name.text]] if name.text in symbol.members else []
        found = found or r.scope.select(r.scope.enum_members_named(name.text), name, context)
    if len(found) > 1:
        choices = [f"{each.enum.name}!{name}" for each in found]
        message = f"`{name}` is a member of several enums"
        r.report("OSC313", name.span, message, help=write_one_of(name.span, choices))
        return None
    if not found:
        message = f"{where} no member `{name}`" if where.endswith("has") else f"{where} `{name}`"
        r.report("OSC208", name.span, message, help=name_meant(name.span, known))
        return None
    r.references[value] = found[0]
    return found[0]


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
