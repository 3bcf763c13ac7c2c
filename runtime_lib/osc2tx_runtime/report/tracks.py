"""The recorded movement of one actor, reduced to what the page draws."""

from __future__ import annotations

from dataclasses import dataclass, field

from .json_values import Json, number, short, text

__all__ = ["MAX_SAMPLES", "Track"]

MAX_SAMPLES = 4000
"""Samples of one actor on the page; longer runs are thinned evenly."""

_COLUMNS = {"x": 2, "y": 2, "h": 4, "v": 3, "a": 3, "s": 2, "offset": 2}
"""Decimals that are kept: centimetres, about 0.01 degrees, millimetres per second."""

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
        self._samples.append({name: number(line.get(name)) for name in _COLUMNS})
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
        """Indices of the samples that go on the page; first and last are always among them."""
        count = len(self.times)
        last = count - 1
        if all(sample == self._samples[0] for sample in self._samples):
            return [0] if last == 0 else [0, last]
        if count <= MAX_SAMPLES:
            return list(range(count))
        # Integer arithmetic: evenly spread, and the same on every machine.
        return [i * last // (MAX_SAMPLES - 1) for i in range(MAX_SAMPLES)]

    def as_json(self) -> Json:
        """Columns of equal length; a column without any value is None."""
        kept = self._kept()
        result: Json = {"t": [short(self.times[i], 4) for i in kept]}
        for name, digits in _COLUMNS.items():
            values = [self._samples[i][name] for i in kept]
            rounded = [None if value is None else short(value, digits) for value in values]
            result[name] = None if all(value is None for value in values) else rounded
        result["places"] = [[short(time, 4), road, lane] for time, road, lane in self._places]
        return result
