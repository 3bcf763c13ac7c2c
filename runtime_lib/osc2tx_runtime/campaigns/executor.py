"""Runs rows of a campaign in this process, one after the other."""

from __future__ import annotations

import math
import time
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import ScenarioError, message_of, with_column
from osc2tx_runtime.kpis import Measuring, measures_by_name
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import to_json
from osc2tx_runtime.language.tree.coverage import Recording
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.running.runner import RunResult, run_scenario
from osc2tx_shared.classes import replace

from .modules import Modules, scenario_in
from .points import Point
from .rows import Plan, Row, RowResult

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Violation


class Executor:
    """Runs rows; the module and the map are read once.

    Args:
        plan: The common part of the rows.

    Raises:
        ScenarioError: The module cannot be imported, or a measure is unknown.
    """

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._measures = measures_by_name(plan.measures)
        self._modules = Modules(plan.files)
        self._scenario = scenario_in(self._modules.load(plan.module), plan.scenario)
        self._read = lru_cache(maxsize=4)(_read)

    def close(self) -> None:
        """Unload the module."""
        self._modules.close()

    def settings_of(self, row: Row) -> RunSettings:
        """Return the settings of a row."""
        draws = None if row.shares is None else Point(row.shares, row.seed)
        values = {**self._plan.settings.set, **row.set}
        return replace(self._plan.settings, seed=row.seed, set=values, draws=draws)

    def values_of(self, row: Row) -> tuple[dict[str, Any], Point | None]:
        """Return the values of a row, without running it, and the random numbers behind them.

        Raises:
            ScenarioError: No values exist, or they break a constraint.
        """
        settings = self.settings_of(row)
        scenario = self._scenario(settings)
        scenario.create_tree()  # scenarios that are invoked have values of their own
        assert settings.draws is None or isinstance(settings.draws, Point)
        return dict(scenario.parameters), settings.draws

    def sampling_scopes(self) -> list[tuple[str, str]]:
        """Return which scenarios sample coverage items: path of the invocation, and its name.

        Raises:
            ScenarioError: The scenario has no values.
        """
        tree = self._scenario(self.settings_of(Row(0, 0))).create_tree()
        nodes = (node for node in tree.iterate() if isinstance(node, Recording))
        return [(node.scope, node.scenario) for node in nodes]

    def map_path(self, row: Row) -> Path:
        """Return the file of the map that a row is on.

        Raises:
            ScenarioError: It does not exist.
        """
        settings = self.settings_of(row)
        return find_map(self._scenario(settings).map_file(), settings.map_path)

    def run_whole(
        self, row: Row, trace: Path | None, report: Path | None
    ) -> tuple[RunResult, dict[str, Any]]:
        """Run a row as `osc2tx run` does, with its trace; return its values too.

        Raises:
            ScenarioError: It cannot be run.
        """
        made: list[Scenario] = []

        def make(settings: RunSettings) -> Scenario:
            made.append(self._scenario(settings))
            return made[-1]

        settings = replace(self.settings_of(row), trace=trace, report=report)
        result = run_scenario(make, settings, keep_trace=False, digest=True)
        return result, dict(made[-1].parameters)

    def run(self, row: Row) -> RowResult:
        """Run a row; every failure of the scenario is part of the result."""
        begin = time.perf_counter()
        made: list[Scenario] = []

        def make(settings: RunSettings) -> Scenario:
            made.append(self._scenario(settings))
            return made[-1]

        measuring = Measuring(self._measures.values())
        status, reason, source, result = "error", "", None, None
        try:
            result = run_scenario(
                make,
                self.settings_of(row),
                keep_trace=False,
                digest=self._plan.digests,
                observer=measuring,
                read=lambda path: self._read(path, path.stat().st_mtime_ns),
            )
            status, reason = result.status, result.reason
        except ScenarioError as error:
            reason, source = error.message, error.source
        except Exception as error:  # internal, or of the user's code: it affects this row alone
            reason = f"internal error: {message_of(error)}"
        measures: dict[str, float | None] = {}
        try:
            measures = {
                name: value if value is None or math.isfinite(value) else None
                for name, value in measuring.results().items()
            }
        except ScenarioError as error:
            status, reason, source = "error", "; ".join(filter(None, (reason, error.message))), None
        broken = [text for each in self._plan.fail_if if (text := each.broken_by(measures))]
        if broken and status != "error":
            status, reason = "failure", "; ".join(filter(None, (*broken, reason)))
        return RowResult(
            row=row,
            values=dict(made[-1].parameters) if made else {},
            status=status,
            reason=reason,
            source=source,
            steps=0 if result is None else result.steps,
            time=0.0 if result is None else result.time,
            measures=measures,
            collisions=measuring.collisions,
            violations=() if result is None else tuple(map(reported, result.violations)),
            samples=tuple((kind, to_json(values)) for kind, values in measuring.samples),
            digest=None if result is None else result.digest,
            seconds=time.perf_counter() - begin,
        )


def reported(violation: Violation) -> str:
    """Return a condition that did not hold, as one line."""
    return f"{violation.code} {with_column(violation.source)}: {violation}"


def _read(path: Path, changed: int) -> RoadMap:
    return read_map(path)
