"""Fields that the scenario's files give to actors and structs: to their own, and to the library's.

A class has the fields that have a default or that some text mentions. The default is part of the
class if it needs nothing else; one that reads other fields or globals belongs to each object.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias, TypeGuard

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.value_types import PLAIN, lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.bodies.coverage_items import items_of
from osc2tx.semantics.model import SemanticModel
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast

TypeSymbol: TypeAlias = sym.ActorSymbol | sym.StructSymbol

# Reads that exclude an expression as the default of a class.
_OF_OBJECTS = (ir.FieldRef, ir.ParameterRef, ir.ScenarioSelf)


def mentioned_fields(model: SemanticModel) -> Mapping[sym.FieldSymbol, frozenset[str]]:
    """Return the fields that some expression of a program mentions, and the names of its files.

    Coverage items of an object mention it.
    """
    found: dict[sym.FieldSymbol, set[str]] = {}
    for node, symbol in model.references.items():
        if isinstance(symbol, sym.FieldSymbol) and isinstance(
            node, ast.NameExpression | ast.MemberAccess | ast.Name
        ):
            found.setdefault(symbol, set()).add(node.span.source.name)
    owners = (each for each in model.symbols if isinstance(each, sym.TypeSymbol))
    for member in (each for owner in owners for each in owner.members.values()):
        if isinstance(member, sym.FieldSymbol) and _is_sampled(member.type):
            found.setdefault(member, set()).add(member.span.source.name)
    return {symbol: frozenset(names) for symbol, names in found.items()}


def default_keeps(model: SemanticModel) -> Mapping[sym.FieldSymbol, ast.KeepConstraint]:
    """Return the constraints that give fields a default in their own type, `keep(default it == 3)`.

    The last one counts (§7.3.11.2).
    """
    found: dict[sym.FieldSymbol, ast.KeepConstraint] = {}
    for symbol in model.symbols:
        if not isinstance(symbol, sym.ActorSymbol | sym.StructSymbol):
            continue
        for statement in symbol.statements:
            if isinstance(statement, ast.KeepConstraint) and _is_default(statement):
                assert isinstance(statement.expression, ast.Binary)
                field = model.symbol_of(statement.expression.left)
                if isinstance(field, sym.FieldSymbol) and field.owner is symbol:
                    found[field] = statement
            elif isinstance(statement, ast.ParameterDeclaration):
                named = (each for name in statement.names for each in symbol.named(name.text))
                own = [field for field in named if isinstance(field, sym.FieldSymbol)]
                for keep in filter(_is_default, statement.constraints):
                    found.update((field, keep) for field in own if field.node is statement)
    return found


def _is_default(rule: ast.Statement) -> TypeGuard[ast.KeepConstraint]:
    """Whether a constraint gives a default to a name alone."""
    if not isinstance(rule, ast.KeepConstraint) or rule.strength is not ast.KeepStrength.DEFAULT:
        return False
    said = rule.expression
    if not isinstance(said, ast.Binary) or said.operator is not ast.BinaryOperator.EQUAL:
        return False
    return isinstance(said.left, ast.NameExpression | ast.ItExpression)


def _is_sampled(type_: types.Type) -> bool:
    """Whether objects of a type, or objects in them, have coverage items."""
    pending, seen = [type_], set[types.Type]()
    while pending:
        current = pending.pop()
        if current in seen or not isinstance(current, types.ActorType | types.StructType):
            continue
        seen.add(current)
        for each in supertypes(current.symbol):
            if any(True for _ in items_of(each)):
                return True
            fields = (m for m in each.members.values() if isinstance(m, sym.FieldSymbol))
            pending += [field.type for field in fields if each.origin == "user"]
    return False


def user_fields(ctx: LoweringContext, symbol: TypeSymbol) -> Iterator[sym.FieldSymbol]:
    """Yield the fields of an own type that its base does not have."""
    return (
        member
        for member in _fields(symbol)
        if _has_value(member) or member in ctx.program.mentioned
    )


def unused_fields(ctx: LoweringContext, symbol: TypeSymbol) -> Iterator[sym.FieldSymbol]:
    """Yield the fields that its class has as well, for other programs."""
    used = set(user_fields(ctx, symbol))
    return (member for member in _fields(symbol) if member not in used)


def is_optional(ctx: LoweringContext, field: sym.FieldSymbol) -> bool:
    """Whether nothing in its own file gives a field a value or reads it.

    That does not depend on the files that import the file.
    """
    home = field.span.source.name
    return not _has_value(field) and home not in ctx.program.mentioned.get(field, ())


def is_left_out(ctx: LoweringContext, symbol: TypeSymbol, field: sym.FieldSymbol) -> bool:
    """Whether objects of the present scenario do without a field of their class.

    Only files that the scenario does not import mention it: what a class of a scenario consists of
    does not depend on the files that import its file.
    """
    known = ctx.known_files
    is_whole = all(each.span.source.name in known for each in symbol.statements)
    mentioned = ctx.program.mentioned.get(field, frozenset())
    return is_whole and is_optional(ctx, field) and known.isdisjoint(mentioned)


def _fields(symbol: TypeSymbol) -> Iterator[sym.FieldSymbol]:
    for member in own_members(symbol):
        is_sampled = isinstance(member, sym.FieldSymbol) and isinstance(
            member.default, ast.SampleExpression
        )
        if isinstance(member, sym.FieldSymbol) and not is_sampled:
            yield member


def _has_value(field: sym.FieldSymbol) -> bool:
    return field.default is not None or bool(field.constraints)


def own_members(symbol: TypeSymbol) -> Iterator[sym.Member]:
    """Yield the members that the user's files give to a type, also by `extend` (§7.3.9)."""
    return (each for each in symbol.members.values() if each.origin == "user")


def has_added_fields(symbol: TypeSymbol) -> bool:
    """Whether a type of the library has fields that the user adds to it (§7.3.9)."""
    return symbol.is_extended and any(True for _ in _fields(symbol))


def user_bases(symbol: TypeSymbol) -> Iterator[TypeSymbol]:
    """Yield a type and its bases, up to the last one that has members of the user's.

    Types of the library between a user's type and an extended one are among them: each of their
    objects has the fields of the extended one.
    """
    chain: list[TypeSymbol] = []
    current: TypeSymbol | None = symbol
    while current is not None:
        chain.append(current)
        current = current.base
    while chain and chain[-1].origin != "user" and not has_added_fields(chain[-1]):
        chain.pop()
    yield from chain


def user_lineage(symbol: TypeSymbol) -> tuple[TypeSymbol, ...]:
    """Return the same types at once."""
    return tuple(user_bases(symbol))


def class_default(ctx: LoweringContext, field: sym.FieldSymbol) -> ir.Expression | None:
    """Return the default of a field if it is the same for all objects; `None` if not, or none.

    Lists and ranges belong to each object too: Python would share one list among all of them.
    """
    if stated_default(ctx, field) is None or not is_plain(field.type):
        return None
    lowered = object_default(
        ctx.quiet(), field, ir.ParameterRef(span=field.span, type=_OWNER, name="")
    )
    if lowered is None or isinstance(lowered, ir.RangeValue | ir.HalfRange):
        return None
    if any(isinstance(part, _OF_OBJECTS) for part in ir.walk(lowered)):
        return None
    return lowered


def object_default(
    ctx: LoweringContext, field: sym.FieldSymbol, owner: ir.Expression
) -> ir.Expression | None:
    """Return the default of a field of an object."""
    stated = stated_default(ctx, field)
    if stated is None:
        return None
    assert isinstance(field.owner, sym.ActorSymbol | sym.StructSymbol)
    inside = ctx.inside(Receiver(field.owner, owner))
    return lower_expression(inside, stated)


def stated_default(ctx: LoweringContext, field: sym.FieldSymbol) -> ast.Expression | None:
    """Return the default that a type states for a field of its own."""
    keep = ctx.program.default_keeps.get(field)
    if keep is not None:
        assert isinstance(keep.expression, ast.Binary)
        return keep.expression.right
    return None if isinstance(field.default, ast.SampleExpression) else field.default


def class_default_keep(ctx: LoweringContext, field: sym.FieldSymbol) -> ast.KeepConstraint | None:
    """Return the constraint that is the default of a field in its class, if it is one."""
    return None if class_default(ctx, field) is None else ctx.program.default_keeps.get(field)


def is_plain(type_: types.Type) -> bool:
    """Whether a setting of a run can give a value of a type."""
    return lower_type(type_).kind in PLAIN


_OWNER = ir.ValueType(ir.Kind.STRUCT, "owner")
