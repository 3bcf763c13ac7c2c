"""Takes measures in a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from osc2tx_runtime.errors import OwnCode
from osc2tx_runtime.language.context import ExecutionContext

from .measure import Measure, scene_of
from .rules import Collisions


class Measuring:
    """The measures of one run, as its observer; it also keeps what coverage items sample.

    Args:
        makers: Make them, when the run begins.

    Attributes:
        samples: `cover` or `record`, and the fields of the value in the trace.
    """

    def __init__(self, makers: Iterable[Callable[[], Measure]]) -> None:
        self._makers = tuple(makers)
        self._measures: tuple[Measure, ...] = ()
        self._context: ExecutionContext | None = None
        self.samples: list[tuple[str, Mapping[str, Any]]] = []

    def begin(self, context: ExecutionContext) -> None:
        """See the actors where they start; what was seen of a start before it does not count."""
        self._context = context
        self._measures = tuple(make() for make in self._makers)
        self.samples.clear()
        self.observe(0)

    def observe(self, step: int) -> None:
        """See where a step led."""
        assert self._context is not None, "it has begun"
        if not self._measures:
            return
        scene = scene_of(self._context, step)
        for measure in self._measures:
            with OwnCode(f"measure {type(measure).__name__} raised"):
                measure.observe(scene)

    def sampled(self, kind: str, values: Mapping[str, Any]) -> None:
        """Keep the value of a coverage item."""
        self.samples.append((kind, dict(values)))

    def results(self) -> dict[str, float | None]:
        """Return all values by name; none of a run that never began."""
        found: dict[str, float | None] = {}
        for measure in self._measures:
            found.update(measure.results())
        return found

    @property
    def collisions(self) -> tuple[tuple[float, str, str, float], ...]:
        """Contacts: time (s), both actors, difference of their velocities (m/s)."""
        found = (each.found for each in self._measures if isinstance(each, Collisions))
        return tuple(contact for contacts in found for contact in contacts)
