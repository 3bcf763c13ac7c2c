"""The notation of SI units."""

from __future__ import annotations

from collections.abc import Iterable


def si_notation(powers: Iterable[tuple[str, int]]) -> str:
    """Return a product of powers of base units, as `m/s` or `kg m/s^2`; `1` if there are none."""
    listed = list(powers)
    above = " ".join(_power(base, exponent) for base, exponent in listed if exponent > 0) or "1"
    below = " ".join(_power(base, -exponent) for base, exponent in listed if exponent < 0)
    if not below:
        return above
    return f"{above}/({below})" if " " in below else f"{above}/{below}"


def _power(base: str, exponent: int) -> str:
    return base if exponent == 1 else f"{base}^{exponent}"
