"""What a sampler is: it says which values the rows of a campaign have."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from typing import Any, Protocol

from osc2tx_classes import dataclass
from osc2tx_runtime.campaigns import Row

__all__ = ["Sampler", "Wanted", "row_seed"]


@dataclass(frozen=True, slots=True)
class Wanted:
    """What a sampler is to do.

    Attributes:
        name: Of the sampler, as on the command line.
        seed: Of the campaign.
        samples: How many rows; None for all of a sampler that ends by itself.
        levels: Values of each range in a grid and for pairs.
    """

    name: str
    seed: int = 0
    samples: int | None = None
    levels: int = 5


class Sampler(Protocol):
    """Gives the rows of a campaign."""

    @property
    def identity(self) -> Mapping[str, Any]:
        """What else the meaning of a row depends on, besides name and seed."""

    @property
    def is_checked(self) -> bool:
        """Whether the values of a row may break a constraint, so that the row is left out."""

    def rows(self) -> Iterator[Row]:
        """Yield the rows by number, from 0."""


def row_seed(seed: int, number: int) -> int:
    """Return the seed of the run of a row; no two campaigns share theirs."""
    digest = hashlib.sha256(f"{seed}/{number}".encode()).digest()
    return int.from_bytes(digest[:6], "big")
