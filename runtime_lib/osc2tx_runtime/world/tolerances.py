"""How near measured actors have to come to what they are to do."""

from __future__ import annotations

import math

__all__ = [
    "ACCELERATION_TOLERANCE",
    "HEADING_TOLERANCE",
    "OFF_ITS_PATH",
    "PATIENCE",
    "PLACE_TOLERANCE",
    "SPEED_TOLERANCE",
    "STANDSTILL",
]

STANDSTILL = 0.05
"""m/s: who was measured slower than that stands."""
SPEED_TOLERANCE = 0.5
"""m/s off the wished speed that count as reached; at standstill none do."""
ACCELERATION_TOLERANCE = 0.5
"""m/s^2 off the wished acceleration that count as reached."""
PLACE_TOLERANCE = 0.5
"""m beside the wished path that count as on it."""
HEADING_TOLERANCE = math.radians(3.0)
"""rad off the wished heading that count as so."""
PATIENCE = 5.0
"""s after the end of its reference at which an actor has to be there."""
OFF_ITS_PATH = 1.0
"""m beside its path at which an actor has left it, if it stays so for a second."""
