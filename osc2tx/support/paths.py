"""Names of settings files and of generated files, and paths without links."""

from __future__ import annotations

import os
import re
from pathlib import Path

SETTINGS_FILES = ("osc2tx.toml", "pyproject.toml")
"""Names of settings files; in one folder, the first that is there counts."""

MODULE = ".py"
SOURCE_MAP = ".map.json"
COVERAGE_MODEL = ".coverage.json"
XML = ".xosc"
PARAMETERS = ".params.xosc"
LOSS_REPORT = ".xosc.report.json"


def is_committed(name: str) -> bool:
    """Whether a file belongs into version control: it is executed, so reviewers read it.

    Source maps hold line numbers, and reports derive from the others; builds write them.
    """
    return name.endswith((MODULE, XML))


def is_output(name: str) -> bool:
    """Whether a name is one that outputs have."""
    return name.endswith((MODULE, SOURCE_MAP, COVERAGE_MODEL, XML, LOSS_REPORT))


def module_of(source_map: str) -> str:
    """Return the name of the module that a source map lies beside."""
    return source_map.removesuffix(SOURCE_MAP) + MODULE


def source_map_of(module: str) -> str:
    """Return the name of the source map of a module."""
    return module.removesuffix(MODULE) + SOURCE_MAP


# Names of devices on Windows, with any suffix.
_DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³])(\..*)?", re.IGNORECASE | re.DOTALL)
_FORBIDDEN = re.compile(r'[<>:"|?*\\\x00-\x1f\x7f]')


def is_portable(name: str) -> bool:
    """Return whether a file or folder can have this name on every system."""
    ends_well = not name.endswith((".", " "))
    return ends_well and not _FORBIDDEN.search(name) and not _DEVICE.fullmatch(name)


def file_stem(text: str) -> str:
    """Return a text as the first part of the name of a file, on every system and in its folder."""
    stem = re.sub(r"[^\w-]+", "_", text).strip("_") or "_"
    return stem if is_portable(stem) else f"{stem}_"


def real_path(path: Path) -> Path:
    """Return the absolute path without links; a link to itself stays, where pathlib fails."""
    return Path(os.path.realpath(path))
