"""Modifiers in the form that the rules of their combinations read."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx_runtime.language.actions.argument_rules import GivenValues
from osc2tx_shared.rules import is_admissible_range

from .base import Modifier
from .movement.speed import Speed
from .registry import MODIFIERS

RULES = {name: kind.facts.rules for name, kind in MODIFIERS.items()}


class ModifierCall:
    """A modifier in the form that the rules read.

    Attributes:
        modifier: The modifier.
        name: Its name in the DSL.
        at: When it holds: `start`, `end` or `all`.
        given: Its arguments, `at` among them.
    """

    def __init__(self, modifier: Modifier) -> None:
        self.modifier = modifier
        self.name = modifier.name
        self.at = str(getattr(modifier, "at", "all"))
        self.given = GivenValues({**modifier.given(), "at": self.at})

    @property
    def shaped(self) -> bool:
        """Whether it surely says how its value is reached."""
        return isinstance(self.modifier, Speed) and self.modifier.shaped


def commanding(modifiers: Sequence[Modifier]) -> tuple[Modifier, ...]:
    """The modifiers except those that only bound what another one states for the end."""
    calls = [ModifierCall(modifier) for modifier in modifiers]
    return tuple(c.modifier for c in calls if not is_admissible_range(c, calls, RULES))
