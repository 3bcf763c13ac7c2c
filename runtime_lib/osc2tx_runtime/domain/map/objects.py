"""The base of objects of the map that scenarios declare."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.declared import DeclaredObject

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.world.surroundings.traffic_light_states import Signals


class MapObject(DeclaredObject):
    """An element of the map; its live members can be read while the scenario runs."""

    word = ""

    def __init__(self, map_id: str | None) -> None:
        self._map_id = map_id
        self._context: ExecutionContext | None = None

    def bind(self, context: ExecutionContext) -> None:
        """Joins a run."""
        self._context = context

    @property
    def map_id(self) -> str | None:
        """OpenDRIVE id."""
        return self._map_id

    @property
    def context(self) -> ExecutionContext:
        """The run."""
        if self._context is None:
            raise ScenarioError(f"{self.word} {self._map_id} is read before the scenario runs")
        return self._context

    @property
    def _signals(self) -> Signals:
        return self.context.world.signals

    def required_id(self) -> str:
        """The OpenDRIVE id.

        Raises:
            ScenarioError: It has no id.
        """
        if self.map_id is None:
            raise ScenarioError(
                f"a {self.word} is in no map without its id: keep(it.map_id == ...)"
            )
        return self.map_id
