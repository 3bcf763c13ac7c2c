"""Type names (§7.2.2.2)."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx.syntax.ast.base import BehaviorName, Node
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NamedType(Node):
    """A type by name: primitive, physical, enum, struct, actor or behavior (`vehicle.drive`)."""

    name: BehaviorName


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RangeType(Node):
    """`range of T`, numeric `T` (2.2)."""

    element: NamedType


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ListType(Node):
    """`list of T`."""

    element: NamedType | RangeType


TypeName: TypeAlias = NamedType | RangeType | ListType
