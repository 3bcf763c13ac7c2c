"""Compiles or checks many files, in several processes if that is worth it.

Results come in the order of the jobs; those that are known are not made again, and new ones are
kept. A process that dies, as by an overflow of its stack, costs the file that killed it and no
other. What starts processes is imported only then: most commands compile one file.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache, partial
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from osc2tx.building.jobs import Job
from osc2tx.building.result_cache import ResultCache
from osc2tx.building.results import (
    FileResult,
    check_job,
    compile_job,
    failed_job,
    with_severities,
)

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from osc2tx.compilation.driver import Memory
    from osc2tx.config import ConfigFiles

FEWEST_FILES = 8  # for a second process: starting one takes as long as compiling a few files

Work = Callable[..., FileResult]
"""Activity on a job, with the memory of compilations."""

Finished = Callable[[FileResult], None]

Progress = Callable[[int, int], None]
"""Takes the numbers of files that are done, and of all."""

_memory: Memory = {}
"""Of a worker, which ends with the build."""


def no_progress(done: int, total: int) -> None:
    """Show nothing."""


def processors() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def compile_jobs(
    jobs: Sequence[Job],
    workers: int,
    memory: ResultCache | None = None,
    known: Mapping[Job, FileResult] | None = None,
    progress: Progress = no_progress,
) -> list[FileResult]:
    """Return the results of all jobs, in their order; first remove what killed builds have left.

    Args:
        jobs: What to compile.
        workers: How many processes may work at once.
        memory: Keeps each result as soon as there is one.
        known: Results that are there.
        progress: Called with the numbers of compiled files and of all files that are not known.
    """
    if any(job not in (known or {}) for job in jobs):
        from osc2tx_shared.own_folders import REVISION, remove_left_over

        remove_left_over(REVISION)
    work = partial(compile_job, findings=memory.findings if memory else None)
    return run_jobs(work, jobs, workers, memory, known, progress)


def check_jobs(
    jobs: Sequence[Job],
    *,
    remember: bool = True,
    workers: int | None = 1,
    progress: Progress = no_progress,
    configs: ConfigFiles,
    cache: Path | None = None,
) -> list[FileResult]:
    """Return the diagnostics of each file, in the order of the jobs.

    Args:
        jobs: What to check.
        remember: Whether results of earlier checks count, and these are kept.
        workers: Number of processes that may check; one for each processor if left open.
        progress: Called with the numbers of checked files and of all files that are not known.
        configs: The settings files.
        cache: Folder of the results; in the user's cache if left out.
    """
    memory = ResultCache("check", configs, cache) if remember else None
    known = memory.load_all(jobs) if memory else {}
    results = run_jobs(check_job, jobs, workers, memory, known, progress)
    if memory and len(known) < len(jobs):
        memory.close()
    return with_severities(results, configs)


def run_jobs(
    work: Work,
    jobs: Sequence[Job],
    workers: int | None,
    memory: ResultCache | None = None,
    known: Mapping[Job, FileResult] | None = None,
    progress: Progress = no_progress,
) -> list[FileResult]:
    """Return what some work makes of all jobs, in their order.

    Args:
        work: The activity on each job.
        jobs: The jobs.
        workers: Number of processes that may work at once; one for each processor if left open.
        memory: Keeps each result as soon as there is one.
        known: Results that are there.
        progress: Called with the numbers of jobs that are done and of all that are not known.
    """
    results = dict(known or {})
    missing = [job for job in jobs if job not in results]
    numbers = count(1)

    def done(result: FileResult) -> None:
        results[result.job] = result
        if memory is not None:
            memory.keep(result)
        progress(next(numbers), len(missing))

    workers = workers or processors()
    if workers == 1 or len(missing) < FEWEST_FILES:
        facts: Memory = {}
        for job in missing:
            done(work(job, facts))
        return [results[job] for job in jobs]
    done(work(missing[0], {}))  # loads the compiler, which forked processes then share
    _work_in_pool(work, missing[1:], workers, done)
    for job in missing[1:]:
        if job not in results:
            done(_work_in_own_process(work, job))
    return [results[job] for job in jobs]


def with_siblings(
    results: Sequence[FileResult],
    compile: Callable[[Sequence[Job]], list[FileResult]],
    configs: ConfigFiles,
) -> list[FileResult]:
    """Return results, and those of imported files whose modules are needed and missing.

    Args:
        results: The outcomes of some files.
        compile: Gives the results of jobs.
        configs: The settings files.
    """
    found = list(results)
    real = cache(os.path.realpath)
    known = {real(result.job.path) for result in results}
    new = found
    while new:
        jobs: dict[str, Job] = {}
        for result in new:
            for each in result.imported:
                if each.is_needed and (place := real(each.path)) not in known:
                    jobs[place] = result.job.for_module_of(Path(each.path), each.name, configs)
        known |= jobs.keys()
        new = compile(list(jobs.values())) if jobs else []
        found += new
    return found


def _work_in_pool(work: Work, jobs: Sequence[Job], workers: int, done: Finished) -> None:
    """Do the work in processes, until all is done or a process has died."""
    from concurrent.futures import BrokenExecutor, as_completed

    told: set[Job] = set()
    with _pool(min(workers, len(jobs))) as pool:
        futures = {pool.executor.submit(_work_in_worker, work, job): job for job in jobs}
        try:
            for future in as_completed(futures):
                done(future.result())
                told.add(futures.pop(future))
        except BrokenExecutor:
            for future, job in futures.items():
                if job not in told and future.done() and future.exception() is None:
                    done(future.result())


def _work_in_worker(work: Work, job: Job) -> FileResult:
    return work(job, _memory)


def _work_in_own_process(work: Work, job: Job) -> FileResult:
    """Do the work on a file in a process of its own, so that it harms no other."""
    from concurrent.futures import BrokenExecutor

    with _pool(1) as pool:
        try:
            return pool.executor.submit(_work_in_worker, work, job).result()
        except BrokenExecutor:
            return failed_job(job, f"{job.path}: internal error: the compiler died")


class _Pool:
    """Processes that end at once if they are no longer needed."""

    def __init__(self, workers: int) -> None:
        import multiprocessing
        from concurrent.futures import ProcessPoolExecutor

        methods = multiprocessing.get_all_start_methods()
        context = multiprocessing.get_context("fork" if "fork" in methods else "spawn")
        listener, self._speaker = context.Pipe(duplex=False)
        self.executor = ProcessPoolExecutor(
            workers, mp_context=context, initializer=_begin_worker, initargs=(listener,)
        )

    def stop(self) -> None:
        """End all processes immediately."""
        self._speaker.send(None)  # never received, so that every process sees it
        self.executor.shutdown(wait=False, cancel_futures=True)


@contextmanager
def _pool(workers: int) -> Iterator[_Pool]:
    pool = _Pool(workers)
    try:
        yield pool
    except BaseException:
        pool.stop()
        raise
    pool.executor.shutdown()


def _begin_worker(stop: Connection) -> None:
    """Leave interruptions to the parent, and end with it even if it is killed.

    Args:
        stop: Has something to read once the process is to end.
    """
    import multiprocessing
    import signal
    from multiprocessing.connection import wait
    from threading import Thread

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None, "a worker is a child"

    def end(*signs: int | Connection) -> None:
        wait(signs)
        os._exit(1)

    Thread(target=end, args=(parent.sentinel, stop), daemon=True).start()
