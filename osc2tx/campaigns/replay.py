"""Runs one row of a store again, with its trace and its report."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from osc2tx.campaigns.identity import plan_of
from osc2tx.campaigns.records import row_of
from osc2tx.campaigns.store import Store
from osc2tx_runtime import RunResult
from osc2tx_runtime.campaigns import Executor
from osc2tx_shared.classes import replace

from .store import CampaignError


def replay_row(
    store: Store, number: int, trace: Path | None, report: Path | None, folders: Sequence[Path] = ()
) -> tuple[str, RunResult]:
    """Run a row again.

    Args:
        store: The campaign.
        number: Number of the row.
        trace: File for its trace.
        report: File for its report.
        folders: Folders that are searched for its map first.

    Returns:
        The name of the scenario, and how the run ended.

    Raises:
        CampaignError: There is no such row, or the run differs from the stored one.
        ScenarioError: The row could not be run, and cannot.
    """
    run = store.run(number)
    plan = plan_of(store)
    settings = replace(plan.settings, map_path=(*folders, *plan.settings.map_path))
    with closing(Executor(replace(plan, settings=settings))) as executor:
        result, values = executor.run_whole(row_of(run), trace, report)
    found = {
        "parameters": values,
        "steps": result.steps,
        "time": result.time,
        "digest": result.digest,
    }
    wrong = [
        f"{name} {run[name]} was stored, the result is {value}"
        for name, value in found.items()
        if run[name] is not None and run[name] != value
    ]
    if wrong:
        raise CampaignError(
            f"{store.path}: row {number} differs from the stored run: {'; '.join(wrong)}"
        )
    return plan.scenario, result
