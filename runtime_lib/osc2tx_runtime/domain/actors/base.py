"""What all actors have (DSL 8.7.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from osc2tx_runtime.errors import ScenarioError

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext

__all__ = ["Actor"]


class Actor:
    """Base of all actors.

    Attributes:
        kinds: Actor kinds of the DSL, most derived first.
        id: Name of the field that holds it; given by the scenario.
        source: Where it is declared.
    """

    kinds: ClassVar[tuple[str, ...]] = ("osc_actor",)

    def __init__(self, *, name: str | None = None) -> None:
        self.id = name or ""
        self.source: str | None = None
        self.name = name
        self._context: ExecutionContext | None = None

    def bind(self, context: ExecutionContext) -> None:
        """Joins a run: live fields read its world from now on."""
        self._context = context

    @property
    def context(self) -> ExecutionContext:
        """The run."""
        if self._context is None:
            raise ScenarioError(f"{self.id or self.kinds[0]} is read before the scenario runs")
        return self._context

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.id})"
