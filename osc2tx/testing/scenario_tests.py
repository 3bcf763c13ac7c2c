"""Scenarios as tests: pytest collects the `.osc` files of a project, one test for each scenario.

Collected are files among the `sources` of their settings, and files that are named. A test passes
if the run ends with the `verdict` that the settings expect, which is `success` unless stated.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from osc2tx.compilation.inputs import InputError
from osc2tx.config import ConfigError
from osc2tx.testing.result_properties import EXPECTED, REASON, TRACE, VERDICT, VIOLATION
from osc2tx.testing.scenario_selection import is_worker, report_unknown_names

if TYPE_CHECKING:
    from osc2tx.diagnostics.report import ScenarioEntry
    from osc2tx.testing.compiled_sources import CompiledSources
    from osc2tx.testing.page import PageOfProject

SUFFIX = ".osc"
_SOURCES = pytest.StashKey["CompiledSources"]()
_PAGE: pytest.StashKey[PageOfProject] = pytest.StashKey()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options; called by pytest."""
    group = parser.getgroup("osc2tx")
    group.addoption("--osc-fail-on", action="append", default=[], metavar="WHAT", help="as of run")
    group.addoption("--osc-traces", metavar="DIR", help="write traces, their pages and an index")
    group.addoption("--osc-page", metavar="FILE", help="write the page of the project")
    group.addoption(
        "--osc-campaign",
        action="append",
        default=[],
        metavar="STORE",
        help="list a campaign on the page",
    )
    group.addoption("--osc-cache-dir", metavar="DIR", help="folder of earlier results of builds")
    group.addoption("--osc-jobs", type=int, metavar="N", help="processes that compile")


def pytest_configure(config: pytest.Config) -> None:
    """Begin the page of the project; called by pytest."""
    page = config.getoption("osc_page")
    if page and not is_worker(config):
        from osc2tx.testing.page import PageOfProject

        stores = [Path(each) for each in config.getoption("osc_campaign")]
        config.stash[_PAGE] = PageOfProject(Path(page), stores)
        config.pluginmanager.register(config.stash[_PAGE])


def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile the files of the session before processes of pytest-xdist do; called by pytest."""
    config = session.config
    if is_worker(config):
        return
    from osc2tx.building.workers import processors
    from osc2tx.cli.progress import progress_bar
    from osc2tx_shared.cache import cache_folder

    sources = _sources(config)
    places = [config.invocation_params.dir / each.split("::")[0] for each in config.args]
    workers = config.getoption("osc_jobs") or processors()
    cache = config.getoption("osc_cache_dir")
    is_kept = cache_folder(Path(cache) if cache else None) is not None
    try:
        with progress_bar("compiling", is_kept=is_kept) as progress:
            sources.prepare((place for place in places if place.exists()), workers, progress)
    except (ConfigError, InputError) as error:
        raise pytest.UsageError(str(error)) from None
    report_unknown_names(config, {name for values in sources.values() for name in values})


def pytest_unconfigure(config: pytest.Config) -> None:
    """Remove the modules; called by pytest."""
    if _SOURCES in config.stash:
        config.stash[_SOURCES].close()


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect a scenario file; called by pytest for each file."""
    if file_path.suffix != SUFFIX:
        return None
    is_named = parent.session.isinitpath(file_path)
    try:
        if not is_named and not _sources(parent.config).is_source(file_path):
            return None
    except ConfigError as error:
        raise pytest.UsageError(str(error)) from None
    return ScenarioFile.from_parent(parent, path=file_path)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Make the pages of all traces, and of the project; called by pytest."""
    config = session.config
    traces = config.getoption("osc_traces")
    if is_worker(config) or not (traces or _PAGE in config.stash):
        return  # without the imports below, which load numpy
    from osc2tx.campaigns import CampaignError
    from osc2tx_runtime.errors import InputError as TraceError
    from osc2tx_runtime.errors import ScenarioError

    try:
        if traces and Path(traces).is_dir():
            from osc2tx_runtime.running.trace_reports import folder_report

            maps = [*map(Path, _sources(config).configs.for_folder(Path.cwd()).map_paths)]
            folder_report(Path(traces), Path(traces), maps)
        if _PAGE in config.stash:
            config.stash[_PAGE].write(_sources(config).losses())
    except TraceError as error:  # nothing ran
        config.issue_config_time_warning(pytest.PytestWarning(str(error)), 2)
    except (CampaignError, ScenarioError) as error:
        raise pytest.UsageError(str(error)) from None


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print a table of the scenarios that failed; called by pytest."""
    failed = sorted(
        (*report.nodeid.split("::", 1), *(properties[key] for key in (VERDICT, EXPECTED, REASON)))
        for report in terminalreporter.stats.get("failed", ())
        if VERDICT in (properties := dict(report.user_properties))
    )
    if not failed:
        return
    terminalreporter.section("scenarios that failed")
    rows = [("file", "scenario", "verdict", "expected", "reason"), *failed]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]) - 1)]
    for *first, reason in rows:
        cells = [text.ljust(width) for text, width in zip(first, widths, strict=True)]
        terminalreporter.line("  ".join((*cells, reason)).rstrip())


class ScenarioFile(pytest.File):
    """A scenario file: a test for each scenario that can run by itself."""

    def collect(self) -> Iterator[ScenarioItem]:
        """Yield the tests; one that fails for a file with errors."""
        sources = _sources(self.config)
        verdict = sources.configs.for_source(self.path).verdict(self.path)
        if verdict == "skip":
            return
        if sources.problems(self.path):
            yield ScenarioItem.from_parent(self, name=self.path.stem, entry=None, verdict=verdict)
            return
        for entry in sources.result(self.path).scenarios:
            if entry.is_runnable:
                yield ScenarioItem.from_parent(self, name=entry.name, entry=entry, verdict=verdict)


class ScenarioItem(pytest.Item):
    """A run of a scenario, with the settings of its file.

    Attributes:
        entry: The data of the scenario; `None` for a file with errors.
        funcargs: Values of fixtures, of which it has none; other plugins ask every item for them.
    """

    def __init__(self, *, entry: ScenarioEntry | None, verdict: str, **more: Any) -> None:
        """Store the scenario.

        Args:
            entry: Its data.
            verdict: The expected verdict.
            **more: As of `pytest.Item`.
        """
        super().__init__(**more)
        self.entry = entry
        self.funcargs: dict[str, object] = {}
        self._verdict = verdict
        if entry is not None:
            self.user_properties += entry.values.items()

    def runtest(self) -> None:
        """Run the scenario.

        Raises:
            UnexpectedVerdict: It does not end as expected.
        """
        verdict, reason, text = self._run()
        said = {VERDICT: verdict, EXPECTED: self._verdict, REASON: reason}
        if any(map(os.path.exists, trace := self._trace())):
            said[TRACE] = trace[0]
        self.user_properties += said.items()
        if verdict != self._verdict:
            expected = f"expected: {self._verdict}\n" if self._verdict != "success" else ""
            raise UnexpectedVerdict(f"{expected}{text}")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return the text of a failure."""
        if isinstance(excinfo.value, UnexpectedVerdict):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Return file, line and name, for reports."""
        return self.path, None, self.name

    def _run(self) -> tuple[str, str, str]:
        """Return the verdict, its reason in one line, and the full text."""
        from osc2tx.cli.run import merge_texts, settings_from
        from osc2tx_runtime import ScenarioError, run_scenario
        from osc2tx_runtime.errors import SettingsError, coded
        from osc2tx_runtime.running.main import verdict as lines_of

        sources = _sources(self.config)
        problems = sources.problems(self.path)
        if problems:
            return "error", problems.splitlines()[0], problems
        fail_on = tuple(self.config.getoption("osc_fail_on"))
        given = {"fail-on": fail_on, "trace": self._trace()}
        shown = _seen_from_here(self.path)
        try:
            config = sources.configs.for_source(self.path)
            settings = settings_from(merge_texts(config, self.path, given), self.path)
            with sources.scenarios(self.path) as scenarios:
                scenario = scenarios[self.name]
                result = run_scenario(scenario, settings, keep_trace=False)
        except (ConfigError, SettingsError) as error:
            return "error", str(error), str(error)
        except ScenarioError as error:
            return "error", str(error), error.report(self.path.name, shown)
        self.user_properties += [
            (VIOLATION, coded(each.code, str(each), each.source, scenario.source, shown))
            for each in result.violations
        ]
        told = "\n".join(lines_of(self.name, result, scenario.source, shown))
        again = f"osc2tx run {shown} --scenario {self.name}"
        again += "".join(f" --fail-on {each}" for each in fail_on)
        return result.status, result.reason, f"{told}\n{again}"

    def _trace(self) -> tuple[str, ...]:
        """Return the path of the trace: that of its source, one for each scenario."""
        from osc2tx.support.paths import file_stem

        folder = self.config.getoption("osc_traces")
        if not folder:
            return ()
        result = _sources(self.config).result(self.path)
        place = Path(folder, result.job.name).with_suffix("")
        inner = "" if place.name == self.name else f".{file_stem(self.name)}"
        place.parent.mkdir(parents=True, exist_ok=True)
        return (str(place.with_name(f"{place.name}{inner}.jsonl")),)


class UnexpectedVerdict(Exception):
    """A run does not end as expected."""


def _sources(config: pytest.Config) -> CompiledSources:
    if _SOURCES not in config.stash:
        from osc2tx.testing.compiled_sources import CompiledSources

        cache = config.getoption("osc_cache_dir")
        config.stash[_SOURCES] = CompiledSources(
            Path(cache) if cache else None, with_xml=bool(config.getoption("osc_page"))
        )
    return config.stash[_SOURCES]


def _seen_from_here(path: Path) -> str:
    here = Path.cwd()
    return str(path.relative_to(here) if path.is_relative_to(here) else path)
