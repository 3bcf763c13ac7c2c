"""Limits of lateral motion on a lane."""

from __future__ import annotations

import math

__all__ = ["HEADING_LIMIT", "SIDEWAYS"]

HEADING_LIMIT = 0.5
"""Radians between the heading of a vehicle and its lane."""

SIDEWAYS = math.sin(HEADING_LIMIT)
"""Largest share of the driven path that goes sideways."""
