"""Conditional inheritance (§7.3.8.2): subtypes that an object has because of a field's value.

An object of type `vehicle` whose category is `bus` is of the type `coach inherits vehicle(
vehicle_category == bus)` by itself: it has its members, and its constraints hold.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from osc2tx.analysis.constraints.domains import Choice, Domain, Value
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Special = sym.ActorSymbol | sym.StructSymbol
Behavior = sym.ScenarioSymbol | sym.ActionSymbol


@dataclass(frozen=True, slots=True, eq=False)
class Determinant:
    """A field whose value decides whether something is of a conditional type (§7.3.8.2)."""

    field: sym.FieldSymbol
    value: Value


@dataclass(frozen=True, slots=True, eq=False)
class Condition:
    """A type that objects have if a field has a value."""

    type: Special
    determinant: Determinant

    @property
    def field(self) -> sym.FieldSymbol:
        """The field."""
        return self.determinant.field


def conditions_of(model: SemanticModel) -> tuple[Condition, ...]:
    """Return the types of objects of a program with conditional inheritance."""
    return tuple(
        Condition(symbol, determinant)
        for symbol in model.symbols
        if isinstance(symbol, sym.ActorSymbol | sym.StructSymbol)
        and (determinant := determinant_of(model, symbol)) is not None
    )


def determinant_of(model: SemanticModel, symbol: Special | Behavior) -> Determinant | None:
    """Return the conditions under which an object of the base type is of a type."""
    condition = symbol.condition
    if condition is None:
        return None
    field, value = model.symbol_of(condition.field), model.symbol_of(condition.value)
    if not isinstance(field, sym.FieldSymbol):
        return None
    if isinstance(value, sym.EnumMemberSymbol):
        return Determinant(field, value.value)
    if isinstance(condition.value, ast.BoolLiteral):
        return Determinant(field, condition.value.value)
    return None


def types_below(
    conditions: tuple[Condition, ...], declared: sym.TypeSymbol, special: tuple[Special, ...]
) -> Iterator[Condition]:
    """Yield the conditional types that an object may be of besides those it is of for certain."""
    known = {*supertypes(declared), *(t for each in special for t in supertypes(each))}
    for condition in conditions:
        if condition.type not in known and condition.type.base in known:
            yield condition


def is_certain(domain: Domain | None, value: Value) -> bool:
    """Whether a field can have no other value."""
    return isinstance(domain, Choice) and domain.is_point and value in domain.values


def is_possible(domain: Domain | None, determinant: Determinant) -> bool:
    """Whether a field may have the value of a condition.

    Library fields without constraints are decided by the world, and tested at run time.
    """
    if not isinstance(domain, Choice):
        return determinant.field.origin == "user"
    return (determinant.value in domain.values) is not domain.excluded


def specialised(
    conditions: tuple[Condition, ...],
    objects: Mapping[Key, sym.TypeSymbol],
    domains: Mapping[Key, Domain],
    special: Mapping[Key, tuple[Special, ...]],
) -> dict[Key, tuple[Special, ...]]:
    """Return the conditional types that objects certainly have, with their consequences."""
    found = dict(special)
    for key, declared in objects.items():
        for condition in types_below(conditions, declared, found.get(key, ())):
            if is_certain(domains.get((*key, condition.field)), condition.determinant.value):
                found[key] = (*found.get(key, ()), condition.type)
    return found
