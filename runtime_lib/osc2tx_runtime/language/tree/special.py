"""Conditional scenarios: the arguments of an invocation determine its class (§7.3.8.2.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Generic, TypeVar

from osc2tx_shared.classes import dataclass

ScenarioT = TypeVar("ScenarioT")


@dataclass(frozen=True, slots=True)
class Special(Generic[ScenarioT]):
    """A conditional scenario, which runs instead of its base.

    Attributes:
        scenario: Its class.
        values: The arguments of the base for which it runs.
    """

    scenario: type[ScenarioT]
    values: Mapping[str, Any]


def choice(
    scenario: type[ScenarioT], specials: Sequence[Special[ScenarioT]], arguments: Mapping[str, Any]
) -> tuple[type[ScenarioT], dict[str, Any]]:
    """Return the class of an invocation, and its arguments.

    Those that select a conditional scenario are constants in it.

    Args:
        scenario: The base class, which runs if no other applies.
        specials: The conditional scenarios; the first that applies runs.
        arguments: Of the invocation.
    """
    for special in specials:
        if all(arguments[name] == value for name, value in special.values.items()):
            left = {n: value for n, value in arguments.items() if n not in special.values}
            return special.scenario, left
    return scenario, dict(arguments)
