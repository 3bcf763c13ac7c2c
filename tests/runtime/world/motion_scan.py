"""Looks for motion that cannot be: jumps of places, courses beside the heading, lateral loads.

As a program it prints the worst of each actor of traces: `python -m tests.runtime.world.motion_scan
TRACE.jsonl ...`
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

_CREEP = 0.02  # m of a step from which on it has a course
SMOOTHING = 0.1
"""Seconds over which yaw rates are looked at: maps have small kinks where roads join."""

LIMITS = {"jump": 0.05, "course": math.radians(3.0), "across": 9.0, "along": 12.0}
"""What no vehicle does: beyond dry grip, sideways or with a jump (m, rad, m/s^2, m/s^2)."""


class Worst(NamedTuple):
    """The worst of one actor over a run.

    Attributes:
        jump: Metres between the way of a step and what the speed makes of it.
        course: Radians between the way of a step and the heading.
        across: m/s^2: speed times smoothed yaw rate.
        along: m/s^2.
        at: Times (s) of these four.
    """

    jump: float
    course: float
    across: float
    along: float
    at: tuple[float, float, float, float]


class Instant(NamedTuple):
    """What is looked at of a state."""

    t: float
    x: float
    y: float
    h: float
    v: float


def scan(history: Sequence[Instant], smoothing: float = SMOOTHING) -> Worst:
    """The worst of consecutive states of one actor, its yaw rate smoothed over so many seconds."""
    worst, at, rate = [0.0] * 4, [0.0] * 4, 0.0
    for before, after in pairwise(history):
        dt = after.t - before.t
        turn = _turn(before.h, after.h)
        rate += dt / (smoothing + dt) * (turn / dt - rate)
        way = math.hypot(after.x - before.x, after.y - before.y)
        course = 0.0
        if way > _CREEP:
            direction = math.atan2(after.y - before.y, after.x - before.x)
            course = abs(_turn(before.h + 0.5 * turn, direction))
            course = min(course, math.pi - course)
        found = (
            abs(way - 0.5 * abs(before.v + after.v) * dt),
            course,
            abs(rate * after.v),
            abs(after.v - before.v) / dt,
        )
        for i, value in enumerate(found):
            if value > worst[i]:
                worst[i], at[i] = value, after.t
    return Worst(*worst, (at[0], at[1], at[2], at[3]))


def scan_lines(
    lines: Iterable[Mapping[str, Any]], smoothing: float = SMOOTHING
) -> dict[str, Worst]:
    """The worst of each actor of a trace."""
    histories: dict[str, list[Instant]] = {}
    for line in lines:
        if line["kind"] == "state":
            instant = Instant(*(line[name] for name in Instant._fields))
            histories.setdefault(line["actor"], []).append(instant)
    return {actor: scan(history, smoothing) for actor, history in histories.items()}


def impossible(lines: Iterable[Mapping[str, Any]], smoothing: float = SMOOTHING) -> set[str]:
    """Kinds of motion in a trace that cannot be."""
    worst = scan_lines(lines, smoothing).values()
    return {kind for kind, most in LIMITS.items() if any(getattr(w, kind) > most for w in worst)}


def _turn(before: float, after: float) -> float:
    return math.pi - (math.pi - (after - before)) % math.tau


def _table(paths: Iterable[Path]) -> Iterable[str]:
    yield "trace, actor: jump (m), course (degrees), across and along (m/s^2)"
    for path in paths:
        with path.open(encoding="utf-8") as lines:
            found = scan_lines(map(json.loads, lines), smoothing=0.0)
        for actor, worst in found.items():
            figures = (worst.jump, math.degrees(worst.course), worst.across, worst.along)
            yield f"{path.stem}, {actor}: " + ", ".join(f"{figure:.2f}" for figure in figures)


if __name__ == "__main__":
    print(*_table(map(Path, sys.argv[1:])), sep="\n")
