"""Rows of a campaign: one scenario run many times, each time with different values.

`points` are the values of a row, `rows` its inputs and results, `modules` imports the module from
its text, `executor` runs rows one after the other. A worker needs only this package: the compiler
samples, stores and reports.
"""

from __future__ import annotations

from .executor import Executor
from .modules import Modules, scenarios_of
from .points import Point
from .rows import Condition, Plan, Row, RowResult

__all__ = [
    "Condition",
    "Executor",
    "Modules",
    "Plan",
    "Point",
    "Row",
    "RowResult",
    "scenarios_of",
]
