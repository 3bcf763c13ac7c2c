"""The mark `campaign` of pytest: a test for each row of a campaign."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import pytest

from osc2tx.testing.campaigns import plan_of, row_of, run_campaign

if TYPE_CHECKING:
    from osc2tx.testing.campaigns import CampaignRow
    from osc2tx_runtime.campaigns import Row

AnyT = TypeVar("AnyT")

TOGETHER = ("engine", "workers", "search", "search_batch", "store")
"""Arguments that are about all rows: with one of them no row is run alone."""


class MarkedRows:
    """The requests of tests; the last compilation and run are kept."""

    def __init__(self) -> None:
        self._key: object = None
        self._planned: _Planned | None = None
        self._together: Sequence[CampaignRow] | None = None

    def close(self) -> None:
        """Drop the kept compilation and run."""
        if self._planned is not None:
            self._planned.close()
        self._key = self._planned = self._together = None

    def indices(self, mark: pytest.Mark) -> range:
        """Return one index for each row; compiles only if the mark does not state the number."""
        samples = mark.kwargs.get("samples")
        return range(self._plan(mark).count() if samples is None else samples)

    def run(self, mark: pytest.Mark, index: int) -> CampaignRow:
        """Run the row with an index among those that keep the constraints.

        Raises:
            CampaignError: There are fewer rows.
        """
        if not mark.kwargs.keys() & set(TOGETHER):
            return self._plan(mark).run(index)
        self._turn_to(mark)
        if self._together is None:
            self._together = run_campaign(*mark.args, **mark.kwargs).rows
        return _at(self._together, index)

    def _plan(self, mark: pytest.Mark) -> _Planned:
        self._turn_to(mark)
        if self._planned is None:
            alone = {name: each for name, each in mark.kwargs.items() if name not in TOGETHER}
            self._planned = _Planned(*mark.args, **alone)
        return self._planned

    def _turn_to(self, mark: pytest.Mark) -> None:
        key = mark.args, repr(sorted(mark.kwargs.items()))
        if key != self._key:
            self.close()
            self._key = key


class _Planned:
    """Rows that are run one by one in this process; arguments as of `run_campaign`."""

    def __init__(
        self,
        path: str | Path,
        *,
        samples: int | None = None,
        sampler: str | None = None,
        scenario: str | None = None,
        levels: int = 5,
        kpi: Sequence[str] | None = None,
        fail_if: Sequence[str] = (),
        **options: Any,
    ) -> None:
        from osc2tx.campaigns.driver import make_sampler
        from osc2tx.campaigns.planner import Planner
        from osc2tx.campaigns.sampling import Findings, wanted_rows
        from osc2tx_runtime.campaigns import Executor

        self._path = Path(path)
        self._options: Mapping[str, Any] = options
        self._plan, _ = plan_of(self._path, scenario, kpi, fail_if, options)
        self._executor = Executor(self._plan)
        wanted = wanted_rows(self._plan, sampler, samples, levels)
        chosen = make_sampler(self._executor, wanted, Findings())
        planned = Planner(self._executor, chosen, samples, (), set()).rows()
        self._source = filter(None, planned)  # no search, which alone has rows to wait for
        self._rows: list[Row] = []

    def close(self) -> None:
        """Forget the module."""
        self._executor.close()

    def count(self) -> int:
        """Return how many rows there are."""
        self._rows += self._source
        return len(self._rows)

    def run(self, index: int) -> CampaignRow:
        """Run the row with an index."""
        while len(self._rows) <= index:
            row = next(self._source, None)
            if row is None:
                break
            self._rows.append(row)
        result = self._executor.run(_at(self._rows, index))
        return row_of(self._path, self._plan, result, self._options)


def _at(rows: Sequence[AnyT], index: int) -> AnyT:
    from osc2tx.campaigns import CampaignError

    if index >= len(rows):
        raise CampaignError(f"the sampler has {len(rows)} rows only: give samples=")
    return rows[index]


# --- pytest ---------------------------------------------------------------------------------------

_ROWS = pytest.StashKey[MarkedRows]()
_HELP = (
    'campaign(path, samples=N, sampler="random", ...): one test for each row, which takes `row`;'
    " arguments as of osc2tx.testing.run_campaign"
)


def pytest_configure(config: pytest.Config) -> None:
    """Make the mark known."""
    config.addinivalue_line("markers", _HELP)
    config.stash[_ROWS] = MarkedRows()


def pytest_unconfigure(config: pytest.Config) -> None:
    """Drop the compilations."""
    if _ROWS in config.stash:
        config.stash[_ROWS].close()


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Make a test for each row of a marked function; the same ones in all processes."""
    mark = metafunc.definition.get_closest_marker("campaign")
    if mark is None:
        return
    if "row" not in metafunc.fixturenames:
        pytest.fail(f"{metafunc.definition.name} is marked `campaign`: let it take `row`", False)
    indices = metafunc.config.stash[_ROWS].indices(mark)
    metafunc.parametrize("row", indices, ids=[f"row{index}" for index in indices], indirect=True)


@pytest.fixture
def row(request: pytest.FixtureRequest) -> CampaignRow:
    """Run a row of the campaign that a test is marked with."""
    mark = request.node.get_closest_marker("campaign")
    found: CampaignRow = request.config.stash[_ROWS].run(mark, request.param)
    request.node.add_report_section("setup", "the same row", found.repeat)
    return found
