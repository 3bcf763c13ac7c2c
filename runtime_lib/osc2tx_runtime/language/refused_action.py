"""Stand-in for an action that cannot be made; it reports the error at its line."""

from __future__ import annotations

from typing import Any

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.base_action import BaseAction

__all__ = ["RefusedAction"]


class RefusedAction(BaseAction):
    """Stands for an action that nobody carries out, or whose arguments are wrong.

    When it is made nobody knows its place in the scenario; at setup, before the first step, it
    does, and refuses the run. Until then the tree can be shown and counted like any other.

    Args:
        name: Of the action, with its actor if there is one.
        error: Why it cannot.
        label: Label of the node.
    """

    def __init__(self, name: str, error: ScenarioError, label: str | None = None) -> None:
        super().__init__(label=label)
        self.action_name = name
        self.name = label or self.action_name
        self.error = error

    def setup(self, **kwargs: Any) -> None:
        """Refuse the run.

        Raises:
            ScenarioError: Always; it names the place.
        """
        self.error.source = self.error.source or self.source or None
        raise self.error
