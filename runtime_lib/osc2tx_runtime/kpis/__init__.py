"""Measures of a run, taken in the loop of steps: how near actors came, how hard they braked.

`measure` is the base class, `pairs` has the measures of two actors, `rules` collisions, lanes and
lights, `registry` all others; it finds them by name, those of installed packages too, and takes
them in a run.
"""

from __future__ import annotations

from .measure import Measure
from .registry import MEASURES, Measuring, measures_by_name

__all__ = ["MEASURES", "Measure", "Measuring", "measures_by_name"]
