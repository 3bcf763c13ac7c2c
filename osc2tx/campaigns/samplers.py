"""Samplers by name."""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from itertools import count
from pathlib import Path
from typing import Any

from osc2tx.campaigns.designs import GridSampler, PairwiseSampler
from osc2tx.campaigns.sampling import Findings, Sampler, Wanted, row_seed
from osc2tx.campaigns.search import SearchSampler
from osc2tx_runtime.campaigns import Row
from osc2tx_runtime.campaigns.points import Column
from osc2tx_shared.classes import dataclass

from .designs import SequenceSampler
from .store import CampaignError


@dataclass(frozen=True, slots=True)
class TableSampler:
    """Rows of a CSV file: names of parameters in the first line, values as for `--set` below."""

    digest: str
    names: Sequence[str]
    lines: Sequence[Sequence[str]]
    seed: int
    is_checked: bool = False  # explicitly requested rows are run, and fail visibly

    @classmethod
    def read(cls, file: str, seed: int) -> TableSampler:
        """Read a file.

        Raises:
            CampaignError: It cannot be read, or a line has too many or too few values.
        """
        try:
            text = Path(file).read_text(encoding="utf-8-sig")
        except (OSError, ValueError) as error:
            raise CampaignError(f"--sampler table:{file}: cannot be read: {error}") from error
        lines = [line for line in csv.reader(io.StringIO(text)) if line]
        if not lines:
            raise CampaignError(
                f"--sampler table:{file}: it is empty; the first line names parameters"
            )
        names = [name.strip() for name in lines[0]]
        for number, line in enumerate(lines[1:]):
            if len(line) != len(names):
                raise CampaignError(
                    f"--sampler table:{file}: row {number} has {len(line)} values, the first line"
                    f" names {len(names)} parameters"
                )
        return cls(hashlib.sha256(text.encode()).hexdigest(), names, lines[1:], seed)

    @property
    def identity(self) -> Mapping[str, Any]:
        """The digest of the file."""
        return {"table": self.digest}

    def rows(self) -> Iterator[Row]:
        """Yield all rows."""
        for number, line in enumerate(self.lines):
            values = dict(zip(self.names, map(_value, line), strict=True))
            yield Row(number, row_seed(self.seed, number), None, values)


def _value(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text.strip()


SAMPLERS = ("random", "lhs", "sobol", "halton", "grid", "pairwise", "table:FILE")


@dataclass(frozen=True, slots=True)
class RandomSampler:
    """Each row has a seed, and the scenario draws from it as in any run."""

    seed: int
    identity: Mapping[str, Any] = field(default_factory=dict)
    is_checked: bool = False

    def rows(self) -> Iterator[Row]:
        """Yield rows without end."""
        return (Row(number, row_seed(self.seed, number)) for number in count())


def sampler_by_name(
    wanted: Wanted,
    columns: Sequence[Column],
    is_allowed: Callable[[Row], bool],
    findings: Findings,
) -> Sampler:
    """Return a sampler.

    Args:
        wanted: Its name, seed and size.
        columns: The parameters that the scenario draws.
        is_allowed: Whether the values of a row satisfy the constraints.
        findings: Results for a search; grows meanwhile.

    Raises:
        CampaignError: There is none of this name, or it cannot do what is requested.
    """
    name, _, file = wanted.name.partition(":")
    if name == "random":
        return RandomSampler(wanted.seed)
    if name == "table" and file:
        return TableSampler.read(file, wanted.seed)
    option = "--search" if wanted.aim else f"--sampler {name}"
    if (wanted.aim or name in ("lhs", "sobol", "halton", "grid", "pairwise")) and not columns:
        raise CampaignError(
            f"{option}: the scenario draws no values; give a parameter a range, or vary only"
            " the seed (--sampler random)"
        )
    if wanted.aim:
        return SearchSampler(columns, wanted.seed, wanted.aim, findings)
    if name in ("lhs", "sobol", "halton"):
        return SequenceSampler(name, columns, wanted)
    if name == "grid":
        return GridSampler(columns, wanted)
    if name == "pairwise":
        return PairwiseSampler(columns, wanted, is_allowed)
    raise CampaignError(f"--sampler {wanted.name}: there is {', '.join(SAMPLERS)}")
