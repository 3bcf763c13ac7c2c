"""Tests of scenarios, with pytest: freshness of generated files, measures of runs.

    from osc2tx.testing import assert_build_fresh, run_scenario

    def test_generated_files_are_up_to_date():
        assert_build_fresh("scenarios", "generated")

    def test_the_cut_in_is_close_but_safe():
        run = run_scenario("scenarios/cut_in.osc", seed=7)
        assert run.status == "success"
        assert not run.collisions

    @pytest.mark.campaign("scenarios/cut_in.osc", samples=50)
    def test_each_cut_in_leaves_room(row):
        assert row.kpi("min_gap") > 1.0

pytest finds the module as a plugin: its assertions explain themselves, and
`pytest --update-generated` writes the files that `assert_build_fresh` finds to differ.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from osc2tx.testing.campaigns import Campaign, CampaignRow, run_campaign
from osc2tx_shared.classes import dataclass, replace

if TYPE_CHECKING:
    import pytest

    from osc2tx_runtime import Scenario

__all__ = [
    "Campaign",
    "CampaignRow",
    "Line",
    "Run",
    "assert_build_fresh",
    "run_campaign",
    "run_scenario",
]

Line: TypeAlias = dict[str, Any]
"""One line of a trace (docs/trace.md)."""

_OPTION = "--update-generated"
_updates = False  # whether pytest was started with it


def pytest_addoption(parser: pytest.Parser, pluginmanager: pytest.PytestPluginManager) -> None:
    """Add the option, and those of scenarios as tests; called by pytest."""
    help = "let assert_build_fresh write changed files instead of failing"
    parser.getgroup("osc2tx").addoption(_OPTION, action="store_true", help=help)
    from osc2tx.testing import scenario_tests

    pluginmanager.register(scenario_tests, "osc2tx-scenarios")


def pytest_configure(config: pytest.Config) -> None:
    """Take the option, and add the mark of campaigns; called by pytest."""
    global _updates
    _updates = bool(config.getoption(_OPTION))
    from osc2tx.testing import rows as testing_rows

    config.pluginmanager.register(testing_rows, "osc2tx-rows")


def assert_build_fresh(
    sources: str | Path | Sequence[str | Path], generated: str | Path, *, update: bool = False
) -> None:
    """Assert that `osc2tx build SOURCES -o GENERATED` would change nothing.

    Args:
        sources: Files and folders of scenarios.
        generated: Folder of the outputs.
        update: Write changed files instead of failing, as under `pytest --update-generated`.

    Raises:
        AssertionError: If a source has errors, or an output is stale, missing, edited by hand or
            orphaned; the message lists them and shows how the modules would change.
        InputError: If a source does not exist.
    """
    __tracebackhide__ = True
    from osc2tx.building.build import BuildOptions, build
    from osc2tx.compilation.file_reports import apply_suppressions
    from osc2tx.config import GivenOptions
    from osc2tx.diagnostics import Severity

    paths = [sources] if isinstance(sources, str | Path) else list(sources)
    writes = update or _updates
    options = BuildOptions(check_only=not writes, want_texts=not writes)
    result = build(paths, Path(generated), GivenOptions(), options)
    problems = [
        *(
            f"{found.primary}: {found.code}: {found.message}"
            for found in apply_suppressions(result.results).shown
            if found.severity is Severity.ERROR
        ),
        *result.bugs,
        *result.collisions,
        *result.failures,
        *(f"{change.path}: {change.state.value}" for change in result.remaining()),
    ]
    if problems:
        texts = (_difference(change.path, change.text) for change in result.remaining())
        raise AssertionError("\n".join([*problems, "", "".join(texts)]).rstrip())


def _difference(path: Path, wanted: str | None) -> str:
    from osc2tx.building.compare import diff_lines

    if wanted is None:
        return ""
    found = path.read_text(encoding="utf-8") if path.is_file() else None
    return "".join(diff_lines(str(path), found, wanted))


@dataclass(frozen=True, slots=True)
class Run:
    """A run of a scenario, with queries for tests.

    Attributes:
        status: `success`, `failure` or `timeout`.
        reason: Why it is not `success`.
        time: Simulated seconds.
        lines: The trace.
        warnings: Warnings of the run.
    """

    status: str
    reason: str
    time: float
    lines: tuple[Line, ...]
    warnings: tuple[str, ...]

    def __repr__(self) -> str:
        """Return one line, for messages of assertions: the trace has thousands."""
        reason = f": {self.reason}" if self.reason else ""
        return f"<Run: {self.status} after {self.time:.2f} s{reason}>"

    def of_kind(self, kind: str) -> list[Line]:
        """Return the lines of a kind, in order."""
        return [line for line in self.lines if line["kind"] == kind]

    @property
    def collisions(self) -> list[Line]:
        """The contacts between actors."""
        return self.of_kind("collision")

    def states(self, actor: str) -> list[Line]:
        """Return the states of an actor, one for each step: x, y (m), h (rad), v (m/s)."""
        return [line for line in self.of_kind("state") if line["actor"] == actor]

    def state(self, actor: str, time: float) -> Line:
        """Return the state of an actor at the step nearest to a time in seconds."""
        states = self.states(actor)
        assert states, f"{actor} has no states"
        return min(states, key=lambda line: abs(line["t"] - time))

    def events(self, name: str) -> list[float]:
        """Return the times in seconds at which an event occurs."""
        return [line["t"] for line in self.of_kind("event") if line["name"] == name]

    def event(self, name: str) -> float:
        """Return the time in seconds at which an event occurs; it occurs once."""
        times = self.events(name)
        assert len(times) == 1, f"{name} occurs {len(times)} times: {times}"
        return times[0]

    def actions(self, source: str, status: str = "start") -> list[float]:
        """Return when the action of a source line, `cut_in.osc:30`, has a status, in seconds."""
        return [
            line["t"]
            for line in self.of_kind("action")
            if line["source"] == source and line["status"] == status
        ]


def run_scenario(path: str | Path, *, scenario: str | None = None, **settings: Any) -> Run:
    """Run a scenario file, or a module made from one, in the embedded world.

    Args:
        path: The file; settings of `osc2tx.toml` apply as for `osc2tx run`.
        scenario: Its name; the last one of the file if left out.
        **settings: Fields of `osc2tx_runtime.RunSettings`, as `seed=7` or `set={"gap": 12.0}`.

    Raises:
        AssertionError: If the source has errors; the message lists them.
        ScenarioError: If the scenario cannot be run.
        InputError: If there is no such file.
    """
    from osc2tx.cli.run import choose_scenario, merge_settings
    from osc2tx.config import ConfigFiles
    from osc2tx_runtime import run_scenario as run

    path = Path(path)
    stated = merge_settings(ConfigFiles().for_source(path), path, {})
    with _scenarios(path) as scenarios:
        chosen = choose_scenario(scenarios, scenario, path)
        result = run(chosen, replace(stated, **settings))
    lines = tuple(json.loads(line) for line in result.trace_lines)
    return Run(result.status, result.reason, result.time, lines, result.warnings)


@contextmanager
def _scenarios(path: Path) -> Iterator[Mapping[str, type[Scenario]]]:
    from osc2tx.building.jobs import compile_all
    from osc2tx.compilation.inputs import find_inputs
    from osc2tx.compilation.needed_modules import sibling_modules
    from osc2tx.config import GivenOptions
    from osc2tx.diagnostics.render import render_all
    from osc2tx.module_loading import scenarios_of_file, scenarios_of_module

    find_inputs([path])  # rejects missing files
    if path.suffix == ".py":
        with scenarios_of_file(path, f"osc2tx_testing_{path.stem}") as scenarios:
            yield scenarios
        return
    (compilation,) = compile_all([path], GivenOptions())
    module = compilation.module
    assert module is not None, render_all(compilation.diagnostics) or f"{path} has no scenario"
    with scenarios_of_module(module, sibling_modules(compilation)) as scenarios:
        yield scenarios
