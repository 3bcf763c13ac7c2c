"""Compiled scenario files of a test session; results of builds are reused."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from osc2tx.building.baseline import Baselines
from osc2tx.building.jobs import Job, find_jobs
from osc2tx.building.plan import place_outputs
from osc2tx.building.result_cache import ResultCache
from osc2tx.building.severities import Severities
from osc2tx.building.workers import Progress, compile_jobs, no_progress, with_siblings
from osc2tx.compilation.file_reports import apply_suppressions
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Severity
from osc2tx.diagnostics.render import render_all
from osc2tx.support.paths import MODULE, real_path
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx.building.results import FileResult
    from osc2tx.compilation.file_reports import LossEntry
    from osc2tx_runtime import Scenario


class CompiledSources:
    """Compiles files on first use, and imports their modules.

    Attributes:
        configs: The settings files.
    """

    def __init__(self, cache: Path | None = None, *, with_xml: bool = False) -> None:
        """Begin with nothing compiled.

        Args:
            cache: Folder of earlier results; in the user's cache if left out.
            with_xml: Whether the results include the scenarios as XML.
        """
        self._with_xml = with_xml
        self.configs = ConfigFiles()
        self._severities = Severities(self.configs)
        self._memory = ResultCache("build", self.configs, cache)
        self._results: dict[Path, FileResult] = {}
        self._folder: tempfile.TemporaryDirectory[str] | None = None

    def close(self) -> None:
        """Remove the modules."""
        self._memory.close()
        if self._folder is not None:
            self._folder.cleanup()

    def is_source(self, path: Path) -> bool:
        """Return whether a file is one of the `sources` of its project."""
        return self.configs.for_source(path).is_source(path)

    def prepare(
        self,
        places: Iterable[Path],
        workers: int,
        progress: Progress = no_progress,
    ) -> None:
        """Compile the sources of projects that are in some places, in several processes.

        Args:
            places: Files and folders.
            workers: How many processes may compile.
            progress: Called with the numbers of compiled files and of all files.
        """
        wanted: list[Path] = []
        for place in places:
            sources = self.configs.for_folder(place if place.is_dir() else place.parent).sources
            for source in map(real_path, sources):
                inner = source if source.is_relative_to(real_path(place)) else place
                if inner.exists() and (inner is source or real_path(place).is_relative_to(source)):
                    wanted += [inner] if inner.is_file() else sorted(inner.rglob("*.osc"))
        if wanted:
            jobs = find_jobs(list(dict.fromkeys(wanted)), GivenOptions(), self.configs)
            self._keep(self._compile(jobs, workers, progress))

    def values(self) -> Iterator[Mapping[str, str]]:
        """Yield what each scenario fixes."""
        for result in self._results.values():
            yield from (entry.values for entry in result.scenarios)

    def result(self, path: Path) -> FileResult:
        """Return the result of a file; the text of its module may not be in hand."""
        place = real_path(path)
        if place not in self._results:
            jobs = find_jobs([path], GivenOptions(), self.configs)
            self._keep(self._compile(jobs, 1))
        return self._results[place]

    def problems(self, path: Path) -> str:
        """Return the errors of a file, as `osc2tx check` prints them; empty if there are none.

        New warnings that settings make errors are among them: `osc2tx run` runs no such file.
        """
        result = self.result(path)
        reported = apply_suppressions([result], self._severities).shown
        shown = Baselines(self.configs).new_among(reported)
        errors = [report for report in shown if report.severity is Severity.ERROR]
        if result.source is None and not errors:
            return f"{path}: cannot be read"
        return "\n".join(filter(None, (render_all(errors, folder=Path.cwd()), result.bug)))

    def losses(self) -> list[LossEntry]:
        """Return the results of the scenarios as XML, in the order of their files."""
        results = sorted(self._results.items())
        return [loss for _, result in results for loss in result.losses]

    @contextmanager
    def scenarios(self, path: Path) -> Iterator[Mapping[str, type[Scenario]]]:
        """Give the scenario classes of the module of a file, by names in the source.

        Raises:
            ScenarioError: A value of a type cannot be computed.
        """
        from osc2tx.module_loading import scenarios_of_file
        from osc2tx_runtime import ScenarioError

        made = with_siblings([self.result(path)], lambda jobs: self._compile(jobs, 1), self.configs)
        main = self._write(made)
        try:
            with scenarios_of_file(main, f"osc2tx_test_{main.stem}") as scenarios:
                yield scenarios
        except ArithmeticError as error:
            raise ScenarioError(f"a value cannot be computed: {error}", path.name) from error

    def _keep(self, results: Iterable[FileResult]) -> None:
        self._results |= {real_path(result.job.path): result for result in results}

    def _compile(
        self,
        jobs: Sequence[Job],
        workers: int,
        progress: Progress = no_progress,
    ) -> list[FileResult]:
        """Return results that have a module; XML is made on request."""
        known: dict[Job, FileResult] = {}
        wanted: list[Job] = []
        for job in jobs:
            alone = self._with_module(job)
            kinds = (alone,) if job.options.target == "xosc" else (job, alone)
            found = next((each for kind in kinds if (each := self._memory.load(kind))), None)
            known |= {found.job: found} if found is not None else {}
            wanted.append(alone if found is None else found.job)
        return compile_jobs(wanted, workers, self._memory, known, progress)

    def _with_module(self, job: Job) -> Job:
        if self._with_xml and job.options.target != "xosc":
            return job
        if self._with_xml:
            return replace(job, options=replace(job.options, target="all"))
        return replace(job, options=replace(job.options, target="py"))

    def _write(self, results: Sequence[FileResult]) -> Path:
        """Write modules that are not there yet; return the place of the first."""
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="osc2tx-test-")
        folder = Path(self._folder.name)
        main = Path()
        for result in results:
            placed, _ = place_outputs([result])
            modules = [folder / each.path for each in placed if each.path.endswith(MODULE)]
            main = modules[0] if result is results[0] else main
            if all(module.exists() for module in modules):
                continue
            whole = self._with_texts(result)
            for each in place_outputs([whole])[0]:
                place = folder / each.path
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_text(each.made.text or "", encoding="utf-8")
        return main

    def _with_texts(self, result: FileResult) -> FileResult:
        if all(made.text is not None for made in result.outputs):
            return result
        return self._memory.with_texts(result) or compile_jobs([result.job], 1)[0]
