"""Numbers as documents have them."""

from __future__ import annotations


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
