"""Objects of a scenario, actors and structs: what constraints fix about them."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.analysis.locate import name_of
from osc2tx.diagnostics import Span
from osc2tx.lowering.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.expressions import lower_type
from osc2tx.lowering.own_types import PLAIN
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.scope import supertypes


class ObjectLowering:
    """Lowers the values of the objects of one scenario.

    Args:
        ctx: The checked program.
        constraints: What its constraints say.
    """

    def __init__(self, ctx: LoweringContext, constraints: ConstraintLowering) -> None:
        """See the class."""
        self._ctx = ctx
        self._constraints = constraints

    def struct(
        self, field: sym.FieldSymbol, span: Span, comments: tuple[str, ...], names: tuple[str, ...]
    ) -> ir.Struct | None:
        """Lower a value of a struct type: a whole value, or values of its fields."""
        whole = self._constraints.setting((field,), field.type)
        values = self.values(field)
        if whole.value is not None:
            for value in values:
                self._ctx.unsupported(
                    "OSC502", value.span, f"`{field.name}` is a whole value already"
                )
            if ir.is_live(whole.value):
                self._ctx.unsupported(
                    "OSC502",
                    whole.value.span,
                    f"`{field.name}` cannot depend on the state of the world",
                    help="write the expression where it is needed",
                )
                return None
        return ir.Struct(
            name=field.name,
            span=span,
            comments=(*comments, *whole.comments),
            type=names[0],
            values=values,
            value=whole.value,
            lineage=names,
        )

    def is_said(self, field: sym.FieldSymbol) -> bool:
        """Whether a constraint speaks of a member of an object."""
        return any(key[0] is field and len(key) > 1 for key in self._constraints.found.by_key)

    def values(self, field: sym.FieldSymbol) -> tuple[ir.FieldValue, ...]:
        """Return what the constraints fix about an object; what they bound can be set."""
        values = []
        for key, setting in self._constraints.members(field):
            path = tuple(name_of((member,)) for member in key[1:])
            value = setting.value
            if value is None and setting.domain is not None:
                type_ = lower_type(key[-1].type) if isinstance(key[-1], sym.FieldSymbol) else None
                value = self._ctx.draw(name_of(key), setting.domain, type_ or setting.domain.type)
            if value is not None and not _is_own_default(key[-1], value):
                values.append(
                    ir.FieldValue(
                        path=path, value=value, span=value.span, comments=setting.comments
                    )
                )
        self._require_removed(field)
        return tuple(values)

    def _require_removed(self, field: sym.FieldSymbol) -> None:
        """Report members of an object whose default was removed and that got no other value."""
        for member in _with_default(field.type):
            if (field, member) in self._constraints.found.by_key:
                continue
            self._ctx.unsupported(
                "OSC501",
                field.span,
                f"`{field.name}` does not say its `{member.name}`, whose default was removed",
                help=f"`keep({field.name}.{member.name} == value)`",
            )


def _with_default(type_: types.Type) -> Iterator[sym.FieldSymbol]:
    """Yield the plain members of a type of the user's that have a default."""
    if not isinstance(type_, types.ActorType | types.StructType):
        return
    for ancestor in supertypes(type_.symbol):
        for member in ancestor.members.values() if ancestor.origin == "user" else ():
            if not isinstance(member, sym.FieldSymbol) or member.is_variable:
                continue
            if member.default is not None and lower_type(member.type).kind in PLAIN:
                yield member


def _is_own_default(member: object, value: ir.Expression) -> bool:
    """Whether a value is the default that the class of a type of the user's has anyway."""
    return (
        isinstance(member, sym.FieldSymbol)
        and member.origin == "user"
        and member.default is not None
        and member.default.span == value.span
    )


def lineage(type_: sym.ActorSymbol | sym.StructSymbol) -> tuple[str, ...]:
    """Return a type and its ancestors, most derived first."""
    names = []
    current: sym.ActorSymbol | sym.StructSymbol | None = type_
    while current is not None:
        names.append(current.name)
        current = current.base
    return tuple(names)
