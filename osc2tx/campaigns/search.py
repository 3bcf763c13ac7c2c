"""A search: rows that are chosen by the outcomes of earlier rows, to find the worst value of a KPI.

Rows are chosen in batches of a size that is part of the campaign, by the results of all rows of the
batches before. So row 17 is the same wherever the rows run, in any order, and however often the
campaign was interrupted: a search that resumes reads the results in the store again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count
from typing import Any

from osc2tx.campaigns.aims import Aim
from osc2tx.campaigns.sampling import Findings, row_seed
from osc2tx_runtime.campaigns import Row
from osc2tx_runtime.campaigns.points import Column

from .store import CampaignError


class SearchSampler:
    """Rows that Optuna chooses, by the tree-structured Parzen estimator.

    A point that breaks a constraint, and a row that has no value, count as far from the aim as can
    be: the search leaves their neighbourhood.

    Args:
        columns: The parameters that the scenario draws.
        seed: Of the campaign.
        aim: The extreme that is searched.
        findings: Knowledge about rows; grows meanwhile.

    Raises:
        CampaignError: Optuna is not installed.
    """

    is_checked = True

    def __init__(self, columns: Sequence[Column], seed: int, aim: Aim, findings: Findings) -> None:
        self._columns, self._seed, self._aim, self._findings = columns, seed, aim, findings
        self._optuna = _optuna()

    @property
    def identity(self) -> Mapping[str, Any]:
        """The aim, the columns, the size of a batch, the version of Optuna."""
        return {
            "search": f"{self._aim.manner}:{self._aim.kpi}",
            "columns": [column.name for column in self._columns],
            "batch": self._aim.batch,
            "optuna": self._optuna.__version__,
        }

    def rows(self) -> Iterator[Row | None]:
        """Yield rows without end; None while not all rows of a batch are known."""
        optuna = self._optuna
        study = optuna.create_study(
            sampler=optuna.samplers.TPESampler(seed=self._seed),
            direction="minimize" if self._aim.manner == "min" else "maximize",
        )
        space = {column.name: self._distribution(column) for column in self._columns}
        for first in count(0, self._aim.batch):
            trials = [study.ask(space) for _ in range(self._aim.batch)]
            yield from map(self._row, trials)
            while not all(map(self._findings.knows, (trial.number for trial in trials))):
                yield None
            if first == 0:
                self._check([trial.number for trial in trials])
            for trial in trials:
                study.tell(trial, self._aim.value(self._findings.measures.get(trial.number, {})))

    def _distribution(self, column: Column) -> Any:
        kinds = self._optuna.distributions
        if column.kind == "real":
            return kinds.FloatDistribution(0.0, 1.0)
        if column.kind == "whole":
            return kinds.IntDistribution(0, column.count - 1)
        return kinds.CategoricalDistribution(range(column.count))

    def _row(self, trial: Any) -> Row:
        shares = {
            column.name: _share(column, trial.params[column.name]) for column in self._columns
        }
        return Row(trial.number, row_seed(self._seed, trial.number), shares)

    def _check(self, numbers: Sequence[int]) -> None:
        """Check that the KPI occurs.

        Raises:
            CampaignError: No row of the first batch has the KPI.
        """
        rows = [self._findings.measures.get(number, {}) for number in numbers]
        names = list(dict.fromkeys(name for row in rows for name in row))
        if names and self._aim.kpi not in names:
            raise CampaignError(
                f"--search {self._aim.kpi}: no row of the first {len(numbers)} has it; they have"
                f" {', '.join(names)}"
            )


def _share(column: Column, value: float) -> float:
    """Return the position of a value in its domain; the middle of the cell of an integer."""
    return value if column.kind == "real" else (value + 0.5) / column.count


def _optuna() -> Any:
    try:
        import optuna
    except ImportError:
        raise CampaignError("--search needs optuna: pip install 'osc2tx[search]'") from None
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    return optuna
