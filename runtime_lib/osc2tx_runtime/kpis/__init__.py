"""Measures of a run, taken at each step: distances, times to collision, decelerations.

`measure` is the base class, `pairs` has the measures of two actors, `rules` collisions, lanes and
lights, `registry` all others; it finds them by name, also those of installed packages, and
evaluates them in a run.
"""

from __future__ import annotations

from .measure import Measure
from .registry import MEASURES, Measuring, measures_by_name

__all__ = ["MEASURES", "Measure", "Measuring", "measures_by_name"]
