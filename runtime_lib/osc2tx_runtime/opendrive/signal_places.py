"""Positions on lanes at which signals are valid."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from .model import DRIVING, Road
from .signals import Signal, SignalReference


class SignalPlace(NamedTuple):
    """A position on a lane at which a signal is valid.

    Attributes:
        signal: Id of the signal.
        s: Road coordinate (m).
    """

    signal: str
    s: float


def signal_places(
    roads: Mapping[str, Road], signals: Iterable[Signal]
) -> dict[tuple[str, int], tuple[SignalPlace, ...]]:
    """Positions by road and driving lane, in order of s.

    A signal is valid at its position and at those of its references, for the lanes of its validity
    with its orientation.
    """
    places: dict[tuple[str, int], list[SignalPlace]] = {}
    for signal in signals:
        where: tuple[Signal | SignalReference, ...] = (signal, *signal.references)
        for entry in where:
            for lane in _lanes(roads, entry):
                places.setdefault((entry.road, lane), []).append(SignalPlace(signal.id, entry.s))
    return {key: tuple(sorted(set(found), key=lambda p: p.s)) for key, found in places.items()}


def _lanes(roads: Mapping[str, Road], entry: Signal | SignalReference) -> Iterator[int]:
    road = roads.get(entry.road)
    if road is None:
        return
    section = road.section_at(min(max(entry.s, 0.0), road.length))
    ranges = [(min(pair), max(pair)) for pair in entry.validity]
    valid = [
        lane
        for lane in section.lanes.values()
        if lane.type in DRIVING
        and (not ranges or any(low <= lane.id <= high for low, high in ranges))
    ]
    facing = [
        lane
        for lane in valid
        if entry.orientation not in ("+", "-") or (lane.direction > 0) == (entry.orientation == "+")
    ]
    # Maps of CARLA state lanes of the other direction; the stated lanes count then.
    yield from (lane.id for lane in facing or (valid if ranges else []))
