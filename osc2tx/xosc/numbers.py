"""Numbers as documents have them."""

from __future__ import annotations

LONGEST_NOTE = 60
"""Characters of a note."""


class Noted(float):
    """A number with its origin, for readers of the document; results of arithmetic have none.

    Attributes:
        note: An expression of the source.
    """

    __slots__ = ("note",)

    note: str

    def __new__(cls, value: float, note: str) -> Noted:
        """Take the number, and the text of any length that gives it."""
        made = super().__new__(cls, value)
        short = " ".join(note.split())
        made.note = short if len(short) <= LONGEST_NOTE else f"{short[: LONGEST_NOTE - 1]}…"
        return made

    # Python calls the reflected operators of derived classes first.

    def __add__(self, other: float) -> float:
        return float(self) + other

    def __sub__(self, other: float) -> float:
        return float(self) - other

    def __mul__(self, other: float) -> float:
        return float(self) * other

    def __truediv__(self, other: float) -> float:
        return float(self) / other


def number_text(value: float) -> str:
    """Return the shortest plain decimal that reads back as nearly this number.

    Twelve digits hide the noise of conversions of units: 70 km/h is 19.4444444444.
    """
    short = f"{value:.12g}"
    if "e" in short:
        short = f"{float(short):.15f}".rstrip("0")
        short = short + "0" if short.endswith(".") else short
    whole = short.removesuffix(".0")
    return "0" if whole == "-0" else whole
