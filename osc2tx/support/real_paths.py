"""Paths with links followed."""

from __future__ import annotations

import os
from pathlib import Path


def real_path(path: Path) -> Path:
    """Return the absolute path without links; a link to itself stays, where pathlib fails."""
    return Path(os.path.realpath(path))
