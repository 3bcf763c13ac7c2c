"""`osc2tx world check carla`: the properties of a server, line by line.

`table` runs the lines, in order: `contact` (library, ports, version, time), `surroundings` (map,
ground, blueprints, lights), `motion` (steps, poses, speeds; these take the server over for a
while). `probe` has their connections.
"""

from __future__ import annotations

from .table import check

__all__ = ["check"]
