"""A sampler that takes its rows from a table: replays what another tool has chosen."""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from osc2tx.campaigns.errors import CampaignError
from osc2tx.campaigns.sampling import row_seed
from osc2tx_classes import dataclass
from osc2tx_runtime.campaigns import Row

__all__ = ["TableSampler"]


@dataclass(frozen=True, slots=True)
class TableSampler:
    """Rows of a CSV file: names of parameters in the first line, values as for `--set` below."""

    digest: str
    names: Sequence[str]
    lines: Sequence[Sequence[str]]
    seed: int
    is_checked: bool = False  # what somebody asks for by hand is run, and fails, in the open

    @classmethod
    def read(cls, file: str, seed: int) -> TableSampler:
        """Read a file.

        Raises:
            CampaignError: It cannot be read, or a line has too many or too few values.
        """
        try:
            text = Path(file).read_text(encoding="utf-8-sig")
        except (OSError, ValueError) as error:
            raise CampaignError(f"--sampler table:{file}: it cannot be read: {error}") from error
        lines = [line for line in csv.reader(io.StringIO(text)) if line]
        if not lines:
            raise CampaignError(f"--sampler table:{file}: it is empty; name parameters in a line")
        names = [name.strip() for name in lines[0]]
        for number, line in enumerate(lines[1:]):
            if len(line) != len(names):
                raise CampaignError(
                    f"--sampler table:{file}: row {number} has {len(line)} values, the first line"
                    f" names {len(names)} parameters"
                )
        return cls(hashlib.sha256(text.encode()).hexdigest(), names, lines[1:], seed)

    @property
    def identity(self) -> Mapping[str, Any]:
        """What is in the file."""
        return {"table": self.digest}

    def rows(self) -> Iterator[Row]:
        """Yield all rows."""
        for number, line in enumerate(self.lines):
            values = dict(zip(self.names, map(_value, line), strict=True))
            yield Row(number, row_seed(self.seed, number), None, values)


def _value(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text.strip()
