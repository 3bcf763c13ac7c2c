"""The mark `campaign` of pytest: a test for each row of a campaign."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from osc2tx.testing.marks import MarkedRows

if TYPE_CHECKING:
    from osc2tx.testing.campaigns import CampaignRow

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
