"""Baselines: warnings that a repository had when it began to check, which are not reported.

The settings name the file (`baseline`); `osc2tx check --write-baseline` writes it. An entry stands
for as many warnings of one message in one file as there were, wherever they move in the file.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

from osc2tx.config import ConfigError, ConfigFiles
from osc2tx.diagnostics import CODES, Diagnostic, Severity

__all__ = ["Baselines"]

VERSION = 1

Entry: TypeAlias = tuple[str, str, str]
"""File, seen from the baseline, with forward slashes; code; message."""


class Baselines:
    """The baselines of the projects of some files; each is read once, when it is needed.

    Attributes:
        configs: The settings files.
    """

    def __init__(self, configs: ConfigFiles) -> None:
        """Take the settings files."""
        self.configs = configs
        self._stated: dict[Path, Counter[Entry]] = {}
        self._left: dict[Path, Counter[Entry]] = {}

    def new_among(self, found: Iterable[Diagnostic]) -> list[Diagnostic]:
        """Return what no baseline has.

        Raises:
            ConfigError: A baseline cannot be read.
        """
        return [diagnostic for diagnostic in found if not self._is_known(diagnostic)]

    def outdated(self, files: Iterable[Path]) -> list[str]:
        """Return a sentence for each baseline with warnings that do not occur any more.

        Args:
            files: The files of which `new_among` was given all warnings.
        """
        sentences = []
        for place, names in self._names_by_place(files).items():
            self._read(place)
            gone = sum(count for entry, count in self._left[place].items() if entry[0] in names)
            if gone > 0:
                what = "warning does" if gone == 1 else "warnings do"
                sentences.append(
                    f"{place}: {gone} {what} not occur any more; `osc2tx check --write-baseline`"
                    " removes what is gone"
                )
        return sentences

    def write(self, found: Iterable[Diagnostic], files: Iterable[Path]) -> Mapping[Path, int]:
        """Write the warnings of files to their baselines; entries of other files stay.

        Args:
            found: What would be reported without baselines.
            files: The files of which it has all warnings.

        Returns:
            The baselines, with the number of warnings in each.

        Raises:
            ConfigError: A file cannot be read or written.
        """
        names_by_place = self._names_by_place(files)
        written = {
            place: Counter({e: n for e, n in self._read(place).items() if e[0] not in names})
            for place, names in names_by_place.items()
        }
        for placed in filter(None, map(self._placed, found)):
            place, entry = placed
            if entry[0] in names_by_place.get(place, ()):
                written[place][entry] += 1
        for place, entries in written.items():
            _write(place, entries)
            self._stated[place], self._left[place] = entries, entries.copy()
        return {place: entries.total() for place, entries in written.items()}

    def _is_known(self, diagnostic: Diagnostic) -> bool:
        placed = self._placed(diagnostic)
        if placed is None:
            return False
        place, entry = placed
        is_known = self._read(place)[entry] > 0 and self._left[place][entry] > 0
        self._left[place][entry] -= is_known
        return is_known

    def _placed(self, diagnostic: Diagnostic) -> tuple[Path, Entry] | None:
        """Return the baseline that may have a warning, and its entry there."""
        source = diagnostic.primary.source.path if diagnostic.primary is not None else None
        if source is None or CODES[diagnostic.code].severity is Severity.ERROR:
            return None
        place = self.configs.for_source(source).baseline
        if place is None:
            return None
        return place, (_relative(source, place), diagnostic.code, diagnostic.message)

    def _names_by_place(self, files: Iterable[Path]) -> dict[Path, set[str]]:
        names: dict[Path, set[str]] = {}
        for path in files:
            place = self.configs.for_source(path).baseline
            if place is not None:
                names.setdefault(place, set()).add(_relative(path, place))
        return names

    def _read(self, place: Path) -> Counter[Entry]:
        if place not in self._stated:
            self._stated[place] = _read(place)
            self._left[place] = self._stated[place].copy()
        return self._stated[place]


def _relative(source: Path, place: Path) -> str:
    source_place, folder = os.path.realpath(source), os.path.realpath(place.parent)
    return Path(os.path.relpath(source_place, folder)).as_posix()


def _write(place: Path, entries: Counter[Entry]) -> None:
    lines = [
        json.dumps({"file": file, "code": code, "count": count, "message": message})
        for (file, code, message), count in sorted(entries.items())
    ]
    text = f'{{"version": {VERSION}, "warnings": [\n' + ",\n".join(lines) + "\n]}\n"
    try:
        place.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise ConfigError(f"{place}: cannot be written: {error.strerror}") from None


def _read(place: Path) -> Counter[Entry]:
    try:
        document = json.loads(place.read_text(encoding="utf-8"))
        if document["version"] != VERSION:
            raise ValueError
        entries: Counter[Entry] = Counter()
        for each in document["warnings"]:
            if not isinstance(each["count"], int):
                raise TypeError
            entries[str(each["file"]), str(each["code"]), str(each["message"])] += each["count"]
        return entries
    except FileNotFoundError:
        return Counter()  # nothing was written yet
    except OSError as error:
        raise ConfigError(f"{place}: cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, RecursionError):
        raise ConfigError(
            f"{place}: is no baseline; `osc2tx check --write-baseline` writes one"
        ) from None
