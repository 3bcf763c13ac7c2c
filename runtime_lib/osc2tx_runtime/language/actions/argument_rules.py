"""Checks the arguments of calls at run time, by the rules of the compiler."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from osc2tx_runtime.errors import ScenarioError
from osc2tx_shared.rules import Rule, violations


class GivenValues:
    """Arguments in the form that the rules read.

    Args:
        values: By parameter.
    """

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values

    def __contains__(self, name: str) -> bool:
        return name in self._values

    def word(self, name: str) -> str | None:
        """Return the DSL form of an enum member; of an object its type."""
        value = self._values[name]
        if isinstance(value, bool):
            return str(value).lower()
        word = value if isinstance(value, str) else getattr(value, "kind", None)
        return word if isinstance(word, str) else None

    def bounds(self, name: str) -> tuple[float, float] | None:
        """Return a number, twice; None for a late value."""
        value = self._values[name]
        return (value, value) if isinstance(value, int | float) else None


def check_arguments(what: str, rules: Iterable[Rule], given: Mapping[str, Any]) -> None:
    """Compare arguments with rules.

    Args:
        what: The call, for the message.
        rules: What must hold.
        given: Arguments by parameter.

    Raises:
        ScenarioError: They break a rule.
    """
    for broken in violations("it", rules, GivenValues(given)):
        raise ScenarioError(f"{what}: {broken.text}")
