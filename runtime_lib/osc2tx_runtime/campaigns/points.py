"""Points of the unit cube as values of parameters: the position of each in its domain."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Column:
    """A parameter whose value is drawn.

    Attributes:
        name: As in settings: in an invoked scenario with the path before it.
        kind: The kind of its domain: a range of real or whole numbers, or a list of values.
        count: Number of these values; 0 for real numbers.
    """

    name: str
    kind: Literal["real", "whole", "choice"]
    count: int = 0


class Point:
    """The position of a row between the first (0) and the last value (1) of each parameter.

    As `RunSettings.draws` it replaces the seed. A bound may depend on other parameters: the value
    is a share of the range at that time.

    Args:
        shares: By name of the parameter.
        rest: Seed of all other parameters.

    Attributes:
        columns: The drawn parameters, in order.
    """

    def __init__(self, shares: Mapping[str, float], rest: int = 0) -> None:
        self._shares = shares
        self._rest = rest
        self.columns: dict[str, Column] = {}

    def __call__(self, name: str) -> random.Random:
        """Return the random number of a parameter."""
        share = self._shares.get(name)
        if share is None:
            share = random.Random(f"{self._rest}/{name}").random()
        return _Placed(name, share, self.columns)


class _Placed(random.Random):
    """Draws a value at a position in its domain."""

    def __init__(self, name: str, share: float, columns: dict[str, Column]) -> None:
        super().__init__(0)
        self._name, self._share, self._columns = name, share, columns

    def random(self) -> float:
        """Return the position itself."""
        self._columns[self._name] = Column(self._name, "real")
        return self._share

    def uniform(self, a: float, b: float) -> float:
        """Return a number between two others."""
        self._columns[self._name] = Column(self._name, "real")
        return min(max(a + (b - a) * self._share, min(a, b)), max(a, b))

    def randint(self, a: int, b: int) -> int:
        """Return a whole number from one to another, both included."""
        self._columns[self._name] = Column(self._name, "whole", b - a + 1)
        return a + self._index(b - a + 1)

    def choice(self, seq: Sequence[Any]) -> Any:  # type: ignore[override]
        """Return an element."""
        self._columns[self._name] = Column(self._name, "choice", len(seq))
        return seq[self._index(len(seq))]

    def _index(self, count: int) -> int:
        return min(int(self._share * count), count - 1)
