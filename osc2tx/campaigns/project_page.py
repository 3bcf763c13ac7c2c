"""The page of a project: verdicts by value, campaigns with their coverage, XML by reason."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, field
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.report.page import render_project
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx.campaigns.summary import Results

__all__ = ["ScenarioResult", "XmlYield", "project_page"]


@dataclass(frozen=True, slots=True)
class ScenarioResult:
    """The result of one scenario.

    Attributes:
        file: Its file.
        name: Its name.
        verdict: How its run ended.
        expected: The expected verdict.
        reason: The reason, if it is no success.
        values: The values that the scenario fixes, by path.
        page: The page of the run, relative to that of the project; empty if there is none.
    """

    file: str
    name: str
    verdict: str
    expected: str
    reason: str
    values: Mapping[str, str]
    page: str = ""


@dataclass(frozen=True, slots=True)
class XmlYield:
    """Number of scenarios with OpenSCENARIO XML, and the obstacles of the others.

    Attributes:
        scenarios: Number of all scenarios.
        written: Number of those with XML.
        reasons: Names of scenarios without XML, by reason.
    """

    scenarios: int = 0
    written: int = 0
    reasons: Mapping[str, Sequence[str]] = field(default_factory=dict)

    def as_json(self) -> dict[str, Any]:
        """Return the data of the page, the most frequent reason first."""
        ranked = sorted(self.reasons.items(), key=lambda item: (-len(item[1]), item[0]))
        return {
            "scenarios": self.scenarios,
            "written": self.written,
            "reasons": [{"reason": reason, "scenarios": list(names)} for reason, names in ranked],
        }


NO_XML = XmlYield()


def project_page(
    scenarios: Sequence[ScenarioResult] = (),
    xml: XmlYield = NO_XML,
    campaigns: Sequence[tuple[Results, str]] = (),
) -> str:
    """Return the page as text; the same arguments give the same text.

    Args:
        scenarios: The results, in order.
        xml: Results of the scenarios as OpenSCENARIO XML.
        campaigns: Campaigns, each with its own page relative to this one; empty if it has none.
    """
    return render_project(
        {
            "scenarios": list(map(asdict, scenarios)),
            "xml": xml.as_json(),
            "campaigns": [_campaign(results, page) for results, page in campaigns],
        }
    )


def _campaign(results: Results, page: str) -> dict[str, Any]:
    from osc2tx.campaigns.coverage import overall  # with all of numpy

    first = next(iter(results.failures), None)
    return {
        "name": results.place,
        "scenario": results.identity["scenario"],
        "rows": len(results.runs),
        "failed": sum(len(group.rows) for group in results.failures),
        "grade": overall(results.items.values()),
        "holes": sum(len(item.holes()) for item in results.items.values()),
        "reason": "" if first is None else f"{first.status}: {first.smallest['reason']}",
        "page": page,
    }
