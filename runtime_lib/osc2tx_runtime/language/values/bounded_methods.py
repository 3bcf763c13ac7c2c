"""The budget of methods that call several others, whose calls multiply level by level."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from osc2tx_runtime.errors import ScenarioError

MOST_CALLS = 100_000
"""Calls of such methods for one value."""

P = ParamSpec("P")
R = TypeVar("R")


class _Calls:
    """The calls since the outermost one."""

    number = 0
    depth = 0


def bounded(method: Callable[P, R]) -> Callable[P, R]:
    """Count the calls of a method towards the budget of the value that is computed.

    Args:
        method: A method of a generated class that calls several methods.

    Raises:
        ScenarioError: The call exceeds the budget.
    """

    @wraps(method)
    def counted(*args: P.args, **kwargs: P.kwargs) -> R:
        if not _Calls.depth:
            _Calls.number = 0
        _Calls.number += 1
        if _Calls.number > MOST_CALLS:
            name = method.__name__.rstrip("_")
            raise ScenarioError(
                f"method `{name}` leads to more than {MOST_CALLS:,} calls for one value;"
                " let it call fewer methods, or keep their results in parameters"
            )
        _Calls.depth += 1
        try:
            return method(*args, **kwargs)
        finally:
            _Calls.depth -= 1

    return counted
