"""Checks files, or loads the results of an earlier check of the same texts."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from osc2tx.building.jobs import Job
from osc2tx.building.result_cache import ResultCache
from osc2tx.building.results import FileResult, check_job


def check_jobs(jobs: Sequence[Job], *, remember: bool = True) -> list[FileResult]:
    """Return what there is to report on each file, in the order of the jobs.

    Args:
        jobs: What to check.
        remember: Whether results of earlier checks in this folder count, and these are kept.
    """
    if not remember:
        return [check_job(job) for job in jobs]
    memory = ResultCache("checks", Path.cwd())
    known = {job: result for job in jobs if (result := memory.load(job)) is not None}
    made = {job: check_job(job) for job in jobs if job not in known}
    if made:
        memory.keep(made.values())
    known |= made
    return [known[job] for job in jobs]
