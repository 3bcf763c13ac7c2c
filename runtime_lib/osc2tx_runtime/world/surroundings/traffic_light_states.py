"""States of the traffic lights of the map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx_runtime.enums import BulbState, SemanticTrafficLightState
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import Controller, RoadMap, SignalPlace

from .traffic_light_lamps import BOXES, Lamp, meaning_of

OFF: BulbState = "is_off"

LinePlace = tuple[str, int, float]
"""Road, lane and road coordinate (m)."""
LaneLines = Mapping[tuple[str, int], tuple[SignalPlace, ...]]
"""Stop lines by road and lane, in order of s."""

_NAMED = 12  # greatest number of signals in a message


class Signals:
    """The states of the lights of a map; all are off until they are switched.

    Lights of a simulator run their own cycles until the scenario switches one of them.

    Values set at step k can be read from step k+1.

    Args:
        road_map: The map.
    """

    def __init__(self, road_map: RoadMap) -> None:
        self._map_name = road_map.name
        self._types = {s.id: s.type for s in road_map.signals() if s.dynamic}
        self._groups: Mapping[str, Controller] = {c.id: c for c in road_map.controllers()}
        self._boxes: dict[str, tuple[Lamp, ...]] = {
            each: BOXES[type_] for each, type_ in self._types.items() if type_ in BOXES
        }
        self._shown: dict[str, tuple[BulbState, ...]] = {}
        self._shown_by: dict[str, object] = {}
        self._moved: dict[str, tuple[LinePlace, ...]] = {}

    # --- lights and groups --------------------------------------------------------------------

    def lamps(self, signal: str) -> tuple[Lamp, ...]:
        """Lamps of a light.

        Raises:
            ScenarioError: The map has no such traffic light, or its lamps are unknown.
        """
        found = self._boxes.get(signal)
        if found is not None:
            return found
        if signal in self._types:
            raise ScenarioError(
                f"which lamps traffic light {signal} of map {self._map_name} has is not known (its"
                f" type is {self._types[signal]}); list them: keep(it.bulbs == [...])"
            )
        known = ", ".join(list(self._types)[:_NAMED]) or "none"
        raise ScenarioError(
            f"map {self._map_name} has no traffic light {signal}; those it has: {known}"
        )

    def describe(self, signal: str, lamps: Sequence[Lamp]) -> None:
        """Sets the lamps of a light, instead of those of its type.

        Raises:
            ScenarioError: The map has no such traffic light.
        """
        if signal not in self._types:
            self.lamps(signal)
        self._boxes[signal] = tuple(lamps)

    def members(self, group: str) -> tuple[str, ...]:
        """Traffic lights of a group: the signals of a controller of the map.

        Raises:
            ScenarioError: The map has no such controller.
        """
        found = self._groups.get(group)
        if found is None:
            known = ", ".join(list(self._groups)[:_NAMED]) or "none"
            raise ScenarioError(
                f"map {self._map_name} has no group of traffic lights {group}; those it has:"
                f" {known}"
            )
        return tuple(signal for signal in found.signals if signal in self._types)

    def group_of(self, signal: str) -> str | None:
        """Id of the group that a traffic light belongs to."""
        return next((g.id for g in self._groups.values() if signal in g.signals), None)

    # --- stop lines ---------------------------------------------------------------------------

    def stop_at(self, signal: str, places: Sequence[LinePlace]) -> None:
        """Moves the stop lines of a traffic light from their positions in the map."""
        self._moved[signal] = tuple(places)

    def lines(self, of_map: LaneLines) -> LaneLines:
        """Stop lines of the map, with those that have been moved.

        Args:
            of_map: The lines of the map.
        """
        if not self._moved:
            return of_map
        found = {
            lane: [place for place in places if place.signal not in self._moved]
            for lane, places in of_map.items()
        }
        for signal, moved in self._moved.items():
            for road, lane, s in moved:
                found.setdefault((road, lane), []).append(SignalPlace(signal, s))
        return {lane: tuple(sorted(places, key=lambda p: p.s)) for lane, places in found.items()}

    # --- states -------------------------------------------------------------------------------

    def states(self, signal: str) -> tuple[BulbState, ...]:
        """States of the lamps at the present step, in their order."""
        return self._shown.get(signal) or tuple(OFF for _ in self.lamps(signal))

    def meaning(self, signal: str) -> SemanticTrafficLightState:
        """The meaning of the light at the present step."""
        return meaning_of(self.lamps(signal), self.states(signal))

    def lit(self) -> Mapping[str, tuple[BulbState, ...]]:
        """States of the lights that were switched, at the present step."""
        return self._shown

    # --- writing ------------------------------------------------------------------------------

    def show(self, signal: str, lamp: int, state: BulbState, by: object) -> bool:
        """Switches a lamp; returns whether that changes anything.

        Args:
            signal: The light.
            lamp: Number of its lamp, from 0.
            state: Its new state.
            by: The origin of the change, for `shown_by`.
        """
        before = self.states(signal)
        new = (*before[:lamp], state, *before[lamp + 1 :])
        changes = signal not in self._shown_by or before != new
        self._shown[signal] = new
        self._shown_by[signal] = by
        return changes

    def observe(self, signal: str, states: tuple[BulbState, ...]) -> None:
        """Notes the state of a light in a simulator, unless the scenario has switched it.

        Args:
            signal: The light.
            states: States of its lamps, in their order, at the end of the step.
        """
        if signal not in self._shown_by:
            self._shown[signal] = states

    def shown_by(self, signal: str) -> object:
        """The origin of the last change of a light."""
        return self._shown_by.get(signal)
