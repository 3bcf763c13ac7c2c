"""Owners of coverage items: a scenario, and the actors and structs in it (§7.5.2)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from osc2tx import ir
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.lowering.behavior.composed_behaviors import Composed
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.declarations.global_names import field_name
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.references import alias_of, member_of
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.bodies.coverage_items import Item, items_of
from osc2tx.semantics.scope import supertypes
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class CoverageOwner:
    """An instance with items.

    Attributes:
        ctx: For expressions in it.
        lineage: Its types, the most derived first.
        key: The instance; empty for the scenario.
        prefix: Prefix of the names of its items.
    """

    ctx: LoweringContext
    lineage: tuple[sym.TypeSymbol, ...]
    key: Key
    prefix: str

    def items(self) -> Iterator[Item]:
        """Yield its items, those of bases first."""
        for each in reversed(self.lineage):
            yield from items_of(each)

    def field(self, name: str) -> sym.FieldSymbol | None:
        """Return a field of it."""
        found = (each.members.get(name) for each in self.lineage)
        return next((each for each in found if isinstance(each, sym.FieldSymbol)), None)

    def value_of(self, field: sym.FieldSymbol, item: Item) -> ir.Expression:
        """Return the value of a field of it."""
        span, receiver = item.node.span, self.ctx.receiver
        if receiver is not None:
            return member_of(self.ctx, receiver.value, field, span)
        return ir.FieldRef(span=span, type=lower_type(field.type), name=field.name)


def coverage_owners(ctx: LoweringContext, scenario: Composed) -> Iterator[CoverageOwner]:
    """Yield a scenario and the objects that it declares, with those inside them.

    Passed objects are sampled where they are declared. Items of global actors and of lists whose
    elements no constraint describes are reported: their owners are unknown.
    """
    lineage = tuple(supertypes(scenario))
    yield CoverageOwner(ctx, lineage, (), "")
    special = ctx.program.analysis.types[scenario].special
    sampled = _SampledTypes(each for found in special.values() for each in found)
    for field in _fields(lineage):
        if (
            field not in ctx.program.handed_in
            and alias_of(ctx, field) is None
            and sampled.has(field.type)
        ):
            name = field_name(ctx, field)
            value = ir.FieldRef(span=field.span, type=lower_type(field.type), name=name)
            yield from _of_object(ctx, special, sampled, (field,), value, name)
    for name, shared in ctx.state.globals.items():
        _report(ctx, shared, f"global actor `{name}`")


class _SampledTypes:
    """Finds which objects have items, in themselves or in their parts: only these are visited.

    Args:
        special: The conditional types that objects are of; they count for their bases.
    """

    def __init__(self, special: Iterable[sym.TypeSymbol]) -> None:
        self._below: dict[sym.TypeSymbol, list[sym.TypeSymbol]] = {}
        for each in special:
            for ancestor in tuple(supertypes(each))[1:]:
                self._below.setdefault(ancestor, []).append(each)
        self._known: dict[sym.TypeSymbol, bool] = {}

    def has(self, type_: types.Type) -> bool:
        """Whether an object of a type, or an element of such a list, has items."""
        type_ = _element_type(type_)
        if not isinstance(type_, types.ActorType | types.StructType):
            return False
        if type_.symbol not in self._known:
            reached = self._reached(type_.symbol)
            found = any(next(items_of(each), None) is not None for each in reached)
            # None of the reached objects has any, if this has none.
            self._known |= {type_.symbol: True} if found else dict.fromkeys(reached, False)
        return self._known[type_.symbol]

    def _reached(self, start: sym.TypeSymbol) -> list[sym.TypeSymbol]:
        """Return a type, its bases, and the types of the fields of them all."""
        reached: dict[sym.TypeSymbol, None] = {}
        pending = [start]
        while pending:
            current = pending.pop()
            if current in reached:
                continue
            reached[current] = None
            pending += [*self._below.get(current, ()), *supertypes(current)]
            for member in _fields((current,)):
                type_ = _element_type(member.type)
                if isinstance(type_, types.ActorType | types.StructType):
                    pending.append(type_.symbol)
        return list(reached)


def _of_object(
    ctx: LoweringContext,
    special: Mapping[Key, tuple[sym.TypeSymbol, ...]],
    sampled: _SampledTypes,
    key: Key,
    value: ir.Expression,
    name: str,
) -> Iterator[CoverageOwner]:
    field = key[-1]
    assert isinstance(field, sym.FieldSymbol)
    if isinstance(field.type, types.ListType):
        elements = ctx.model.elements.get(field, ())
        for element in elements:
            type_ = lower_type(element.type)
            object_ = ir.FieldRef(span=element.span, type=type_, name=element.name)
            yield from _of_object(ctx, special, sampled, (element,), object_, element.name)
        if not elements and field.default is None:
            _report(ctx, field, f"list `{name}`")
        return
    if not isinstance(field.type, types.ActorType | types.StructType):
        return
    declared = field.type.symbol
    lineages: list[tuple[sym.TypeSymbol, ...]] = [tuple(supertypes(declared))]
    lineages += [(each,) for each in special.get(key, ())]
    for lineage in lineages:
        owner = lineage[0]
        assert isinstance(owner, sym.ActorSymbol | sym.StructSymbol)
        inside = ctx.inside(Receiver(owner, value))
        yield CoverageOwner(inside, lineage, key, f"{name}.")
        for member in _fields(lineage):
            if member.owner in (part.owner for part in key if isinstance(part, sym.FieldSymbol)):
                continue  # a type that holds itself
            if sampled.has(member.type):
                part = member_of(inside, value, member, member.span)
                path = f"{name}.{member.name}"
                yield from _of_object(ctx, special, sampled, (*key, member), part, path)


def _element_type(type_: types.Type) -> types.Type:
    """Return the type of the elements of a list, also of nested lists; any other type itself."""
    while isinstance(type_, types.ListType):
        type_ = type_.element
    return type_


def _fields(lineage: tuple[sym.TypeSymbol, ...]) -> Iterator[sym.FieldSymbol]:
    for each in lineage:
        for member in each.members.values():
            is_own = isinstance(member, sym.FieldSymbol) and member.origin == "user"
            if isinstance(member, sym.FieldSymbol) and is_own and not member.is_variable:
                yield member


def _report(ctx: LoweringContext, field: sym.FieldSymbol, what: str) -> None:
    type_ = _element_type(field.type)
    if not isinstance(type_, types.ActorType | types.StructType):
        return
    for each in supertypes(type_.symbol):
        for item in items_of(each):
            ctx.unsupported(
                "OSC501",
                item.node.span,
                f"`{item.node.kind}` in an object of the {what} is not supported yet",
                help="sample it in the scenario, `cover(name, expression: object.member)`",
            )
