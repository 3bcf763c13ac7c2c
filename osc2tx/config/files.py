"""Finds the settings files of source files."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from osc2tx.config.model import Config
from osc2tx.config.reader import read_folder
from osc2tx.support.paths import real_path


class ConfigFiles:
    """Finds the settings of source files; every settings file is read once."""

    def __init__(self) -> None:
        """Start with nothing read."""
        self._by_folder: dict[Path, Config] = {}
        self._resolved: dict[Path, Path] = {}
        self._used: dict[Path, set[Path]] = {}

    def for_source(self, source: Path) -> Config:
        """Return the settings for a source file; for a link, those at the link itself.

        Raises:
            ConfigError: If the settings file is unreadable or has unknown settings.
        """
        if source.parent not in self._resolved:
            self._resolved[source.parent] = real_path(source.parent)
        config = self._for_folder(self._resolved[source.parent])
        if config.path is not None:
            self._used.setdefault(config.path, set()).add(source)
        return config

    def for_folder(self, folder: Path) -> Config:
        """Return the settings that count in a folder.

        Raises:
            ConfigError: As `for_source`.
        """
        return self._for_folder(real_path(folder))

    def unmatched_tables(self) -> list[str]:
        """Return a sentence for each table of files that do not exist.

        Only the settings of the requested sources are checked.
        """
        configs = {config.path: config for config in self._by_folder.values()}
        return [
            f"{config.path}: [{name}] matches no file: {why}"
            for path, config in configs.items()
            if path in self._used
            for table, why in self._missing(config)
            for name in (".".join(filter(None, (config.prefix, table))),)
        ]

    def _missing(self, config: Config) -> Iterator[tuple[str, str]]:
        """Yield the tables that match no file, each with the reason."""
        assert config.path is not None, "there is a file"
        used = self._used[config.path]
        names = set(config.scenarios) - {source.stem for source in used}
        patterns = {
            pattern
            for pattern in config.files
            if not any(config.matches(pattern, source) for source in used)
        }
        for source in _sources_below(config.path.parent) if names or patterns else ():
            names.discard(source.stem)
            patterns -= {pattern for pattern in patterns if config.matches(pattern, source)}
        yield from ((f"scenarios.{name}", f"there is no `{name}.osc`") for name in sorted(names))
        for pattern in sorted(patterns):
            yield f'files."{pattern}"', "no source has this name"

    def _for_folder(self, folder: Path) -> Config:
        if folder not in self._by_folder:
            found = read_folder(folder)
            if found is None:
                found = Config() if folder == folder.parent else self._for_folder(folder.parent)
            self._by_folder[folder] = found
        return self._by_folder[folder]


def _sources_below(folder: Path) -> Iterator[Path]:
    for place, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        yield from (Path(place, name) for name in files if name.endswith(".osc"))
