"""Draws all values of a scenario repeatedly until its constraints hold."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from typing import Any

from osc2tx_runtime.errors import NO_RESULT, ScenarioError
from osc2tx_runtime.language.source_map import SourceMap
from osc2tx_runtime.language.values.broken_values import (
    NotKeptError,
    not_computed,
    not_kept,
    place_of,
)
from osc2tx_runtime.language.values.walks import Draws, Walk
from osc2tx_runtime.language.values.written_units import Unit

ATTEMPTS = 1000  # draws before constraints count as contradictory


class Drawing:
    """The draws of one scenario.

    Args:
        source: Common origin of all draws of the run, its seed.
        key: Further origin of the draws of this scenario.
        source_map: Positions in the source.
        parameters: The declared values.
        units: Units of the values that have one.
        attempts: Number of draws before a walk searches for values; 1 without alternatives.

    Attributes:
        has_drawn: Whether a value was drawn, so that another draw may succeed.
    """

    def __init__(
        self,
        source: int | str,
        key: str,
        source_map: SourceMap,
        parameters: Mapping[str, Any],
        units: Mapping[str, Unit],
        attempts: int = ATTEMPTS,
    ) -> None:
        self._source, self._key, self._source_map = source, key, source_map
        self._parameters, self._units = parameters, units
        self._most, self._attempt = attempts, 0
        self._walk: Walk | None = None  # after that many failed draws
        self._held = 0  # demands that hold, in their order
        self._waived: int | None = None  # the number of a demand that need not hold
        self._refused: int | None = (
            None  # the number of a demand that counts as broken, for the message
        )
        self._broken: Exception | None = None  # by the last draw
        self.has_drawn = False

    def draws_for(self, what: str) -> Draws:
        """Return draws that depend only on the seed and the drawn value, not on an order."""
        if self._walk is not None:
            return self._walk.draws_for(what)
        again = f"/{self._attempt}" if self._attempt else ""
        return random.Random(f"{self._source}/{what}{again}")

    def demand(self, holds: bool) -> None:
        """Demand a relation between values.

        Raises:
            NotKeptError: It does not hold.
        """
        if self._held == self._refused or not (holds or self._held == self._waived):
            raise NotKeptError(self._source_map.of_constraint(self._held))
        self._held += 1

    def settle(self, declare: Callable[[], None]) -> None:
        """Call `declare`, which draws and demands, until all demands hold.

        Raises:
            ScenarioError: They never hold, or a value cannot be computed.
        """

        def height() -> int | None:
            self._held, self.has_drawn = 0, False
            try:
                declare()
            except (*NO_RESULT, NotKeptError) as error:
                self._broken = error
                return self._held
            except ScenarioError as error:
                error.source = error.source or place_of(error, self._source_map, self._held)
                raise
            return None

        for attempt in range(self._most):
            self._attempt = attempt
            if height() is None:
                return
            if not self.has_drawn or self._most == 1:
                raise self._error("")
        self._walk = Walk(random.Random(f"{self._source}/{self._key}/walk"), height)
        if not self._walk.arrive():
            rivals = self._rivals(self._walk, height)
            height()
            raise self._error(f" in {ATTEMPTS} draws", rivals)

    def _rivals(self, walk: Walk, height: Callable[[], int | None]) -> list[Exception | None]:
        """Return the demands without which more of the others would hold."""
        reached = height() or 0
        found = []
        for self._waived in range(reached):
            if walk.can_rise(reached):
                found.append(self._waived)
        self._waived = None
        told = []
        for self._refused in found:
            height()
            told.append(self._broken)
        self._refused = None
        return told

    def _error(self, tried: str, rivals: list[Exception | None] | None = None) -> ScenarioError:
        """Return the message on the relation or value that does not hold."""
        if isinstance(self._broken, NotKeptError):
            others = [each for each in rivals or () if isinstance(each, NotKeptError)]
            return not_kept(self._broken, self._parameters, self._units, tried, others)
        assert self._broken is not None
        error = not_computed(self._broken, self._source_map, self._held, tried)
        error.__cause__ = self._broken
        return error
