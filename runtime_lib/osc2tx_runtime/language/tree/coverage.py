"""Coverage and recording (§7.5): values that are sampled at an event and written to the trace."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from itertools import pairwise
from typing import Any, Literal, TypedDict

from osc2tx_runtime.errors import NO_RESULT, ScenarioError, why_no_result
from osc2tx_runtime.language.tree.base import RUNNING, SUCCESS, Leaf, Status
from osc2tx_runtime.language.tree.conditions import Watch
from osc2tx_runtime.language.tree.events import Event, Occurrences, watch
from osc2tx_runtime.language.values.written_units import AnyUnit, unit_named
from osc2tx_shared.classes import dataclass

Moment = Event | Literal["start", "end"]
"""When an item is sampled: at an event, or at the start or end of the scenario."""


class ItemOptions(TypedDict, total=False):
    """The options of `cover` and `record`; see `CoverageItem`."""

    items: tuple[str, ...]
    unit: AnyUnit
    within: tuple[float, float]
    every: float
    buckets: tuple[float, ...]
    at: Moment
    ignore: Callable[[Any], bool]
    illegal: Callable[[Any], bool]
    target: int
    text: str


ROUNDING = 1e-9  # of a slice: a value this close below a boundary is on it


@dataclass(frozen=True, slots=True, kw_only=True)
class CoverageItem:
    """An item of `cover` or `record`.

    Attributes:
        name: Its name, in a nested scenario with the path before it.
        kind: `cover` or `record`.
        value: Returns the value in SI units; None for a cross of other items.
        items: The names of the crossed items.
        unit: Unit of value, range and slices.
        within: Values of interest.
        every: Width of a slice.
        buckets: Boundaries between slices.
        at: When it is sampled.
        ignore: Ignored values.
        illegal: Forbidden values.
        target: Number of hits required in each slice.
        text: Description.
    """

    name: str
    kind: str
    value: Callable[[], Any] | None = None
    items: tuple[str, ...] = ()
    unit: AnyUnit = ""
    within: tuple[float, float] | None = None
    every: float | None = None
    buckets: tuple[float, ...] = ()
    at: Moment = "end"
    ignore: Callable[[Any], bool] | None = None
    illegal: Callable[[Any], bool] | None = None
    target: int | None = None
    text: str = ""

    def shown(self, value: Any) -> Any:
        """Return a value in the item's unit."""
        if not self.unit or isinstance(value, bool | str):
            return value
        return unit_named(self.unit).of(value)

    def bucket_of(self, value: Any) -> tuple[float, float] | None:
        """Return the slice of a number in the unit of the item; None outside all slices."""
        if isinstance(value, bool | str):
            return None
        if self.buckets:
            return _between(value, self.buckets)
        if self.within is not None and not self.within[0] <= value <= self.within[1]:
            return None
        if self.every is None:
            return self.within
        start, end = self.within or (0.0, math.inf)
        low = start + math.floor((value - start) / self.every + ROUNDING) * self.every
        if low >= end:  # the last slice includes its upper bound
            low = start + (math.ceil((end - start) / self.every) - 1) * self.every
        return low, min(low + self.every, end)


def _between(value: float, boundaries: Sequence[float]) -> tuple[float, float] | None:
    last = len(boundaries) - 2
    for index, (low, high) in enumerate(pairwise(boundaries)):
        if low <= value < high or (index == last and value == high):
            return low, high
    return None


class Recording(Leaf):
    """Samples the items of a scenario while it runs, and at its end.

    Args:
        items: The items.
        scenario: Name of the scenario in the source.
    """

    open_ended = True
    service = True
    synthetic = True

    def __init__(self, items: Sequence[CoverageItem], scenario: str = "") -> None:
        super().__init__("record " + ", ".join(item.name for item in items))
        self.scenario = scenario
        self._items = {item.name: item for item in items}
        self._cut_short_at: int | None = None  # step
        self._watches: list[tuple[CoverageItem, Watch]] = []
        self._step: dict[str, int] = {}

    def initialise(self) -> None:
        """Sample the values triggered by the start, and start watching."""
        self._watches, self._step, self._cut_short_at = [], {}, None
        for item in self._items.values():
            if isinstance(item.at, Event):
                self._watches.append((item, watch(item.at, None, self.context)))
            elif item.at == "start":
                self._record(item)

    def update(self) -> Status:
        """Sample all values that are due."""
        for item, happened in self._watches:
            if happened() and (
                isinstance(happened, Occurrences)
                or self._step.get(item.name) != self.context.step  # true in all passes
            ):
                self._step[item.name] = self.context.step
                self._record(item)
        return RUNNING

    def terminate(self, new_status: Status) -> None:
        """Sample the values triggered by the end of the scenario.

        An interrupted scenario has no end.
        """
        if new_status is not SUCCESS:
            self._cut_short_at = self.context.step
            return
        for item in self._items.values():
            if item.at == "end":
                self._record(item)

    def run_ends(self, outcome: str) -> None:
        """Sample at the end of a run that fails or times out, which also ends the scenario.

        Items without a value are omitted.

        Args:
            outcome: `failure` or `timeout`.
        """
        if self.status is not RUNNING and self._cut_short_at != self.context.step:
            return
        for item in self._items.values():
            if item.at == "end":
                with suppress(ScenarioError):
                    self._record(item, outcome)

    def _record(self, item: CoverageItem, outcome: str = "") -> None:
        parts = [self._items[name] for name in item.items] or [item]
        values = [self._value(part) for part in parts]
        if any(part.ignore and part.ignore(v) for part, v in zip(parts, values, strict=True)):
            return
        shown = [part.shown(value) for part, value in zip(parts, values, strict=True)]
        slices = [part.bucket_of(value) for part, value in zip(parts, shown, strict=True)]
        is_cross = bool(item.items)
        name = f"{self.scope}.{item.name}" if self.scope else item.name
        line: dict[str, Any] = {"name": name}
        line["value"] = dict(zip(item.items, shown, strict=True)) if is_cross else shown[0]
        if item.unit:
            line["unit"] = unit_named(item.unit).name
        if any(part.buckets or part.every or part.within for part in parts):
            line["bucket"] = slices if is_cross else slices[0]
        if any(part.illegal and part.illegal(v) for part, v in zip(parts, values, strict=True)):
            line["illegal"] = True
            if not is_cross:  # its items say it
                self._note_illegal(name, line)
        if item.target is not None:
            line["target"] = item.target
        if item.text:
            line["text"] = item.text
        if outcome:
            line["outcome"] = outcome
        self.context.trace.sampled(item.kind, line)

    def _note_illegal(self, name: str, line: Mapping[str, Any]) -> None:
        value = " ".join(str(line[key]) for key in ("value", "unit") if key in line)
        found = f"{name} has the illegal value {value} at {self.context.time:.2f} s"
        self.context.illegal.setdefault(name, found)

    def _value(self, item: CoverageItem) -> Any:
        assert item.value is not None, item.name
        try:
            return item.value()
        except NO_RESULT as error:
            raise ScenarioError(
                f"{item.name} has no value: {why_no_result(error)}", self.source
            ) from error
