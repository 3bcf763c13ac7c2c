"""Unified diffs of outputs."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import unified_diff


def diff_lines(path: str, old: str | None, new: str | None) -> Iterator[str]:
    """Yield the lines of a diff as git writes it; `None` stands for no file."""
    path = path.lstrip("/")
    yield from (
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
        for line in unified_diff(
            _lines(old),
            _lines(new),
            "/dev/null" if old is None else f"a/{path}",
            "/dev/null" if new is None else f"b/{path}",
        )
    )


def _lines(text: str | None) -> list[str]:
    """Return lines with their ends; only a line feed ends one, unlike in `splitlines`."""
    lines = (text or "").split("\n")
    last = lines.pop()
    return [f"{line}\n" for line in lines] + ([last] if last else [])
