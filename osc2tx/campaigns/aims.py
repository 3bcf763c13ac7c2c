"""The aim of a search: the worst value of a KPI."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from osc2tx_runtime.kpis import measures_by_name
from osc2tx_shared.classes import dataclass

from .store import CampaignError

MANNERS = ("min", "max")


@dataclass(frozen=True, slots=True)
class Aim:
    """The aim of a search.

    Attributes:
        kpi: Name of a value of a measure: `min_ttc`, or `min_ttc(ego,other)` for a pair.
        manner: `min` for its least value, `max` for its greatest.
        batch: How many rows are chosen together, before their outcomes are looked at.
    """

    kpi: str
    manner: str
    batch: int = 16

    @classmethod
    def parse(cls, text: str, measured: Sequence[str], batch: int) -> Aim:
        """Read `min_ttc`, whose measure defines the worst values, or `max:min_ttc`.

        Raises:
            CampaignError: The measure does not define the worst values.
            SettingsError: The measure is not selected.
        """
        manner, sign, kpi = text.partition(":")
        if sign and manner in MANNERS:
            return cls(kpi, manner, batch)
        measure = measures_by_name(measured).get(text.partition("(")[0])
        declared = getattr(measure, "worst", None)
        if declared not in MANNERS:
            raise CampaignError(
                f"--search {text}: "
                + ("its worst values are not defined" if measure else "no --kpi")
                + f"; state which: --search min:{text}, or max:{text}"
            )
        return cls(text, declared, batch)

    @property
    def in_words(self) -> str:
        """The extreme that is searched: the least or the greatest value."""
        return "least" if self.manner == "min" else "greatest"

    def value(self, measures: Mapping[str, float | None]) -> float:
        """Return the measure of a row; the opposite extreme if it has none."""
        found = measures.get(self.kpi)
        if found is None:
            return math.inf if self.manner == "min" else -math.inf
        return found

    def best(self, rows: Mapping[int, Mapping[str, float | None]]) -> tuple[int, float] | None:
        """Return the row that is nearest to the aim and its value; None if no row has one."""
        values = {number: self.value(measures) for number, measures in sorted(rows.items())}
        found = {number: value for number, value in values.items() if math.isfinite(value)}
        if not found:
            return None
        number = (min if self.manner == "min" else max)(found, key=found.__getitem__)
        return number, found[number]
