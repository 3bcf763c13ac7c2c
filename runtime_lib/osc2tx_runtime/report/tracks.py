"""The recorded movement of one actor, reduced to the data that the page draws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field

from osc2tx_shared.classes import dataclass

from .json_values import Json, number, short, text

Packed = list[int | list[int] | None]


def pack(values: Sequence[float | None], digits: int) -> Packed:
    """Return a column as second differences, in units of the last digit.

    What moves steadily has differences of zero, so most of a column is runs of equal numbers. A
    run of more than two is written as `[number, count]`. Unknown values stay None.
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
"""Columns, and the decimals that are kept: centimetres, 0.01 degrees, millimetres per second."""

_Sample = dict[str, float | None]


@dataclass
class Track:
    """State lines of one actor in order of time."""

    times: list[float] = field(default_factory=list)
    _samples: list[_Sample] = field(default_factory=list)
    _places: list[tuple[float, str, str]] = field(default_factory=list)

    def add(self, time: float, line: Json) -> bool:
        """Take one state line at `time` (s); False if it has no usable position."""
        if number(line.get("x")) is None or number(line.get("y")) is None:
            return False
        if self.times and time <= self.times[-1]:
            return False
        self.times.append(time)
        self._samples.append({name: number(line.get(name)) for name in DIGITS})
        self._note_place(time, text(line.get("road")), text(line.get("lane")))
        return True

    def _note_place(self, time: float, road: str, lane: str) -> None:
        """Road and lane change seldom, so only the changes are kept."""
        if not self._places or self._places[-1][1:] != (road, lane):
            self._places.append((time, road, lane))

    def points(self) -> list[tuple[float, float]]:
        """All reference points (m)."""
        return [(sample["x"] or 0.0, sample["y"] or 0.0) for sample in self._samples]

    def _kept(self) -> list[int]:
        """Indices of the samples for the page; first and last are always among them."""
        count = len(self.times)
        last = count - 1
        if self._is_at_rest():
            return [0] if last == 0 else [0, last]
        if count <= MAX_SAMPLES:
            return list(range(count))
        # Integer arithmetic: evenly spread, and the same on every machine.
        return [i * last // (MAX_SAMPLES - 1) for i in range(MAX_SAMPLES)]

    def _is_at_rest(self) -> bool:
        first = {**self._samples[0], "t": None}
        return all({**sample, "t": None} == first for sample in self._samples)

    def as_json(self) -> Json:
        """Columns of equal length, packed; a column without any value is None."""
        kept = self._kept()
        result: Json = {}
        for name, digits in DIGITS.items():
            values = [self._samples[i][name] for i in kept]
            known = any(value is not None for value in values)
            result[name] = pack(values, digits) if known else None
        result["places"] = [[short(time, 4), road, lane] for time, road, lane in self._places]
        return result
