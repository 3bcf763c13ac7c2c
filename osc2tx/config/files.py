"""Finds the settings files of source files."""

from __future__ import annotations

import os
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
        self._used: dict[Path, set[str]] = {}

    def for_source(self, source: Path) -> Config:
        """Return the settings for a source file; for a link, those of the place of the link.

        Raises:
            ConfigError: If the settings file is unreadable or says something unknown.
        """
        if source.parent not in self._resolved:
            self._resolved[source.parent] = real_path(source.parent)
        config = self._for_folder(self._resolved[source.parent])
        if config.path is not None:
            self._used.setdefault(config.path, set()).add(source.stem)
        return config

    def for_folder(self, folder: Path) -> Config:
        """Return the settings that count in a folder.

        Raises:
            ConfigError: As `for_source`.
        """
        return self._for_folder(real_path(folder))

    def unmatched_tables(self) -> list[str]:
        """Return a sentence for each table of a file that does not exist.

        Only the settings of sources that were asked for are looked at.
        """
        return [
            f"{config.path}: [{table}] is for no file: there is no `{name}.osc`"
            for config in {config.path: config for config in self._by_folder.values()}.values()
            if config.path in self._used
            for name in sorted(self._missing(config))
            for table in (".".join(filter(None, (config.prefix, "scenarios", name))),)
        ]

    def _missing(self, config: Config) -> set[str]:
        assert config.path is not None, "there is a file"
        missing = set(config.scenarios) - self._used[config.path]
        for _, folders, files in os.walk(config.path.parent if missing else ""):
            folders[:] = [name for name in folders if not name.startswith(".")]
            missing -= {name.removesuffix(".osc") for name in files if name.endswith(".osc")}
            if not missing:
                break
        return missing

    def _for_folder(self, folder: Path) -> Config:
        if folder not in self._by_folder:
            found = read_folder(folder)
            if found is None:
                found = Config() if folder == folder.parent else self._for_folder(folder.parent)
            self._by_folder[folder] = found
        return self._by_folder[folder]
