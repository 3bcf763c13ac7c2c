"""Files of the cache of results, addressed by content; damaged ones count as missing."""

from __future__ import annotations

import json
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from osc2tx.building.results import OutputRecord
from osc2tx.support.records import digest
from osc2tx_shared.cache import evict_oldest, read_own, write_own
from osc2tx_shared.classes import replace

FORMAT = 7
MOST_RECORDS = 4  # of one text: with imports as several branches have them
MOST_FILES = 128  # in each of the 256 folders of a kind


class ResultStore:
    """Records of results by key, the texts of their outputs, and those of library files.

    Args:
        folder: The folder of the cache.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._written: set[Path] = set()

    def records(self, key: str) -> list[dict[str, Any]]:
        """Return the records of a text, the last one first."""
        data = read_own(self._place("results", key))
        try:
            document = json.loads(data or b"{}")
            records = document["records"] if document["format"] == FORMAT else []
            return [each for each in records if isinstance(each, dict)]
        except (ValueError, KeyError, TypeError, RecursionError):
            return []

    def put(self, key: str, record: Mapping[str, Any]) -> None:
        """Store a record before those of the same text; one with the same imports is replaced."""
        others = [
            each
            for each in self.records(key)
            if each.get("dependencies") != record["dependencies"] and each != record
        ]
        document = {"format": FORMAT, "records": [record, *others[: MOST_RECORDS - 1]]}
        self._write(self._place("results", key), json.dumps(document).encode())

    def keep_texts(self, outputs: Sequence[OutputRecord]) -> None:
        """Store the texts of outputs, if they have any."""
        if any(made.text is not None for made in outputs):
            texts = json.dumps([made.text for made in outputs]).encode()
            self._write(self._bundle(outputs), zlib.compress(texts, 1))

    def with_texts(self, outputs: Sequence[OutputRecord]) -> tuple[OutputRecord, ...] | None:
        """Return outputs with their texts; `None` if those are not stored."""
        data = read_own(self._bundle(outputs))
        try:
            texts = json.loads(zlib.decompress(data or b""))
            pairs = zip(outputs, texts, strict=True)
            found = tuple(replace(made, text=text) for made, text in pairs)
        except (ValueError, TypeError, zlib.error):
            return None
        is_whole = all(digest(made.text.encode()) == made.digest for made in found if made.text)
        return found if is_whole else None

    def keep_library(self, text: str) -> str:
        """Store the text of a library file; return its digest."""
        data = text.encode()
        key = digest(data)
        self._write(self._place("library", key), data)
        return key

    def library(self, key: str) -> str:
        """Return the text of a library file.

        Raises:
            ValueError: It is not stored.
        """
        data = read_own(self._place("library", key))
        if data is None or digest(data) != key:
            raise ValueError(key)
        return data.decode()

    def evict_oldest(self) -> None:
        """Remove what has not been written for the longest time, where there is too much."""
        for folder in self._written:
            evict_oldest(folder, MOST_FILES)

    def _place(self, kind: str, name: str) -> Path:
        return self._folder / kind / name[:2] / name[2:]

    def _bundle(self, outputs: Sequence[OutputRecord]) -> Path:
        return self._place("texts", digest("".join(made.digest for made in outputs).encode()))

    def _write(self, place: Path, data: bytes) -> None:
        if write_own(place, data):
            self._written.add(place.parent)
