"""Writes the tables of docs/reference/monitors.md: tolerances, and what has no monitor."""

from __future__ import annotations

import math
import re
from pathlib import Path

from osc2tx_runtime.domain.monitoring.registry import UNMONITORED
from osc2tx_runtime.domain.monitoring.tolerances import QUANTITIES

PAGE = Path(__file__).parent.parent / "docs" / "reference" / "monitors.md"


def render(page: str) -> str:
    """Return the page with its tables as they are in the code."""
    return _filled(_filled(page, "tolerances", _tolerances()), "unmonitored", _unmonitored())


def _filled(page: str, name: str, lines: list[str]) -> str:
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    text = "\n".join((begin, *lines, end))
    return re.sub(f"{begin}.*{end}", lambda _: text, page, flags=re.DOTALL)


def _tolerances() -> list[str]:
    rows = ["| quantity | exact | measured |", "|---|---|---|"]
    for name, each in QUANTITIES.items():
        unit, values = each.unit, [each.exact, each.measured]
        if unit == "rad":
            unit, values = "°", [round(math.degrees(value), 2) for value in values]
        shown = [f"{value:g} {unit}".strip() for value in values]
        rows.append(f"| {name} | {shown[0]} | {shown[1]} |")
    return rows


def _unmonitored() -> list[str]:
    by_reason: dict[str, list[str]] = {}
    for name, reason in UNMONITORED.items():
        by_reason.setdefault(reason, []).append(f"`{name}`")
    rows = ["| name | reason |", "|---|---|"]
    return rows + [f"| {', '.join(names)} | {reason} |" for reason, names in by_reason.items()]


if __name__ == "__main__":
    PAGE.write_text(render(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
