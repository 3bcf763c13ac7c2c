"""Finds diagnostic codes by number or slug: `OSC203`, `osc203`, `203`."""

from __future__ import annotations

from functools import cache

from osc2tx.diagnostics.codes import CODES, Code
from osc2tx.diagnostics.suggestions import did_you_mean


def find_code(written: str) -> Code | None:
    """Return the code of that number, name or slug, in capitals or not."""
    if written.isdecimal():
        written = f"OSC{written}"
    return CODES.get(written.upper()) or _by_slug().get(written.lower())


def meant_code(written: str) -> str | None:
    """Return a line of help that offers the code or slug that was probably meant."""
    if written.isdecimal():
        written = f"OSC{written}"
    return did_you_mean(written.upper(), CODES, 0.8) or did_you_mean(written.lower(), _by_slug())


@cache
def _by_slug() -> dict[str, Code]:
    return {code.slug: code for code in CODES.values()}
