"""Contacts of boxes in one step, each pair by itself."""

from collections.abc import Sequence
from itertools import combinations

from osc2tx_runtime.world.measuring.collision import Box, swept, touch


def swept_contacts(begin: Sequence[Box], end: Sequence[Box]) -> list[tuple[int, int]]:
    """Pairs of boxes (indices, lower first) that touch during a step, sorted."""
    pairs = combinations(range(len(begin)), 2)
    ways = [swept(b, e) for b, e in zip(begin, end, strict=True)]
    return [(i, j) for i, j in pairs if touch(ways[i], ways[j])]
