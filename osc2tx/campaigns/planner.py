"""Chooses the rows that are to be run: those that keep the constraints and are not done yet."""

from __future__ import annotations

from collections.abc import Container, Iterator

from osc2tx.campaigns.errors import CampaignError
from osc2tx.campaigns.sampling import Sampler
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.campaigns import Executor, LeftOut, Row
from osc2tx_runtime.campaigns.points import Column
from osc2tx_runtime.errors import SettingsError

__all__ = ["Planner", "columns_of", "is_allowed"]

ATTEMPTS = 1000  # points that are tried
MOST_LEFT_OUT = 10_000  # in a row: then a sequence is given up


def columns_of(executor: Executor) -> list[Column]:
    """Return the parameters that a scenario draws, in order.

    Raises:
        ScenarioError: It can have no values at all.
    """
    executor.values_of(Row(0, 0))  # by a seed there are values, or it says why not
    for seed in range(ATTEMPTS):
        try:
            _, point = executor.values_of(Row(0, seed, {}))
        except LeftOut:
            continue
        assert point is not None
        return list(point.columns.values())
    raise CampaignError(
        f"none of {ATTEMPTS} points of the domain keeps the constraints: the set of values is too"
        " thin for this sampler, use --sampler random"
    )


def is_allowed(executor: Executor, row: Row) -> bool:
    """Whether the values of a row keep the constraints."""
    try:
        executor.values_of(row)
    except SettingsError:
        raise
    except (LeftOut, ScenarioError):  # they break a constraint, or have no result
        return False
    return True


class Planner:
    """Yields rows until there are as many as wanted.

    Args:
        executor: Knows the constraints.
        sampler: Gives the rows.
        samples: How many are wanted; None for all that the sampler has.
        done: Numbers of the rows that were run.
        left_out: Numbers of those that break a constraint; grows.

    Attributes:
        accepted: How many rows there are so far, those that were run before included.
        newly_left_out: Numbers that came to `left_out`, until somebody takes them.
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
        """Yield the rows that are to be run; None as the sampler does.

        Raises:
            CampaignError: Hardly any point keeps the constraints.
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
                if in_a_row > MOST_LEFT_OUT:
                    raise CampaignError(
                        f"{MOST_LEFT_OUT} points one after the other break a constraint: the set"
                        " of values is too thin for this sampler, use --sampler random"
                    )
                continue
            else:
                self.accepted += 1
                yield row
            in_a_row = 0

    def _keeps(self, row: Row) -> bool:
        if not self._sampler.is_checked or is_allowed(self._executor, row):
            return True
        self._left_out.add(row.number)
        self.newly_left_out.append(row.number)
        return False
