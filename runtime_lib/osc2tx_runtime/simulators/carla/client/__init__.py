"""The process that holds CARLA's client library.

Requests come as lines of JSON, `[number, name, arguments]`, with responses `[number, kind, value]`:
a kind is a value, an error or a bug. Names are those of the methods of `session` (connection,
time), `levels`, `actors`, `surroundings`, `traffic_manager` and `inspection`. The end of the input
ends the session and undoes its changes. `journal` lists them, also for the next session if this one
is killed.
"""

from __future__ import annotations

import re

__all__ = ["LETTING_GO", "MISSING", "release_of"]

MISSING = 3
"""Exit code if the client library is not installed."""

LETTING_GO = 60
"""Time limit (s) of the process for restoring a server, besides loading a level."""


def release_of(version: str) -> str:
    """Return the release of a version: source builds call themselves `0.9.15-dirty`."""
    found = re.match(r"\d+\.\d+\.\d+", version)
    return found[0] if found else version
