"""What a terminal shows: whether in color, and how wide it is."""

from __future__ import annotations

import os

from osc2tx_text import is_watched

__all__ = ["columns", "wants_color"]


def wants_color(*, err: bool = False) -> bool:
    """Whether to color standard output, or standard error: `NO_COLOR`, `FORCE_COLOR`, a terminal.

    The first of the two variables that is not empty decides, else whether there is a terminal.
    """
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or is_watched(err=err)


def columns() -> int | None:
    """Return the width of the terminal at standard output; None for files and pipes."""
    if not is_watched(err=False):
        return None
    from shutil import get_terminal_size  # with all that it knows of archives

    return get_terminal_size().columns
