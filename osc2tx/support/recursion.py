"""Recursion limit for deeply nested programs.

The token source caps the nesting of a text at 200 levels. A stage that walks such a tree needs
more frames than Python allows by default, though never more than the limit here.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager

RECURSION_LIMIT = 10_000


@contextmanager
def room_for_trees() -> Iterator[None]:
    """Conditions for large and deep trees: no garbage collection, enough stack.

    Trees are cyclic and long-lived, so collecting while they grow doubles the time.
    """
    was_enabled = gc.isenabled()
    limit = sys.getrecursionlimit()
    gc.disable()
    sys.setrecursionlimit(max(limit, RECURSION_LIMIT))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)
        if was_enabled:
            gc.enable()
