"""Reads written modules, to run them elsewhere."""

from __future__ import annotations

import os
from pathlib import Path

from osc2tx.compilation.inputs import InputError
from osc2tx.module_loading import sibling_files
from osc2tx.support.paths import COVERAGE_MODEL, SOURCE_MAP, real_path


def written_files(place: Path) -> tuple[dict[str, str], str]:
    """Return a written module and those that it imports from around it, and the path of its own.

    Raises:
        InputError: One cannot be read.
    """
    place = real_path(place)
    try:
        found = [place, *(Path(file) for file in sibling_files(place)[0].values() if file)]
        root = Path(os.path.commonpath([each.parent for each in found]))
        beside = [each.with_suffix(end) for each in found for end in (SOURCE_MAP, COVERAGE_MODEL)]
        files = {
            each.relative_to(root).as_posix(): each.read_text(encoding="utf-8")
            for each in (*found, *beside)
            if each in found or each.is_file()
        }
    except (OSError, SyntaxError, ValueError) as error:
        raise InputError(f"{place}: cannot be imported: {error}") from error
    return files, place.relative_to(root).as_posix()
