"""The build: finds jobs, loads or compiles results, compares with the folder, writes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from osc2tx.building.jobs import Job, find_jobs
from osc2tx.building.lock import only_build
from osc2tx.building.plan import (
    PROTECTED,
    Folder,
    Orphan,
    Planned,
    Scope,
    State,
    find_orphans,
    place_outputs,
)
from osc2tx.building.result_cache import ResultCache
from osc2tx.building.results import FileResult, with_severities
from osc2tx.building.workers import Progress, compile_jobs, no_progress, with_siblings
from osc2tx.building.write import Update, update_folder
from osc2tx.building.written_digests import read_digests
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.support.paths import is_committed, real_path
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class BuildOptions:
    """How to build.

    Attributes:
        check_only: Write nothing, only find out what would change.
        force: Write also over what was edited by hand or is not ours.
        prune: Remove outputs whose source has vanished.
        workers: How many processes may compile.
        want_texts: Get the texts of all outputs that differ, even if they will not be written.
        cache: Folder of earlier results; in the user's cache if left out.
    """

    check_only: bool = False
    force: bool = False
    prune: bool = False
    workers: int = 1
    want_texts: bool = False
    cache: Path | None = None


@dataclass(frozen=True, slots=True)
class Change:
    """An output that is not as the sources make it.

    Attributes:
        path: The file.
        state: Its state, before it was written.
        text: Its expected text; `None` for an orphan, or if texts were not requested.
        origin: For an orphan, the source that made it.
        is_untouched: For an orphan, whether it is unchanged since osc2tx wrote it.
    """

    path: Path
    state: State
    text: str | None = None
    origin: str = ""
    is_untouched: bool = True


@dataclass(frozen=True, slots=True)
class BuildResult:
    """The result of a build, or with `check_only` of a build that writes nothing.

    Attributes:
        results: One for each source file, in order.
        modules: How many sources make outputs.
        changes: Outputs that were not as they should be, in order.
        written: What was written or removed.
        collisions: Outputs without a place of their own, a sentence each; none is written.
        failures: Outputs that could not be written, a sentence each.
    """

    results: tuple[FileResult, ...]
    modules: int
    changes: tuple[Change, ...]
    written: tuple[Path, ...]
    collisions: tuple[str, ...]
    failures: tuple[str, ...]

    @property
    def bugs(self) -> tuple[str, ...]:
        """Internal errors of osc2tx; the outputs concerned are not made."""
        return tuple(result.bug for result in self.results if result.bug)

    def remaining(self) -> tuple[Change, ...]:
        """Return the outputs that are still not as they should be."""
        done = set(self.written)
        return tuple(change for change in self.changes if change.path not in done)


def build(
    paths: Sequence[str | Path],
    out_dir: Path,
    given: GivenOptions,
    options: BuildOptions | None = None,
    *,
    configs: ConfigFiles | None = None,
    progress: Progress = no_progress,
    waiting: Callable[[str], None] = lambda process: None,
) -> BuildResult:
    """Compile sources and write their outputs.

    Args:
        paths: Files and folders.
        out_dir: Folder of the outputs; made when needed.
        given: Options that precede those of settings files.
        options: How to build.
        configs: The settings files, if the caller needs them afterwards.
        progress: Called with the numbers of compiled files and of all files.
        waiting: Called with the process that builds into the same folder, before waiting for it.

    Raises:
        InputError, ConfigError: As `find_jobs`.
    """
    options = options or BuildOptions()
    configs = configs or ConfigFiles()
    jobs = find_jobs(paths, given, configs)
    asked = tuple(real_path(Path(path)) for path in paths if Path(path).is_dir())
    scope = Scope(_all_roots(jobs), asked)
    if options.check_only:
        return _Build(out_dir, options, configs, progress).run(jobs, scope)
    with only_build(out_dir, waiting):
        return _Build(out_dir, options, configs, progress).run(jobs, scope)


def _all_roots(jobs: Sequence[Job]) -> tuple[Path, ...]:
    """Return all folders in which sources of the jobs' projects can be."""
    kinds = {(job.roots, job.options.import_paths): None for job in jobs}
    folders = (each for roots, libraries in kinds for each in (*roots, *map(Path, libraries)))
    return tuple(dict.fromkeys(map(real_path, folders)))


class _Build:
    def __init__(
        self, out_dir: Path, options: BuildOptions, configs: ConfigFiles, progress: Progress
    ) -> None:
        self.out_dir = out_dir
        self.options = options
        self.configs = configs
        self.progress = progress
        self.written = read_digests(out_dir)
        self.folder = Folder(out_dir, self.written)
        self.memory = ResultCache("build", configs, options.cache)
        self.failures: list[str] = []

    def run(self, jobs: Sequence[Job], scope: Scope) -> BuildResult:
        results = self._compile(jobs)
        made = with_siblings(results, self._compile, self.configs)
        self.memory.close()
        results += [sibling for sibling in made[len(results) :] if sibling.bug]
        placed, collisions = place_outputs(made)
        states = self._states(placed)
        orphans = list(find_orphans(placed, made, scope, self.folder))
        changes = self._changes(placed, states, orphans)
        written: list[str] = []
        if not self.options.check_only:
            update = self._update(placed, states, orphans)
            written, failures = update_folder(self.out_dir, self.written, update)
            self.failures += failures
        return BuildResult(
            results=tuple(with_severities(results, self.configs)),
            modules=len({planned.result.job for planned in placed}),
            changes=tuple(sorted(changes, key=lambda change: change.path)),
            written=tuple(self.out_dir / path for path in written),
            collisions=tuple(f"{self.out_dir}/{problem}" for problem in collisions),
            failures=tuple(self.failures),
        )

    def _compile(self, jobs: Sequence[Job]) -> list[FileResult]:
        """Return the results of all jobs, with texts of all outputs that may be written."""
        known = self.memory.load_all(jobs)
        placed, _ = place_outputs(list(known.values()))
        for planned in placed:
            if self._needs_text(planned) and (job := planned.result.job) in known:
                whole = self.memory.with_texts(known.pop(job))
                known |= {job: whole} if whole is not None else {}
        results = compile_jobs(jobs, self.options.workers, self.memory, known, self.progress)
        if len(known) < len(jobs):
            self.folder.look_again()
        return results

    def _needs_text(self, planned: Planned) -> bool:
        try:
            state = self.folder.state_of(planned)
        except OSError:
            return False
        if self._may_be_absent(planned, state):
            return False
        is_kept = state in PROTECTED and not self.options.force
        may_be_shown = self.options.want_texts or not (self.options.check_only or is_kept)
        return state is not State.CURRENT and may_be_shown

    def _may_be_absent(self, planned: Planned, state: State) -> bool:
        """Whether an output is dispensable: a check does not require uncommitted files."""
        is_asked = not self.options.check_only or planned.is_committed
        return not is_asked and state is not State.FOREIGN

    def _states(self, placed: Sequence[Planned]) -> dict[str, State]:
        """Return the state of every output; an unknown state is a failure."""
        states = {}
        for planned in placed:
            try:
                states[planned.path] = self.folder.state_of(planned)
            except OSError as error:
                place = self.out_dir / planned.path
                self.failures.append(f"{place}: cannot be written: {error.strerror}")
        return states

    def _update(
        self, placed: Sequence[Planned], states: dict[str, State], orphans: Sequence[Orphan]
    ) -> Update:
        force, prune = self.options.force, self.options.prune
        removals = [
            orphan
            for orphan in orphans
            if (prune or orphan.is_outdated) and (orphan.is_untouched or force)
        ]
        listed = {planned.owned for planned in placed} | {orphan.path for orphan in orphans}
        return Update(
            current=[p for p in placed if states.get(p.path) is State.CURRENT],
            writes=[
                (planned, planned.made.text)
                for planned in placed
                if planned.made.text is not None
                and (state := states.get(planned.path)) is not None
                and state is not State.CURRENT
                and (force or state not in PROTECTED)
            ],
            removals=removals,
            forgotten=[p for p in self.written if p not in listed and self.folder.is_missing(p)],
        )

    def _changes(
        self, placed: Sequence[Planned], states: dict[str, State], orphans: Sequence[Orphan]
    ) -> list[Change]:
        changes = [
            Change(self.out_dir / planned.path, state, planned.made.text)
            for planned in placed
            if (state := states.get(planned.path)) not in (None, State.CURRENT)
            and not self._may_be_absent(planned, state)
        ]
        changes += [
            Change(
                self.out_dir / orphan.path,
                State.ORPHANED,
                origin=orphan.source,
                is_untouched=orphan.is_untouched,
            )
            for orphan in orphans
            if not self.options.check_only or is_committed(orphan.path)
        ]
        return changes
