"""Reports members of types that modules do not support.

Members of a type are mostly reported where they are used: fields and constraints by the objects,
methods by their calls, events by waits for them. The rest has to be searched.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Set

from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.types import ActorType, StructType
from osc2tx.syntax import ast


def report_unsupported_members(ctx: LoweringContext, scenarios: Iterable[sym.TypeSymbol]) -> None:
    """Report members of types in use that would have no effect, each of them once.

    Args:
        ctx: The lowered program.
        scenarios: Behaviors that the module has classes for.
    """
    found: dict[sym.TypeSymbol, None] = {}
    used: tuple[sym.TypeSymbol, ...] = (*ctx.used.types, *ctx.used.actions)
    for symbol in used:
        _add(symbol, found)
    for symbol in found:
        for statement in symbol.statements:
            _report(ctx, symbol, statement)
    owners = dict.fromkeys((*found, *(t for each in scenarios for t in supertypes(each))))
    namespaces: dict[str, set[str]] = {}
    for member in (each for owner in owners for each in owner.members.values()):
        namespaces.setdefault(member.name, set()).add(member.namespace)
    shared = {name for name, those in namespaces.items() if len(those) > 1}
    for owner in owners:
        _report_namesakes(ctx, owner, shared)


def _report_namesakes(ctx: LoweringContext, owner: sym.TypeSymbol, shared: Set[str]) -> None:
    """Report members that differ only in their namespaces: a class has one member per name."""
    for name in {m.name: None for m in owner.members.values() if m.name in shared}:
        lineage = reversed(list(supertypes(owner)))
        candidates = [each for ancestor in lineage for each in ancestor.named(name)]
        others = [each for each in candidates if each.namespace != candidates[0].namespace]
        for other in others:
            if other not in owner.named(name) or not _share_a_name(candidates[0], other):
                continue
            ctx.unsupported(
                "OSC501",
                other.span,
                f"another member of `{owner.name}` has the name `{name}`",
                help="names of members are unique in a type, across namespaces: rename one",
            )


def _share_a_name(one: sym.Member, other: sym.Member) -> bool:
    """Whether a module would take one for the other; methods of the library are functions of it."""
    is_method = isinstance(one, sym.MethodSymbol) and isinstance(other, sym.MethodSymbol)
    return other.origin == "user" and not (is_method and one.origin == "library")


def _add(symbol: sym.TypeSymbol, found: dict[sym.TypeSymbol, None]) -> None:
    """Add a type, those it inherits from, and those of its fields."""
    if symbol in found:
        return
    for ancestor in supertypes(symbol):
        if ancestor in found:
            continue
        found[ancestor] = None
        for field in ancestor.members.values():
            type_ = field.type if isinstance(field, sym.FieldSymbol) else None
            if field.origin == "user" and isinstance(type_, ActorType | StructType):
                _add(type_.symbol, found)


def _report(ctx: LoweringContext, owner: sym.TypeSymbol, statement: ast.Statement) -> None:
    if not isinstance(owner, sym.ActionSymbol):
        return
    for item in _items(statement):
        ctx.unsupported(
            "OSC501",
            item.span,
            f"`{item.kind}` in an action is not supported yet",
            help="sample it in the scenario, `cover(name, expression: object.member)`",
        )
    is_attached = owner.origin != "user" and isinstance(statement, ast.OnDirective)
    if isinstance(statement, ast.DoDirective | ast.OnDirective) and not is_attached:
        word = "do" if isinstance(statement, ast.DoDirective) else "on"
        ctx.unsupported(
            "OSC506",
            statement.span,
            f"`{word}` in an action is not executed: the runtime or a package implements actions",
            help=f"make it a scenario, `scenario {owner.qualified_name}`",
        )


def _items(statement: ast.Statement) -> Iterator[ast.CoverageDeclaration]:
    match statement:
        case ast.CoverageDeclaration():
            yield statement
        case ast.ParameterDeclaration(constraints=constraints):
            for constraint in constraints:
                if isinstance(constraint, ast.CoverageDeclaration):
                    yield constraint
