"""Overlaps of `parallel` as bounds of offsets, in seconds or steps (§7.3.13.2, §7.6.2.1.4).

For each kind: start to start and end to end, from the first member to each other one.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import TypeAlias

Bounds: TypeAlias = tuple[float, float]
"""Least and greatest offset."""

ANY, NONE, UP, DOWN = (-inf, inf), (0.0, 0.0), (0.0, inf), (-inf, 0.0)

OFFSETS: Mapping[str, tuple[Bounds, Bounds]] = {
    "equal": (NONE, NONE),
    "start": (NONE, ANY),
    "end": (ANY, NONE),
    "initial": (DOWN, ANY),
    "final": (ANY, UP),
    "inside": (UP, DOWN),
    "full": (DOWN, UP),
    "any": (ANY, ANY),
}
