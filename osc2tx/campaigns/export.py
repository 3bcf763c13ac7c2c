"""Tables of all rows, for other tools."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from osc2tx.campaigns.store import Store
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.running.output_files import problem_of, write_output

from .store import CampaignError

ALWAYS = ("number", "seed", "status", "reason", "time")
"""Columns that every table has, in front."""

FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""How a text begins that spreadsheets evaluate."""


def export_rows(store: Store, file: Path) -> int:
    """Write a table; its form follows from the end of its name. Return how many rows it has.

    Raises:
        CampaignError: The form is not known, or the file cannot be written.
    """
    rows = list(flat_rows(store))
    if file.suffix == ".csv":
        text = _csv(rows)
    elif file.suffix == ".jsonl":
        text = "".join(f"{json.dumps(row, allow_nan=False)}\n" for row in rows)
    else:
        raise CampaignError(f"{file}: name a file .csv or .jsonl")
    write_text("table", file, text)
    return len(rows)


def write_text(what: str, file: Path, text: str) -> None:
    """Write a file; one that is there is replaced if it is such a file.

    Raises:
        CampaignError: It cannot be written, or is another one.
    """
    problem = problem_of(what, file)
    if problem is not None:
        raise CampaignError(problem)
    try:
        write_output(what, file, text)
    except InputError as error:
        raise CampaignError(str(error)) from error


def flat_rows(store: Store) -> Iterator[dict[str, Any]]:
    """Yield all rows by number, each with plain values."""
    for run in store.runs():
        yield {
            **{name: run[name] for name in ALWAYS},
            **{f"parameter {name}": value for name, value in run["parameters"].items()},
            **{f"kpi {name}": value for name, value in run["measures"].items()},
            "violations": len(run["violations"]),
            **({"digest": run["digest"]} if run["digest"] else {}),
        }


def _csv(rows: list[dict[str, Any]]) -> str:
    names = list(dict.fromkeys((*ALWAYS, *(name for row in rows for name in row))))
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\r\n")  # RFC 4180
    writer.writerow(map(_field, names))
    for row in rows:  # floats as `repr` has them
        writer.writerow(_field(row.get(name)) for name in names)
    return out.getvalue()


def _field(value: Any) -> Any:
    """Mark text that a spreadsheet would read as a formula, as `report/export.js` does."""
    return f"'{value}" if isinstance(value, str) and value.startswith(FORMULA) else value
