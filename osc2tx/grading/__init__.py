"""Measures the grade of OpenSCENARIO XML: documents are played and compared with the world.

- `grading`: the documents of a file, their reports completed; begin here
- `findings`: those of earlier builds, for documents that are played as before
- `measuring`: which runs one document gets, and how far off it is in them
- `runs`: one run of the scenario in the embedded world, one of its document in the player
- `comparison`: the deviation of one recording from another
- `imports`: the other direction, an imported scenario against its document, made `plain`
- `values`: values of open parameters for the runs
"""

from osc2tx.grading.grading import Source, graded, unplayed

__all__ = ["Source", "graded", "unplayed"]
