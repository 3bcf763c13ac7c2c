"""The outcome of a campaign, as plain data: verdicts, failures in groups, measures, coverage."""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from osc2tx.campaigns.coverage import Item, coverage_of, overall
from osc2tx.campaigns.store import Store
from osc2tx_shared.classes import dataclass

FORMAT = 1
SHOWN_HOLES = 1000

_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")

Run = Mapping[str, Any]
"""A row of the store."""


@dataclass(frozen=True, slots=True)
class Failures:
    """Rows that fail for one reason.

    Attributes:
        status: How they end.
        source: Place in the scenario, if one is known.
        reason: Why, numbers as `#`.
        rows: Their numbers.
        smallest: The one that ends first; of several the first one.
    """

    status: str
    source: str | None
    reason: str
    rows: tuple[int, ...]
    smallest: Run


@dataclass(frozen=True, slots=True)
class Results:
    """The contents of a store, read once.

    Attributes:
        place: Path of the store.
        identity: The identity of the campaign.
        runs: Its rows.
        left_out: Number of points that break a constraint.
        items: Coverage.
        failures: Groups of rows, the largest first.
    """

    place: str
    identity: Mapping[str, Any]
    runs: Sequence[Run]
    left_out: int
    items: Mapping[str, Item]
    failures: Sequence[Failures]


def results_of(store: Store) -> Results:
    """Read a store.

    Raises:
        CampaignError: Nothing was run yet.
        ScenarioError: Its module cannot be imported any more.
    """
    items = coverage_of(store)
    runs = list(store.runs())
    return Results(
        place=str(store.path),
        identity=store.identity or {},
        runs=runs,
        left_out=len(store.left_out()),
        items=items,
        failures=failures_of(runs),
    )


def failures_of(runs: Iterable[Run]) -> list[Failures]:
    """Return the rows that did not succeed, by status, place and reason without numbers."""
    groups: dict[tuple[str, str | None, str], list[Run]] = {}
    for run in runs:
        if run["status"] != "success":
            key = run["status"], run["source"], _NUMBER.sub("#", run["reason"])
            groups.setdefault(key, []).append(run)
    found = [
        Failures(*key, tuple(run["number"] for run in group), min(group, key=_size))
        for key, group in groups.items()
    ]
    return sorted(found, key=lambda each: (-len(each.rows), each.rows[0]))


def _size(run: Run) -> tuple[float, int]:
    return run["time"], run["number"]


def replay_command(place: str, number: int) -> str:
    """Return the command that repeats a row."""
    return f"osc2tx campaign replay {shlex.quote(place)} {number}"


def summary_of(results: Results) -> dict[str, Any]:
    """Return the contents of `summary.json`, see `docs/campaign-summary.schema.json`."""
    runs, identity = results.runs, results.identity
    statuses: dict[str, int] = {}
    for run in runs:
        statuses[run["status"]] = statuses.get(run["status"], 0) + 1
    computed = math.fsum(run["seconds"] for run in runs)
    points = len(runs) + results.left_out
    return {
        "format": FORMAT,
        "scenario": identity["scenario"],
        "osc2tx": identity["osc2tx"],
        "sampler": identity["sampler"],
        "seed": identity["seed"],
        "fail_if": identity["fail-if"],
        "rows": {
            "total": len(runs),
            "by_status": dict(sorted(statuses.items())),
            "left_out": results.left_out,
            "accepted_percent": 100.0 * len(runs) / points if points else None,
        },
        "simulated_seconds": math.fsum(run["time"] for run in runs),
        "computed_seconds": computed,
        "rows_per_second": len(runs) / computed if computed else None,
        "coverage_grade": overall(results.items.values()),
        "coverage": [_item(item) for item in results.items.values()],
        "measures": measures_of(runs),
        "failures": [
            {
                "status": each.status,
                "reason": each.smallest["reason"],
                "source": each.source,
                "rows": len(each.rows),
                "smallest": each.smallest["number"],
                "replay": replay_command(results.place, each.smallest["number"]),
            }
            for each in results.failures
        ],
    }


def _item(item: Item) -> dict[str, Any]:
    holes = item.holes()
    return {
        "name": item.name,
        "kind": item.kind,
        "event": item.group,
        "unit": item.unit,
        "target": item.target,
        "grade": item.grade,
        "samples": item.samples,
        "outside": item.outside,
        "values": spread_of(item.values),
        "illegal_rows": item.illegal,
        "possible": item.possible if item.is_graded else None,
        "holes": len(holes) if item.is_graded else None,
        "hole_names": [item.name_of(cell) for cell in holes[:SHOWN_HOLES]],
    }


def measures_of(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """Return of each measure its least, mean and greatest value, SI units."""
    names = dict.fromkeys(name for run in runs for name in run["measures"])
    found = []
    for name in names:
        values = [(run["measures"].get(name), run["number"]) for run in runs]
        spread = spread_of([(value, row) for value, row in values if value is not None])
        if spread is not None:
            found.append({"name": name, **spread})
    return found


def spread_of(values: Sequence[tuple[float, int]]) -> dict[str, Any] | None:
    """Return the least, mean and greatest of values with their rows; None if there are none."""
    if not values:
        return None
    numbers = [value for value, _ in values]
    least, row = min(values)
    return {
        "count": len(values),
        "least": least,
        "least_row": row,
        "mean": math.fsum(numbers) / len(numbers),
        "greatest": max(numbers),
    }
