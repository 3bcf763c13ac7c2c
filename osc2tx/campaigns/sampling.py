"""Samplers: they choose the values of the rows of a campaign."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Protocol

from osc2tx.campaigns.aims import Aim
from osc2tx_runtime.campaigns import Plan, Row, RowResult
from osc2tx_runtime.kpis import MEASURES
from osc2tx_shared.classes import dataclass

from .store import CampaignError


@dataclass(frozen=True, slots=True)
class Wanted:
    """The task of a sampler.

    Attributes:
        name: Of the sampler, as on the command line.
        seed: Of the campaign.
        samples: Number of rows; None for all of a sampler that ends by itself.
        levels: Values of each range in a grid and for pairs.
        aim: The aim of a search.
    """

    name: str
    seed: int = 0
    samples: int | None = None
    levels: int = 5
    aim: Aim | None = None

    @property
    def is_endless(self) -> bool:
        """Whether the number of rows is not stated."""
        ends_by_itself = self.name.partition(":")[0] in ("grid", "pairwise", "table")
        return self.samples is None and not ends_by_itself

    @property
    def at_once(self) -> int:
        """Number of rows per batch of a worker: one if the selection of the next ones waits."""
        return 1 if self.aim else 16


def wanted_rows(
    plan: Plan,
    sampler: str | None,
    samples: int | None,
    levels: int,
    search: str | None = None,
    search_batch: int = 16,
) -> Wanted:
    """Return the task of a sampler, or a search: `random` where neither is named.

    Raises:
        CampaignError: Both are, the search does not state its aim, or a condition of failure is on
            a value that no measure has.
        SettingsError: There is no such measure.
    """
    if sampler and search:
        raise CampaignError(
            f"--sampler {sampler}: a search selects the rows; use only one of the options"
        )
    _check_conditions(plan)
    aim = Aim.parse(search, plan.measures, search_batch) if search else None
    return Wanted(
        "search" if aim else sampler or "random", plan.settings.seed, samples, levels, aim
    )


def _check_conditions(plan: Plan) -> None:
    """Refuse a condition that never holds since no selected measure has its value.

    Measures of other packages may have values of any name.
    """
    if any(name not in MEASURES for name in plan.measures):
        return
    known = [value for name in plan.measures for value in MEASURES[name]().results()]
    for each in plan.fail_if:
        if each.measure.partition("(")[0] not in known:
            raise CampaignError(
                f"--fail-if {each}: no measure has this value; available: {', '.join(known)}"
            )


class Findings:
    """Knowledge about rows, from which the next ones are chosen.

    Attributes:
        measures: Measures of completed rows, by number; kept for a search alone.
        left_out: Numbers of rows that break a constraint.
    """

    def __init__(
        self,
        measures: Mapping[int, Mapping[str, float | None]] | None = None,
        left_out: Iterable[int] = (),
    ) -> None:
        self.measures = dict(measures or {})
        self.left_out = set(left_out)

    def hear(self, results: Iterable[RowResult]) -> None:
        """Note the outcomes of rows."""
        self.measures.update((each.row.number, each.measures) for each in results)

    def knows(self, number: int) -> bool:
        """Whether the outcome of a row is known."""
        return number in self.measures or number in self.left_out


class Sampler(Protocol):
    """Gives the rows of a campaign."""

    @property
    def identity(self) -> Mapping[str, Any]:
        """Further inputs of the meaning of a row, besides name and seed."""

    @property
    def is_checked(self) -> bool:
        """Whether the values of a row may break a constraint, so that the row is left out."""

    def rows(self) -> Iterator[Row | None]:
        """Yield the rows by number, from 0; None for none before more is known of earlier ones."""


def row_seed(seed: int, number: int) -> int:
    """Return the seed of the run of a row; no two campaigns share theirs."""
    digest = hashlib.sha256(f"{seed}/{number}".encode()).digest()
    return int.from_bytes(digest[:6], "big")
