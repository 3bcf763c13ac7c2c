"""The page of a project: verdicts by value, campaigns with their coverage, XML by reason."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.report.page import render_project
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx.campaigns.summary import Results
    from osc2tx.compilation.file_reports import LossEntry

__all__ = ["ScenarioResult", "project_page"]


@dataclass(frozen=True, slots=True)
class ScenarioResult:
    """The result of one scenario.

    Attributes:
        file: Its file.
        name: Its name.
        verdict: How its run ended.
        expected: How it was to end.
        reason: Why it ended so, if it is no success.
        values: What the scenario fixes, by path.
        page: The page of the run, relative to that of the project; empty if there is none.
    """

    file: str
    name: str
    verdict: str
    expected: str
    reason: str
    values: Mapping[str, str]
    page: str = ""


def project_page(
    scenarios: Sequence[ScenarioResult] = (),
    losses: Iterable[LossEntry] = (),
    campaigns: Sequence[tuple[Results, str]] = (),
) -> str:
    """Return the page as text; the same arguments give the same text.

    Args:
        scenarios: The results, in order.
        losses: What became of the scenarios as OpenSCENARIO XML.
        campaigns: Campaigns, each with its own page relative to this one; empty if it has none.
    """
    return render_project(
        {
            "scenarios": [
                {
                    "file": each.file,
                    "name": each.name,
                    "verdict": each.verdict,
                    "expected": each.expected,
                    "reason": each.reason,
                    "values": dict(each.values),
                    "page": each.page,
                }
                for each in scenarios
            ],
            "xml": _xml(tuple(losses)),
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


def _xml(losses: Sequence[LossEntry]) -> dict[str, Any]:
    """Return how many scenarios have XML, and the others by what keeps them from it."""
    names: dict[str, dict[str, None]] = {}
    for loss in losses:
        for reason in () if loss.is_written else loss.reasons:
            names.setdefault(reason, {})[loss.scenario] = None
    ranked = sorted(names.items(), key=lambda item: (-len(item[1]), item[0]))
    return {
        "scenarios": len(losses),
        "written": sum(loss.is_written for loss in losses),
        "reasons": [{"reason": reason, "scenarios": list(found)} for reason, found in ranked],
    }
