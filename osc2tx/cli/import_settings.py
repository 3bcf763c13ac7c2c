"""Settings of imported scenarios: where the maps are, and the rows of campaigns."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from osc2tx.building.write import replace_file
from osc2tx.importing.distributions import MOST_COMBINATIONS, MOST_ROWS, Distribution
from osc2tx.importing.importer import Imported
from osc2tx_shared.text import complain

SETTINGS = "osc2tx.toml"


def write_text(path: Path, text: str) -> None:
    """Write a file, or leave it as it was."""
    replace_file(path, text.encode())


def write_settings(results: Sequence[Imported], out: Path) -> None:
    """Write where the maps are, and the rows of campaigns; settings that exist stay."""
    folders = {
        os.path.relpath(file.parent, out)
        for imported in results
        if (file := imported.document.map_file) is not None
    }
    lines = [f"map_paths = {json.dumps(sorted(folders))}"] if folders else []
    for imported in results:
        if imported.distribution is not None:
            lines += _campaign(imported, imported.distribution, out)
    if not lines:
        return
    place = out / SETTINGS
    if place.exists():
        complain(f"{place}: exists, unchanged")
        return
    write_text(place, "\n".join(lines) + "\n")


def _campaign(imported: Imported, found: Distribution, out: Path) -> Iterator[str]:
    """Write the rows of a campaign, and yield its settings."""
    name = imported.name
    yield ""
    yield f"[scenarios.{name}.campaign]"
    parameters = {
        said: parameter
        for said, parameter in imported.parameters.items()
        if parameter.is_used and said in found.open and len(found.open[said].values) != 1
    }
    if found.is_drawn or not parameters:
        yield 'sampler = "random"'
        yield f"samples = {found.runs or 1}"
        if found.is_drawn and found.seed:
            yield ""
            yield f"[scenarios.{name}.run]"
            yield f"seed = {found.seed}"
        return
    rows = (
        list(dict.fromkeys(tuple(row.get(said, "") for said in parameters) for row in found.rows()))
        if found.size <= MOST_COMBINATIONS
        else []
    )
    if not rows or len(rows) > MOST_ROWS:
        yield 'sampler = "pairwise"'
        return
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(each.name for each in parameters.values())
    for row in rows:
        units = (each.unit[0] if each.kind == "double" else "" for each in parameters.values())
        writer.writerow(f"{_plain(value)}{unit}" for value, unit in zip(row, units, strict=True))
    write_text(out / f"{name}.csv", text.getvalue())
    yield f'sampler = "table:{name}.csv"'
    yield f"samples = {len(rows)}"


def _plain(value: str) -> str:
    try:
        return f"{float(value):.12g}"
    except ValueError:
        return value
