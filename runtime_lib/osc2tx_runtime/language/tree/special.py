"""Conditional scenarios: which class an invocation runs depends on its arguments (§7.3.8.2.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Generic, TypeVar

from osc2tx_shared.classes import dataclass

ScenarioT = TypeVar("ScenarioT")


@dataclass(frozen=True, slots=True)
class Special(Generic[ScenarioT]):
    """A scenario that runs instead of its base.

    Attributes:
        scenario: Its class.
        values: The arguments that an invocation of the base has then.
    """

    scenario: type[ScenarioT]
    values: Mapping[str, Any]


def choice(
    scenario: type[ScenarioT], specials: Sequence[Special[ScenarioT]], arguments: Mapping[str, Any]
) -> tuple[type[ScenarioT], dict[str, Any]]:
    """Return the class that an invocation runs, and the arguments that it takes.

    Those that a special scenario depends on are constants in it.

    Args:
        scenario: The class of the base, which runs if none of the others applies.
        specials: Those of which the first that applies runs.
        arguments: Of the invocation.
    """
    for special in specials:
        if all(arguments[name] == value for name, value in special.values.items()):
            left = {n: value for n, value in arguments.items() if n not in special.values}
            return special.scenario, left
    return scenario, dict(arguments)
