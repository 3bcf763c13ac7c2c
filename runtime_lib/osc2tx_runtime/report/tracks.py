"""The recorded movement of one actor, reduced to the data that the page draws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field

from osc2tx_shared.classes import dataclass

from .json_values import Json, number, short, text
from .nearby_lanes import cell

Packed = list[int | list[int] | None]


def pack(values: Sequence[float | None], digits: int) -> Packed:
    """Return a column as second differences, in units of the last digit.

    Steady motion has differences of zero, so most of a column is runs of equal numbers. A run of
    more than two is written as `[number, count]`. Unknown values stay None.
    """
    scale = 10**digits
    packed: Packed = []
    before, slope = 0, 0
    for value in values:
        if value is None:
            packed.append(None)
            continue
        whole = round(value * scale)
        packed.append(whole - before - slope)
        before, slope = whole, whole - before
    return _shortened(packed)


def _shortened(packed: Packed) -> Packed:
    result: Packed = []
    start = 0
    for index in range(1, len(packed) + 1):
        if index < len(packed) and packed[index] == packed[start]:
            continue
        number, count = packed[start], index - start
        if isinstance(number, int) and count > 2:
            result.append([number, count])
        else:
            result += [number] * count
        start = index
    return result


MAX_SAMPLES = 4000
"""Samples of one actor on the page; longer runs are thinned evenly."""

DIGITS = {"t": 4, "x": 2, "y": 2, "h": 4, "v": 3, "a": 3, "s": 2, "offset": 2}
"""Columns, and the kept decimals: centimetres, 0.01 degrees, millimetres per second."""

_Sample = dict[str, float | None]
_Point = tuple[float, float]


@dataclass
class Track:
    """State lines of one actor in order of time, thinned as they come.

    At first all samples are kept. Whenever there are twice as many as the page shows, every second
    one is dropped, and so are further lines in between: memory does not grow with the length of a
    run.
    """

    _samples: list[_Sample] = field(default_factory=list)
    _places: list[tuple[float, str, str]] = field(default_factory=list)
    _passed: dict[tuple[int, int], _Point] = field(default_factory=dict)
    _rim: tuple[_Point, ...] = ()
    _last: _Sample = field(default_factory=dict)
    _count: int = 0
    _stride: int = 1
    _is_at_rest: bool = True

    def add(self, time: float, line: Json) -> bool:
        """Add one state line at `time` (s); False if it has no usable position."""
        x, y = number(line.get("x")), number(line.get("y"))
        if x is None or y is None:
            return False
        if self._count and time <= (self._last["t"] or 0.0):
            return False
        sample = {name: number(line.get(name)) for name in DIGITS}
        sample["t"] = time
        if self._samples and self._is_at_rest:
            self._is_at_rest = {**sample, "t": None} == {**self._samples[0], "t": None}
        if self._count % self._stride == 0:
            self._samples.append(sample)
            if len(self._samples) > 2 * MAX_SAMPLES:
                del self._samples[1::2]
                self._stride *= 2
        self._last = sample
        self._count += 1
        self._note_point(x, y)
        self._note_place(time, text(line.get("road")), text(line.get("lane")))
        return True

    def _note_point(self, x: float, y: float) -> None:
        """Keep one point per cell, and one at each rim of the path."""
        self._passed.setdefault(cell((x, y)), (x, y))
        west, east, south, north = self._rim or ((x, y),) * 4
        self._rim = (
            (x, y) if x < west[0] else west,
            (x, y) if x > east[0] else east,
            (x, y) if y < south[1] else south,
            (x, y) if y > north[1] else north,
        )

    def _note_place(self, time: float, road: str, lane: str) -> None:
        """Keep only changes of road and lane."""
        if not self._places or self._places[-1][1:] != (road, lane):
            self._places.append((time, road, lane))

    def points(self) -> list[_Point]:
        """Reference points (m): one in each cell (`cell`) that it passes, and those at the rim."""
        return [*self._passed.values(), *self._rim]

    def _kept(self) -> list[_Sample]:
        """The samples for the page; first and last are always among them."""
        samples = self._samples
        if samples[-1] is not self._last:
            samples = [*samples, self._last]
        last = len(samples) - 1
        if self._is_at_rest:
            return samples[:1] if last == 0 else [samples[0], samples[-1]]
        if last < MAX_SAMPLES:
            return samples
        # Integer arithmetic: evenly spread, and the same on all machines.
        return [samples[i * last // (MAX_SAMPLES - 1)] for i in range(MAX_SAMPLES)]

    def as_json(self) -> Json:
        """Columns of equal length, packed; a column without any value is None."""
        kept = self._kept()
        result: Json = {}
        for name, digits in DIGITS.items():
            values = [sample[name] for sample in kept]
            known = any(value is not None for value in values)
            result[name] = pack(values, digits) if known else None
        result["places"] = [[short(time, 4), road, lane] for time, road, lane in self._places]
        return result
