"""Recursion limit and garbage collection for large and deeply nested programs.

The token source caps the nesting of a text at 200 levels. A stage that walks such a tree needs
more frames than Python allows by default, though never more than the limit here.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager

RECURSION_LIMIT = 10_000
MOST_UNSEEN = 400_000
"""Number of objects, about 50 MB, that may wait for a collection between two programs."""


class _Collector:
    """Collects the trees of earlier programs before those of the next one grow.

    Trees are cyclic and long-lived. A collection while they grow, or right after, takes up to an
    eighth of the time of a check and finds nothing: what is new is moved to the oldest generation
    unseen.
    """

    def __init__(self) -> None:
        self._unseen = 0

    def collect_earlier(self) -> None:
        """Collect the garbage of earlier programs, if it is large."""
        if self._unseen > MOST_UNSEEN:
            gc.collect()
            self._unseen = 0

    def keep_new(self) -> None:
        """Move all new objects to the oldest generation without a look at them."""
        self._unseen += gc.get_count()[0]
        gc.freeze()
        gc.unfreeze()


_COLLECTOR = _Collector()


def collect_earlier_trees() -> None:
    """Collect the garbage of earlier programs, if it is large, while the process is idle."""
    _COLLECTOR.collect_earlier()


@contextmanager
def allowing_deep_trees() -> Iterator[None]:
    """Conditions for large and deep trees: no garbage collection, enough stack."""
    was_enabled = gc.isenabled()
    limit = sys.getrecursionlimit()
    if was_enabled:
        _COLLECTOR.collect_earlier()
    gc.disable()
    sys.setrecursionlimit(max(limit, RECURSION_LIMIT))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)
        if was_enabled:
            _COLLECTOR.keep_new()
            gc.enable()
