"""Keeps what came of the rows of a campaign in one SQLite file.

The driver alone writes. A row that arrives twice is stored once, and what was stored before a
process was killed stays: SQLite's write-ahead log sees to that.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from osc2tx.campaigns.records import COLUMNS, OF_THE_MACHINE, SCHEMA, decoded, record
from osc2tx_runtime.campaigns import RowResult

__all__ = ["CampaignError", "Store"]


class CampaignError(Exception):
    """A campaign cannot be run, or its store cannot be used; the message says what to do."""


FORMAT = 2


class Store:
    """The file of a campaign. A context manager; who leaves it closes the file.

    Args:
        path: The file.
        is_new: Whether it may be made.

    Raises:
        CampaignError: It is not there, or is no store of a campaign.
    """

    def __init__(self, path: Path, *, is_new: bool = False) -> None:
        self.path = path
        if not path.exists() and not is_new:
            raise CampaignError(f"{path}: there is no such store")
        try:
            if is_new:
                path.parent.mkdir(parents=True, exist_ok=True)
            self._base = sqlite3.connect(path, timeout=30.0, isolation_level=None)
            if is_new:
                self._make()
            self._check()
        except (OSError, sqlite3.Error) as error:
            raise CampaignError(f"{path}: it is no store of a campaign: {error}") from error

    def _make(self) -> None:
        """Make the tables of an empty file, if nobody else has done so meanwhile."""
        if self._tables():
            return
        self._base.execute("pragma journal_mode = wal")
        self._base.execute("begin immediate")
        if not self._tables():
            for statement in filter(str.strip, SCHEMA.split(";")):
                self._base.execute(statement)
            self._base.execute(f"pragma user_version = {FORMAT}")
        self._base.execute("commit")

    def _check(self) -> None:
        found = self._base.execute("pragma user_version").fetchone()[0]
        if found != FORMAT or not {"campaign", "run", "left_out"} <= self._tables():
            raise CampaignError(f"{self.path}: it is no store of a campaign, or of another version")
        self._base.execute("pragma synchronous = normal")

    def _tables(self) -> set[str]:
        return {name for (name,) in self._base.execute("select name from sqlite_master")}

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._base.close()

    # --- what the campaign is ---

    @property
    def identity(self) -> dict[str, Any] | None:
        """What the campaign is; None of a store that is still empty."""
        return self._told("identity")

    @property
    def plan(self) -> dict[str, Any]:
        """What its rows have in common.

        Raises:
            CampaignError: The store is empty.
        """
        found = self._told("plan")
        if found is None:
            raise CampaignError(f"{self.path}: nothing was run yet")
        return found

    def _told(self, name: str) -> dict[str, Any] | None:
        query = "select value from campaign where name = ?"
        found = self._base.execute(query, (name,)).fetchone()
        value: dict[str, Any] | None = json.loads(found[0]) if found else None
        return value

    @property
    def wanted(self) -> int | None:
        """How many rows the last call wanted, if it said."""
        found = self._told("samples")
        return None if found is None else int(found["rows"])

    @wanted.setter
    def wanted(self, rows: int) -> None:
        told = json.dumps({"rows": rows})
        self._base.execute("insert or replace into campaign values ('samples', ?)", (told,))

    def claim(self, identity: Mapping[str, Any], plan: Mapping[str, Any]) -> None:
        """Make the store that of a campaign, or see that it is.

        Raises:
            CampaignError: It is that of another one; the message says what differs.
        """
        known = self.identity
        if known is not None:
            differences = list(_differences(known, json.loads(json.dumps(identity))))
            if differences:
                raise CampaignError(
                    f"{self.path}: the store is of another campaign: {'; '.join(differences)}."
                    " Take another --store, or the settings that it was begun with"
                )
            return
        values = [("identity", json.dumps(identity)), ("plan", json.dumps(plan))]
        self._base.execute("begin immediate")
        self._base.executemany("insert or ignore into campaign values (?, ?)", values)
        self._base.execute("commit")

    # --- rows ---

    def add(self, results: Iterable[RowResult], left_out: Iterable[int] = ()) -> None:
        """Store what came of rows, at once."""
        results = list(results)
        marks = ", ".join("?" * len(COLUMNS))
        collisions = [
            (each.row.number, nth, *contact)
            for each in results
            for nth, contact in enumerate(each.collisions)
        ]
        samples = [
            (each.row.number, nth, *sample)
            for each in results
            for nth, sample in enumerate(each.samples)
        ]
        base = self._base
        base.execute("begin immediate")
        try:
            base.executemany(f"insert or ignore into run values ({marks})", map(record, results))
            base.executemany("insert or ignore into collision values (?,?,?,?,?,?)", collisions)
            base.executemany("insert or ignore into sample values (?,?,?,?)", samples)
            base.executemany(
                "insert or ignore into left_out values (?)", ((number,) for number in left_out)
            )
        except BaseException:
            base.execute("rollback")
            raise
        base.execute("commit")

    def done(self) -> set[int]:
        """Return the numbers of the rows that were run."""
        return {number for (number,) in self._base.execute("select number from run")}

    def left_out(self) -> set[int]:
        """Return the numbers of the rows that break a constraint."""
        return {number for (number,) in self._base.execute("select number from left_out")}

    def measures(self) -> dict[int, dict[str, float | None]]:
        """Return the measures of all rows by number."""
        query = "select number, measures from run order by number"
        return {number: json.loads(text) for number, text in self._base.execute(query)}

    def counts(self) -> dict[str, int]:
        """Return how many rows ended how."""
        query = "select status, count(*) from run group by status order by status"
        return dict(self._base.execute(query))

    def runs(self) -> Iterator[dict[str, Any]]:
        """Yield all rows by number: columns of the table, JSON as what it says."""
        for values in self._base.execute(f"select {', '.join(COLUMNS)} from run order by number"):
            yield decoded(values)

    def run(self, number: int) -> dict[str, Any]:
        """Return a row.

        Raises:
            CampaignError: It was not run.
        """
        query = f"select {', '.join(COLUMNS)} from run where number = ?"
        values = self._base.execute(query, (number,)).fetchone()
        if values is None:
            why = "breaks a constraint, so it was left out" if number in self.left_out() else ""
            raise CampaignError(f"{self.path}: row {number} {why or 'was not run'}")
        return decoded(values)

    def collisions(self) -> Iterator[tuple[Any, ...]]:
        """Yield the contacts of all rows: number, nth, time (s), both actors, speed (m/s)."""
        yield from self._base.execute("select * from collision order by number, nth")

    def samples(self) -> Iterator[tuple[int, str, dict[str, Any]]]:
        """Yield what coverage items sampled: number, `cover` or `record`, the line of the trace."""
        for number, kind, line in self._base.execute(
            "select number, kind, line from sample order by number, nth"
        ):
            yield number, kind, json.loads(line)

    def digest(self) -> str:
        """Return the SHA-256 of all that was found, without what depends on the machine."""
        kept = [name for name in COLUMNS if name not in OF_THE_MACHINE]
        digest = hashlib.sha256()
        for query in (
            f"select {', '.join(kept)} from run order by number",
            "select * from collision order by number, nth",
            "select * from sample order by number, nth",
            "select number from left_out order by number",
        ):
            for values in self._base.execute(query):
                digest.update(repr(values).encode())
        return digest.hexdigest()


def _differences(known: Mapping[str, Any], given: Mapping[str, Any]) -> Iterator[str]:
    for name in dict.fromkeys((*known, *given)):
        was, is_now = known.get(name), given.get(name)
        if was != is_now:
            yield f"{name} was {_short(was)}, is {_short(is_now)}"


def _short(value: Any) -> str:
    if isinstance(value, str) and len(value) == hashlib.sha256().digest_size * 2:
        return value[:12]
    return "not said" if value is None else json.dumps(value)
