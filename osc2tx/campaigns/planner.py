"""Selects the rows to run: those that satisfy the constraints and are not stored yet."""

from __future__ import annotations

from collections.abc import Container, Iterator

from osc2tx.campaigns.sampling import Sampler
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.campaigns import Executor, Row
from osc2tx_runtime.campaigns.points import Column
from osc2tx_runtime.errors import SettingsError

from .store import CampaignError

ATTEMPTS = 1000  # points that are tried
MOST_LEFT_OUT = 10_000  # in a row: then a sequence is given up


def columns_of(executor: Executor) -> list[Column]:
    """Return the parameters that a scenario draws, in order.

    Raises:
        CampaignError: Hardly any point satisfies the constraints.
        ScenarioError: It can have no values at all.
    """
    executor.values_of(Row(0, 0))  # a seed gives values, or a reason
    for seed in range(ATTEMPTS):
        try:
            _, point = executor.values_of(Row(0, seed, {}))
        except ScenarioError as error:
            last = error
            continue
        assert point is not None
        return list(point.columns.values())
    raise too_thin(f"none of {ATTEMPTS} points of the domain satisfies the constraints", last)


def why_left_out(executor: Executor, row: Row) -> ScenarioError | None:
    """Return the constraint that the values of a row violate, or the error; else None."""
    try:
        executor.values_of(row)
    except SettingsError:
        raise
    except ScenarioError as error:
        return error
    return None


def too_thin(what: str, example: ScenarioError) -> CampaignError:
    """Return the message for a sampler of which hardly any point is left.

    Args:
        what: The number of tried points.
        example: Why one of them is left out.
    """
    return CampaignError(
        f"{what}: too few points satisfy the constraints; use --sampler random."
        f" Example: {example.source}: {example.message}"
    )


class Planner:
    """Yields rows up to the requested number.

    Args:
        executor: Evaluates the constraints.
        sampler: Gives the rows.
        samples: The requested number; None for all rows of the sampler.
        done: Numbers of the rows that were run.
        left_out: Numbers of those that break a constraint; grows.

    Attributes:
        accepted: Number of rows so far, those of earlier calls included.
        newly_left_out: Numbers added to `left_out` since they were last taken.
    """

    def __init__(
        self,
        executor: Executor,
        sampler: Sampler,
        samples: int | None,
        done: Container[int],
        left_out: set[int],
    ) -> None:
        self._executor, self._sampler, self._samples = executor, sampler, samples
        self._done, self._left_out = done, left_out
        self.accepted = 0
        self.newly_left_out: list[int] = []

    def rows(self) -> Iterator[Row | None]:
        """Yield the rows to run; None as the sampler does.

        Raises:
            CampaignError: Hardly any point satisfies the constraints.
        """
        in_a_row = 0
        for row in self._sampler.rows():
            if self._samples is not None and self.accepted >= self._samples:
                return
            if row is None:
                yield None
                continue
            if row.number in self._done:
                self.accepted += 1
            elif row.number in self._left_out or not self._keeps(row):
                in_a_row += 1
                if in_a_row >= MOST_LEFT_OUT:
                    raise self._too_thin(row.number + 1, why_left_out(self._executor, row))
                continue
            else:
                self.accepted += 1
                yield row
            in_a_row = 0

    def _too_thin(self, points: int, last: ScenarioError | None) -> CampaignError:
        assert last is not None, "it was left out"
        share = f"{self.accepted} of {points} points ({self.accepted / points:.3%})"
        return too_thin(f"{share} satisfy the constraints, none of the last {MOST_LEFT_OUT}", last)

    def _keeps(self, row: Row) -> bool:
        if not self._sampler.is_checked or why_left_out(self._executor, row) is None:
            return True
        self._left_out.add(row.number)
        self.newly_left_out.append(row.number)
        return False
