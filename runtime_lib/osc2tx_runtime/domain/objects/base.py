"""The base class of all actors of the domain model (DSL 8.7.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.declared import BaseActor

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext


class Actor(BaseActor):
    """Base of all actors."""

    _context: ExecutionContext | None = None

    def bind(self, context: ExecutionContext) -> None:
        """Joins a run: live fields then read its world."""
        self._context = context

    @property
    def context(self) -> ExecutionContext:
        """The run."""
        if self._context is None:
            raise ScenarioError(f"{self.id or self.kinds[0]} is read before the scenario runs")
        return self._context
