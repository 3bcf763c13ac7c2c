"""Samplers by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from itertools import count
from typing import Any

from osc2tx.campaigns.designs import GridSampler, PairwiseSampler
from osc2tx.campaigns.errors import CampaignError
from osc2tx.campaigns.sampling import Findings, Sampler, Wanted, row_seed
from osc2tx.campaigns.search import SearchSampler
from osc2tx.campaigns.sequences import SequenceSampler
from osc2tx.campaigns.tables import TableSampler
from osc2tx_classes import dataclass
from osc2tx_runtime.campaigns import Row
from osc2tx_runtime.campaigns.points import Column

__all__ = ["SAMPLERS", "sampler_by_name"]

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
        is_allowed: Whether the values of a row keep the constraints.
        findings: What a search goes by; grows meanwhile.

    Raises:
        CampaignError: There is none of this name, or it cannot do what is wanted.
    """
    name, _, file = wanted.name.partition(":")
    if name == "random":
        return RandomSampler(wanted.seed)
    if name == "table" and file:
        return TableSampler.read(file, wanted.seed)
    option = "--search" if wanted.aim else f"--sampler {name}"
    if (wanted.aim or name in ("lhs", "sobol", "halton", "grid", "pairwise")) and not columns:
        raise CampaignError(
            f"{option}: the scenario draws no values; give a parameter a range, or run it"
            " with other seeds alone (--sampler random)"
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
