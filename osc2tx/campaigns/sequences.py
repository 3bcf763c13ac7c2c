"""Samplers that fill the space of all parameters evenly, by `scipy.stats.qmc`.

Sobol and Halton sequences go on: row 17 is the same among 100 rows as among 10,000. A Latin
hypercube does not, its rows depend on how many there are. Where constraints leave points of it out,
more hypercubes of the same size follow until there are enough rows.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from osc2tx.campaigns.errors import CampaignError
from osc2tx.campaigns.sampling import Wanted, row_seed
from osc2tx_runtime.campaigns import Row
from osc2tx_runtime.campaigns.points import Column

__all__ = ["SequenceSampler"]

KINDS = {"lhs": "LatinHypercube", "sobol": "Sobol", "halton": "Halton"}
BLOCK = 1024  # a power of two: a Sobol sequence is balanced after each block


class SequenceSampler:
    """Points of a sequence, scrambled by the seed."""

    is_checked = True

    def __init__(self, name: str, columns: Sequence[Column], wanted: Wanted) -> None:
        self._name, self._columns, self._wanted = name, columns, wanted
        self._qmc = _qmc(name)

    @property
    def identity(self) -> Mapping[str, Any]:
        """The columns, the version of scipy, and of a Latin hypercube the number of rows."""
        import scipy

        rows = {"rows": self._wanted.samples} if self._name == "lhs" else {}
        names = [column.name for column in self._columns]
        return {"columns": names, "scipy": scipy.__version__, **rows}

    def rows(self) -> Iterator[Row]:
        """Yield rows without end."""
        names, seed = [column.name for column in self._columns], self._wanted.seed
        for number, shares in enumerate(self._points(len(names))):
            yield Row(number, row_seed(seed, number), dict(zip(names, shares, strict=True)))

    def _points(self, dimensions: int) -> Iterator[list[float]]:
        seed = self._wanted.seed
        kind = getattr(self._qmc, KINDS[self._name])
        engine = kind(dimensions, scramble=True, rng=seed)
        block = self._wanted.samples if self._name == "lhs" else BLOCK
        while True:
            yield from engine.random(block).tolist()


def _qmc(name: str) -> Any:
    try:
        from scipy.stats import qmc
    except ImportError:
        raise CampaignError(
            f"--sampler {name} needs scipy: pip install 'osc2tx[campaign]'"
        ) from None
    return qmc
