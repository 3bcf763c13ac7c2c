"""Damaged stores of campaigns: columns with other values, plans with other parts, other bytes."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

from osc2tx.campaigns.export import export_rows
from osc2tx.campaigns.report import render_report
from osc2tx.campaigns.store import Store
from osc2tx.campaigns.summary import results_of, summary_of
from tests.campaigns.kit import TRIANGLE, Here, plan_of, run

COLUMNS = (
    *("number", "seed", "shares", "given", "parameters", "measures", "violations"),
    *("steps", "time", "status", "seconds", "reason", "digest"),
)
ENTRIES = ("identity", "plan", "samples")
JUNK: Sequence[Any] = (
    *(None, 0, -1, 1.5, 1e308, float("inf"), 2**63 - 1, "", "x", "nan", "null", "{}", "[]", "[1]"),
    *('{"a": ', '{"v": "x"}', '{"a": null}', "[" * 999, '"\\ud800"', b"\xff\xfe", "9" * 999),
)
LARGEST = 200_000  # bytes of a store


@cache
def sound_store() -> bytes:
    """Return the bytes of a store of three rows."""
    with TemporaryDirectory() as folder:
        place = Path(folder, "store")
        run(plan_of(TRIANGLE, "min_gap"), place, "random", 3, Here())
        with sqlite3.connect(place) as base:
            base.execute("pragma journal_mode = delete")
        base.close()
        return place.read_bytes()


def write_damage(random: Random) -> str:
    """Return what is changed in a store, as JSON: of columns, of entries, or of bytes."""
    changes: list[dict[str, Any]] = []
    for _ in range(random.randint(1, 3)):
        value = random.choice(JUNK)
        given = {"hex": value.hex()} if isinstance(value, bytes) else value
        kind = random.random()
        if kind < 0.5:
            row = random.randrange(3)
            changes.append({"column": random.choice(COLUMNS), "row": row, "value": given})
        elif kind < 0.8:
            changes.append({"entry": random.choice(ENTRIES), "value": given})
        else:
            at, size = random.randrange(LARGEST), random.choice((1, 4, 100, 5000))
            changes.append({"at": at, "bytes": random.randbytes(size).hex()})
    return json.dumps(changes)


def read_store(text: str, folder: Path) -> None:
    """Read all that commands read of a store; of one with other bytes no module is run."""
    place = folder / "store"
    place.write_bytes(sound_store())
    changes = json.loads(text)
    for change in changes:
        if "bytes" not in change:
            _update(place, change)
    data, is_whole = bytearray(place.read_bytes()), True
    for change in changes:
        if "bytes" in change:
            part, is_whole = bytes.fromhex(change["bytes"]), False
            at = change["at"] % len(data)
            data[at : at + len(part)] = part
    place.write_bytes(data)
    with Store(place) as store:
        export_rows(store, folder / "rows.csv")
        if is_whole:
            results = results_of(store)
            summary_of(results)
            render_report(results, None)


def _update(place: Path, change: dict[str, Any]) -> None:
    value = change["value"]
    if isinstance(value, dict):
        value = bytes.fromhex(value["hex"])
    with sqlite3.connect(place) as base:
        try:
            if "entry" in change:
                base.execute(
                    "update campaign set value = ? where name = ?", (value, change["entry"])
                )
            else:
                statement = f"update run set {change['column']} = ? where number = ?"
                base.execute(statement, (value, change["row"]))
        except sqlite3.IntegrityError:
            pass  # the file itself refuses it
    base.close()
