"""Names of files that complete a line: maps, and modules to import."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from osc2tx.building.jobs import Job
from osc2tx_shared.map_files import map_names

_MAP = re.compile(r'map_file\s*(?:==|:)\s*"[^"]*$')
_MODULE = re.compile(r"^import\s+[\w.]*$")
_FILE = re.compile(r'^import\s+"[^"]*$')
_STANDARD = ("osc.standard", "osc.standard.all")


def file_names(before: str, job: Job) -> Iterable[str] | None:
    """Return the names that complete a line; `None` where no file is named.

    Args:
        before: The line up to the cursor.
        job: The file, beside which maps and modules are searched.
    """
    folder = job.path.parent
    if _MAP.search(before):
        folders = [folder, *map(Path, job.options.xml.map_path)]
        return sorted(set(map_names([each for each in folders if each.is_dir()])))
    others = sorted(each for each in folder.glob("*.osc") if each != job.path)
    if _MODULE.match(before):
        return [*_STANDARD, *(each.stem for each in others if each.stem.isidentifier())]
    return [each.name for each in others] if _FILE.match(before) else None
