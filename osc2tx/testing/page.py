"""The page of a project, from the tests of a session; pytest calls it for each report."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from osc2tx.campaigns.project_page import ScenarioResult, XmlYield, project_page
from osc2tx.testing.result_properties import EXPECTED, REASON, TRACE, VERDICT

if TYPE_CHECKING:
    from osc2tx.campaigns.summary import Results
    from osc2tx.compilation.file_reports import LossEntry


class PageOfProject:
    """Collects results of scenarios, also from processes of pytest-xdist, and writes the page."""

    def __init__(self, place: Path, stores: Sequence[Path]) -> None:
        """Begin without results.

        Args:
            place: The HTML file.
            stores: Stores of campaigns that the page lists.
        """
        self._place = place
        self._stores = stores
        self._results: list[ScenarioResult] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the result of a scenario; called by pytest."""
        said = dict(report.user_properties)
        if report.when != "call" or VERDICT not in said:
            return
        file, _, name = report.nodeid.partition("::")
        verdict, expected, reason, trace = (
            str(said.pop(key, "")) for key in (VERDICT, EXPECTED, REASON, TRACE)
        )
        page = self._seen_from_page(Path(trace).with_suffix(".html")) if trace else ""
        values = {key: str(value) for key, value in said.items()}
        self._results.append(ScenarioResult(file, name, verdict, expected, reason, values, page))

    def write(self, losses: Sequence[LossEntry]) -> None:
        """Write the page.

        Args:
            losses: Results of the scenarios as OpenSCENARIO XML.

        Raises:
            CampaignError: A store cannot be read, or the page not be written.
            ScenarioError: The module of a store cannot be imported any more.
        """
        from osc2tx.campaigns.export import write_text

        results = sorted(self._results, key=lambda each: (each.file, each.name))
        page = project_page(results, _xml_yield(losses), tuple(self._campaigns()))
        write_text("page", self._place, page)

    def _campaigns(self) -> Iterator[tuple[Results, str]]:
        from osc2tx.campaigns.store import Store
        from osc2tx.campaigns.summary import results_of

        for place in self._stores:
            page = place.with_suffix(".html")
            with Store(place) as store:
                yield results_of(store), self._seen_from_page(page) if page.exists() else ""

    def _seen_from_page(self, place: Path) -> str:
        folder = os.path.dirname(os.path.abspath(self._place))
        return Path(os.path.relpath(os.path.abspath(place), folder)).as_posix()


def _xml_yield(losses: Sequence[LossEntry]) -> XmlYield:
    names: dict[str, dict[str, None]] = {}
    for loss in losses:
        for reason in () if loss.is_written else loss.reasons:
            names.setdefault(reason, {})[loss.scenario] = None
    reasons = {reason: list(found) for reason, found in names.items()}
    return XmlYield(len(losses), sum(loss.is_written for loss in losses), reasons)
