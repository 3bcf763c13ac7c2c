"""Numbers read from the world, compared with a tolerance.

A car that is 5 m behind another and 20 km/h faster is 20 m ahead of it after 4.5 s; summing up the
steps gives 19.999999999999986 m. So comparisons of measured values allow for rounding: `>=` holds
at 4.5 s in every run, `>` one step later.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

ROUNDING = 1e-9
"""Numbers with a smaller absolute or relative difference count as equal."""


class Measured(float):
    """A measured value in SI units; values calculated from it are measured as well."""

    __slots__ = ()

    __hash__ = float.__hash__

    def __eq__(self, other: object) -> bool:
        """Whether both are equal up to rounding."""
        if not isinstance(other, float | int):
            return NotImplemented
        return math.isclose(self, other, rel_tol=ROUNDING, abs_tol=ROUNDING)

    def __ne__(self, other: object) -> bool:
        """Whether they differ by more than rounding."""
        return not self == other

    def __lt__(self, other: float) -> bool:
        """Whether it is less, by more than rounding."""
        return float.__lt__(self, other) and self != other

    def __le__(self, other: float) -> bool:
        """Whether it is less, or equal up to rounding."""
        return float.__le__(self, other) or self == other

    def __gt__(self, other: float) -> bool:
        """Whether it is more, by more than rounding."""
        return float.__gt__(self, other) and self != other

    def __ge__(self, other: float) -> bool:
        """Whether it is more, or equal up to rounding."""
        return float.__ge__(self, other) or self == other


def _keeping(name: str) -> Callable[..., Any]:
    """Return an operation of numbers whose result counts as measured."""
    operation = getattr(float, name)

    def operate(self: Measured, *others: object) -> Any:
        result = operation(self, *others)
        return result if result is NotImplemented else Measured(result)

    operate.__name__ = name
    return operate


for _name in ("add", "sub", "mul", "truediv", "mod"):
    setattr(Measured, f"__{_name}__", _keeping(f"__{_name}__"))
    setattr(Measured, f"__r{_name}__", _keeping(f"__r{_name}__"))
for _name in ("neg", "abs"):
    setattr(Measured, f"__{_name}__", _keeping(f"__{_name}__"))
