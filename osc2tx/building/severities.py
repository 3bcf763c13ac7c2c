"""What settings state about warnings: those that are not reported, and those that are errors."""

from __future__ import annotations

from pathlib import Path

from osc2tx.config import ConfigFiles
from osc2tx.diagnostics import Diagnostic, Severity
from osc2tx_shared.classes import replace


class Severities:
    """Judges diagnostics by the settings of the files that they are in."""

    def __init__(self, configs: ConfigFiles) -> None:
        """Take the settings files."""
        self._configs = configs
        self._tables: dict[Path, tuple[frozenset[str], frozenset[str]]] = {}

    def __call__(self, found: Diagnostic) -> Diagnostic | None:
        """Return a diagnostic with its severity; `None` if it is not reported.

        Raises:
            ConfigError: A settings file is wrong.
        """
        path = found.primary.source.path if found.primary is not None else None
        if path is None:
            return found
        if path not in self._tables:
            config = self._configs.for_source(path)
            self._tables[path] = config.codes("ignore", path), config.codes("errors", path)
        ignored, errors = self._tables[path]
        if found.code in ignored:
            return None
        return replace(found, severity=Severity.ERROR) if found.code in errors else found
