"""The worlds that a run can choose from, by name: `--world NAME`.

A world is described by a `WorldType`: its options, and the function that creates it from a
`WorldRequest`. `embedded` describes that of this package; `registry` finds those of installed
packages in the entry point group `osc2tx.worlds`. See docs/extending.md.
"""

from __future__ import annotations

from .embedded import EMBEDDED
from .registry import ENTRY_POINTS, find_world
from .world_type import CheckRequest, CheckResult, Option, WorldRequest, WorldType

__all__ = [
    "EMBEDDED",
    "ENTRY_POINTS",
    "CheckRequest",
    "CheckResult",
    "Option",
    "WorldRequest",
    "WorldType",
    "find_world",
]
