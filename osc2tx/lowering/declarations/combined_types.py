"""Objects that are of several conditional types, none of which derives from another (§7.3.15)."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.declarations.user_fields import TypeSymbol
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import is_subtype, supertypes


def most_special(types: Iterable[TypeSymbol]) -> tuple[TypeSymbol, ...]:
    """Return the types from which no other one derives, in source order."""
    found = tuple(dict.fromkeys(types))
    last = [t for t in found if not any(t is not o and is_subtype(o, t) for o in found)]
    return tuple(sorted(last, key=lambda type_: (type_.span.source.name, type_.span.start)))


def shared_member(types: tuple[TypeSymbol, ...]) -> str | None:
    """Return the name of a member that two types declare apart from each other, if there is one."""
    owners: dict[str, TypeSymbol] = {}
    for type_ in types:
        common = {t for other in types if other is not type_ for t in supertypes(other)}
        for each in supertypes(type_):
            for name in () if each in common else each.members:
                if owners.setdefault(name, type_) is not type_:
                    return name
    return None


def lineage(*types: TypeSymbol) -> tuple[str, ...]:
    """Return the types of an object and their ancestors, most derived first.

    Their combination, which no file declares, comes before all of them.
    """
    names = ir.merged([tuple(each.name for each in supertypes(type_)) for type_ in types])
    return names if len(types) == 1 else (_name(types), *names)


def add_types(ctx: LoweringContext, types: tuple[TypeSymbol, ...], span: Span) -> None:
    """Note the types of an object, for the classes of the module."""
    ctx.used.types.extend(types)
    if len(types) > 1:
        combined = ir.UserType(
            name=_name(types),
            span=span,
            bases=tuple(type_.name for type_ in types),
            is_actor=isinstance(types[0], sym.ActorSymbol),
            fields=(),
        )
        ctx.used.combined.setdefault(combined.name, combined)


def _name(types: tuple[TypeSymbol, ...]) -> str:
    return "_and_".join(type_.name for type_ in types)
