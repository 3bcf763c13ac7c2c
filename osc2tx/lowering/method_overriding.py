"""Which methods of subtypes override a method (§7.3.7), and which subtypes have objects."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.analysis import ConstraintAnalysis
from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import SemanticModel
from osc2tx.semantics.scope import is_subtype, supertypes


def object_types(model: SemanticModel, analysis: ConstraintAnalysis) -> tuple[sym.TypeSymbol, ...]:
    """Return the types of which a program may have objects, those of fields first."""
    owners = (symbol for symbol in model.symbols if isinstance(symbol, sym.TypeSymbol))
    fields = (member for owner in owners for member in owner.members.values())
    declared = (type_ for field in fields for type_ in _types(field))
    by_condition = (
        special
        for constraints in analysis.types.values()
        for types_ in constraints.special.values()
        for special in types_
    )
    return tuple(dict.fromkeys((*declared, *by_condition)))


def _types(member: sym.Member) -> Iterator[sym.TypeSymbol]:
    type_ = member.type if isinstance(member, sym.FieldSymbol) else None
    while isinstance(type_, types.ListType):
        type_ = type_.element
    if isinstance(type_, types.ActorType | types.StructType):
        yield type_.symbol


def overriding_methods(
    ctx: LoweringContext, method: sym.MethodSymbol
) -> tuple[sym.MethodSymbol, ...]:
    """Return the methods of subtypes that stand for a method, the most special types first.

    Only types of which the program has objects count.
    """
    owner = method.owner
    if not isinstance(owner, sym.ActorSymbol | sym.StructSymbol):
        return ()
    used = (t for object_ in ctx.object_types for t in supertypes(object_))
    below = [t for t in dict.fromkeys(used) if t is not owner and is_subtype(t, owner)]
    below.sort(key=lambda type_: -len(list(supertypes(type_))))
    found = (type_.members.get(method.name) for type_ in below)
    return tuple(each for each in found if isinstance(each, sym.MethodSymbol))
