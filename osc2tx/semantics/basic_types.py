"""Types that refer to no symbol: primitive, physical and special ones (§7.3)."""

from __future__ import annotations

from osc2tx.syntax.si_notation import si_notation
from osc2tx_shared.classes import dataclass

SI_BASES = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


@dataclass(frozen=True, slots=True)
class Dimension:
    """Exponents of the SI base units, plane angle included, in the order of `SI_BASES`."""

    exponents: tuple[int, ...] = (0,) * len(SI_BASES)

    @property
    def is_dimensionless(self) -> bool:
        """Whether all exponents are zero."""
        return not any(self.exponents)

    def __mul__(self, other: Dimension) -> Dimension:
        """Dimension of a product."""
        return Dimension(tuple(a + b for a, b in zip(self.exponents, other.exponents, strict=True)))

    def __truediv__(self, other: Dimension) -> Dimension:
        """Dimension of a quotient."""
        return Dimension(tuple(a - b for a, b in zip(self.exponents, other.exponents, strict=True)))

    def __str__(self) -> str:
        """SI notation, `m/s`; `1` if dimensionless."""
        return si_notation(zip(SI_BASES, self.exponents, strict=True))


DIMENSIONLESS = Dimension()


@dataclass(frozen=True, slots=True)
class PrimitiveType:
    """`bool`, `int`, `uint`, `float` or `string`."""

    name: str

    def __str__(self) -> str:
        """The keyword."""
        return self.name


BOOL = PrimitiveType("bool")
INT = PrimitiveType("int")
UINT = PrimitiveType("uint")
FLOAT = PrimitiveType("float")
STRING = PrimitiveType("string")
PRIMITIVES = {t.name: t for t in (BOOL, INT, UINT, FLOAT, STRING)}


@dataclass(frozen=True, slots=True)
class PhysicalType:
    """A declared physical type, or a bare dimension (`name` empty) that arithmetic produced."""

    name: str
    dimension: Dimension

    def __str__(self) -> str:
        """The name, else the dimension."""
        return self.name or str(self.dimension)


@dataclass(frozen=True, slots=True)
class EventType:
    """The type of a path that names an event; only event specifications take it."""

    def __str__(self) -> str:
        """For messages."""
        return "event"


@dataclass(frozen=True, slots=True)
class VoidType:
    """The result type of a method without result."""

    def __str__(self) -> str:
        """For messages."""
        return "nothing"


@dataclass(frozen=True, slots=True)
class ErrorType:
    """The type of an expression with a reported error; every check accepts it."""

    def __str__(self) -> str:
        """For messages, where it never should appear."""
        return "error"


EVENT, VOID, ERROR = EventType(), VoidType(), ErrorType()
OBJECT = VOID
"""The expected type of a value whose members are accessed: not a member of an enum."""
