"""Who looks at a run while it goes on, without a trace."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from osc2tx_runtime.language.context import ExecutionContext

__all__ = ["Observer"]


class Observer(Protocol):
    """Is told of a run as it goes on; what it raises ends the run."""

    def begin(self, context: ExecutionContext) -> None:
        """See the actors where they start, before the first step."""

    def observe(self, step: int) -> None:
        """See what the way to a step has brought about."""

    def sampled(self, kind: str, values: Mapping[str, Any]) -> None:
        """Take the value of a coverage item, `cover` or `record`, as the trace has it."""
