"""The inputs and the result of a row of a campaign."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import field
from typing import Any

from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.plain_numbers import to_float
from osc2tx_shared.classes import dataclass

CRASHED = "crashed"
"""Status of a row that ended its process, each time."""

_COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "<=": operator.le,
    ">=": operator.ge,
    "<": operator.lt,
    ">": operator.gt,
}


@dataclass(frozen=True, slots=True)
class Condition:
    """A condition that makes a row fail, whatever the scenario states: `min_ttc < 1.5`.

    Attributes:
        measure: Name of a measure.
        comparison: `<`, `<=`, `>` or `>=`.
        bound: SI units.
    """

    measure: str
    comparison: str
    bound: float

    @classmethod
    def parse(cls, text: str) -> Condition:
        """Read `min_ttc<1.5`.

        Raises:
            SettingsError: It is invalid.
        """
        for sign in _COMPARISONS:
            measure, found, bound = text.partition(sign)
            if not found:
                continue
            try:
                return cls(measure.strip(), sign, to_float(bound.strip()))
            except ValueError:
                break
        raise SettingsError(
            f"--fail-if {text}: write MEASURE<NUMBER in SI units, as in --fail-if min_ttc<1.5"
        )

    def broken_by(self, measures: Mapping[str, float | None]) -> str:
        """Return why measures make a row fail; nothing if they do not."""
        value = measures.get(self.measure)
        if value is None or not _COMPARISONS[self.comparison](value, self.bound):
            return ""
        return f"{self.measure} {value:.6g} {self.comparison} {self.bound:g}"

    def __str__(self) -> str:
        return f"{self.measure}{self.comparison}{self.bound!r}"


@dataclass(frozen=True, slots=True)
class Plan:
    """What all rows of a campaign have in common; workers get it once.

    Attributes:
        files: Path of each file in a folder to its text: modules and source maps.
        module: Path of the module of the scenario.
        scenario: Its name in the source.
        settings: Of each run, apart from the values of a row.
        measures: Names of the measures.
        fail_if: Further conditions of failure.
        digests: Whether the trace of each row is written, for its digest.
    """

    files: Mapping[str, str]
    module: str
    scenario: str
    settings: RunSettings = field(default_factory=RunSettings)
    measures: tuple[str, ...] = ()
    fail_if: tuple[Condition, ...] = ()
    digests: bool = False


@dataclass(frozen=True, slots=True)
class Row:
    """A row to run.

    Attributes:
        number: From 0; its meaning depends only on the campaign.
        seed: Of the run.
        shares: Positions of parameters in their domains; None: drawn from the seed.
        set: Values of parameters.
    """

    number: int
    seed: int
    shares: Mapping[str, float] | None = None
    set: Mapping[str, float | str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RowResult:
    """The outcome of a row.

    Attributes:
        row: The row.
        values: Its parameters.
        status: `success`, `failure`, `timeout`; `error` if it could not be run; `crashed`.
        reason: Empty for success.
        source: Source position of the error.
        steps: Steps the world made.
        time: Simulated seconds.
        measures: By name; None without a value.
        collisions: Time in seconds, the two actors, their difference of speed in m/s.
        violations: Conditions that did not hold: code, source position and finding.
        samples: `cover` or `record`, and the line that the trace has of the item, as JSON.
        digest: SHA-256 of the trace, if requested.
        seconds: Seconds that it took on this machine.
        attempts: Number of attempts.
    """

    row: Row
    values: Mapping[str, Any]
    status: str
    reason: str = ""
    source: str | None = None
    steps: int = 0
    time: float = 0.0
    measures: Mapping[str, float | None] = field(default_factory=dict)
    collisions: tuple[tuple[float, str, str, float], ...] = ()
    violations: tuple[str, ...] = ()
    samples: tuple[tuple[str, str], ...] = ()
    digest: str | None = None
    seconds: float = 0.0
    attempts: int = 1
