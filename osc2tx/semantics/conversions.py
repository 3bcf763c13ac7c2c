"""Type conversions (§7.4.2.6), and the common type of several values."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx.semantics.scope import Scope, is_subtype, supertypes
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    FieldSymbol,
    PrimitiveSymbol,
    ScenarioSymbol,
    StructSymbol,
    TypeSymbol,
)
from osc2tx.semantics.types import (
    ERROR,
    FLOAT,
    INT,
    UINT,
    ActorType,
    BehaviorType,
    Dimension,
    EnumType,
    ErrorType,
    ListType,
    PhysicalType,
    PrimitiveType,
    RangeType,
    StructType,
    Type,
)

INTEGERS = (INT, UINT)
NUMBERS = (INT, UINT, FLOAT)

# Struct of the library -> the field whose values convert to it. Phases of traffic lights consist of
# bulbs (§8.15.6.1); all examples of the standard write their states instead (§8.15.10.5).
CONVERTIBLE_FIELDS = {"traffic_light_bulb": "state"}


def dimension_of(type_: Type) -> Dimension | None:
    """Return the dimension of a numeric type; `None` if it is not numeric."""
    match type_:
        case PhysicalType():
            return type_.dimension
        case PrimitiveType() if type_ in NUMBERS:
            return Dimension()
        case _:
            return None


def is_numeric(type_: Type) -> bool:
    """Whether values of a type are numbers, with or without a unit."""
    return dimension_of(type_) is not None


def symbol_of(type_: Type) -> TypeSymbol | None:
    """Return the symbol of a structured type."""
    match type_:
        case StructType() | ActorType() | BehaviorType():
            return type_.symbol
        case _:
            return None


def type_of_owner(symbol: TypeSymbol) -> Type:
    """Return the type of the instances of a type symbol."""
    match symbol:
        case StructSymbol():
            return StructType(symbol)
        case ActorSymbol():
            return ActorType(symbol)
        case ScenarioSymbol() | ActionSymbol():
            return BehaviorType(symbol)
        case PrimitiveSymbol():
            return PrimitiveType(symbol.name)
        case _:
            return ERROR


def convertible_type(type_: Type) -> Type | None:
    """Return the type of the values that convert to a struct of the library."""
    if not isinstance(type_, StructType) or type_.symbol.origin != "library":
        return None
    field = type_.symbol.members.get(CONVERTIBLE_FIELDS.get(type_.symbol.name, ""))
    return field.type if isinstance(field, FieldSymbol) else None


def converts(source: Type, target: Type) -> bool:
    """Whether a value of one type can be used where another one is required."""
    if source is target or source == target:  # the former of most, without a call
        return True
    if isinstance(source, ErrorType) or isinstance(target, ErrorType):
        return True
    match source, target:
        case PrimitiveType(), PrimitiveType():
            return source in INTEGERS and target in NUMBERS
        case (PhysicalType(), _) | (_, PhysicalType()):
            wanted, given = dimension_of(target), dimension_of(source)
            if isinstance(target, RangeType):
                return converts(source, target.element)
            return wanted is not None and wanted == given and not wanted.is_dimensionless
        case ListType(), ListType():
            return converts(source.element, target.element)
        case RangeType(), RangeType():
            return converts(source.element, target.element)
        case _, RangeType():
            return converts(source, target.element)
        case EnumType(), StructType():
            return source == convertible_type(target)
        case _:
            derived, ancestor = symbol_of(source), symbol_of(target)
            return derived is not None and ancestor is not None and is_subtype(derived, ancestor)


def are_related(left: Type, right: Type) -> bool:
    """Whether two values can be compared for equality (§7.4.2.4)."""
    return converts(left, right) or converts(right, left)


def can_cast(source: Type, target: Type) -> bool:
    """Whether `.as(target)` is possible (§7.4.2.6)."""
    if are_related(source, target):
        return True
    match source, target:
        case PrimitiveType(), PrimitiveType():
            return source in NUMBERS and target in NUMBERS
        case PrimitiveType(), EnumType():
            return source in INTEGERS
        case EnumType(), PrimitiveType():
            return target in INTEGERS
        case ListType(), ListType():
            return can_cast(source.element, target.element)
        case _:
            return False


def common_type(scope: Scope, types: Iterable[Type]) -> Type | None:
    """Return the type that several values have in common (§7.4.2.7); `None` if there is none."""
    result: Type | None = None
    for type_ in types:
        if type_ == ERROR:
            return ERROR
        result = type_ if result is None else _common_of_two(scope, result, type_)
        if result is None:
            return None
    return result


def _common_of_two(scope: Scope, left: Type, right: Type) -> Type | None:
    if left == right:
        return left
    match left, right:
        case PrimitiveType(), PrimitiveType():
            if left not in NUMBERS or right not in NUMBERS:
                return None
            return FLOAT if FLOAT in (left, right) else INT
        case PhysicalType(), PhysicalType():
            return scope.physical_type(left.dimension) if converts(left, right) else None
        case RangeType(), RangeType():
            element = _common_of_two(scope, left.element, right.element)
            return RangeType(element) if element else None
        case _:
            return _common_base(left, right)


def _common_base(left: Type, right: Type) -> Type | None:
    first, second = symbol_of(left), symbol_of(right)
    if first is None or second is None:
        return None
    for ancestor in supertypes(first):
        if is_subtype(second, ancestor):
            return type_of_owner(ancestor)
    return None
