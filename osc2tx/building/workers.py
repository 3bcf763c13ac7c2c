"""Compiles many files, in several processes if that is worth it.

Results come in the order of the jobs, whoever makes them. A process that dies, as by an overflow of
its stack, costs the file that killed it and no other.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import TYPE_CHECKING

from osc2tx.building.jobs import Job
from osc2tx.building.results import FileResult, compile_job, failed_job

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Memory

FEWEST_FILES = 8  # for a second process: starting one takes as long as compiling a few files

Progress = Callable[[int], None]

_memory: Memory = {}
"""Of a worker, which ends with the build."""


def processors() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def compile_jobs(
    jobs: Sequence[Job], workers: int, progress: Progress = lambda done: None
) -> list[FileResult]:
    """Return the results of all jobs, in their order.

    Args:
        jobs: What to compile.
        workers: How many processes may work at once.
        progress: Is told now and then how many files are done.
    """
    if workers == 1 or len(jobs) < FEWEST_FILES:
        results: list[FileResult] = []
        memory: Memory = {}
        for job in jobs:
            results.append(compile_job(job, memory))
            progress(len(results))
        return results
    first = compile_job(jobs[0])  # loads the compiler, which forked processes then share
    progress(1)
    found = _compile_in_pool(jobs[1:], workers, lambda done: progress(1 + done))
    return [first, *(found.get(job) or _compile_alone(job) for job in jobs[1:])]


def with_siblings(
    results: Sequence[FileResult], compile: Callable[[Sequence[Job]], list[FileResult]]
) -> list[FileResult]:
    """Return results, and those of imported files whose modules they need and that are not there.

    Args:
        results: What came of some files.
        compile: Gives the results of jobs.
    """
    found = list(results)
    known = {os.path.realpath(result.job.path) for result in results}
    new = found
    while new:
        jobs: dict[str, Job] = {}
        for result in new:
            for each in result.imported:
                place = os.path.realpath(each.path)
                if each.is_needed and place not in known:
                    jobs[place] = result.job.for_module_of(Path(each.path), each.name)
        known |= jobs.keys()
        new = compile(list(jobs.values())) if jobs else []
        found += new
    return found


def _compile_in_pool(
    jobs: Sequence[Job], workers: int, progress: Progress
) -> dict[Job, FileResult]:
    """Return the results that came in before a process died, if one did."""
    found: dict[Job, FileResult] = {}
    with _pool(min(workers, len(jobs))) as pool:
        futures = {pool.submit(_compile_in_worker, job): job for job in jobs}
        try:
            for future in as_completed(futures):
                found[futures[future]] = future.result()
                progress(len(found))
        except BrokenExecutor:
            found.update(_rescued(futures))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return found


def _compile_in_worker(job: Job) -> FileResult:
    return compile_job(job, _memory)


def _rescued(futures: dict[Future[FileResult], Job]) -> dict[Job, FileResult]:
    return {
        job: future.result()
        for future, job in futures.items()
        if future.done() and not future.cancelled() and future.exception() is None
    }


def _compile_alone(job: Job) -> FileResult:
    """Compile a file in a process of its own, so that it harms no other."""
    with _pool(1) as pool:
        try:
            return pool.submit(compile_job, job).result()
        except BrokenExecutor:
            return failed_job(job, f"{job.path}: internal error: the compiler died")


def _pool(workers: int) -> ProcessPoolExecutor:
    import multiprocessing

    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("fork" if "fork" in methods else "spawn")
    return ProcessPoolExecutor(workers, mp_context=context, initializer=_begin_worker)


def _begin_worker() -> None:
    """Leave interruptions to the parent, and end with it even if it is killed."""
    import multiprocessing
    import signal
    from multiprocessing.connection import wait
    from threading import Thread

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None, "a worker is a child"

    def end_with_parent(sentinel: int = parent.sentinel) -> None:
        wait([sentinel])
        os._exit(1)

    Thread(target=end_with_parent, daemon=True).start()
