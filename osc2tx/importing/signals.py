"""Traffic lights: what they show, and conditions on that."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.importing.cursor import Node
from osc2tx.importing.names import Names, snake
from osc2tx.importing.program import Declared
from osc2tx.importing.statements import Call, call
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Unresolved
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world.surroundings.traffic_light_states import Signals

STATES: Mapping[str, str] = {"on": "is_on", "off": "is_off", "flashing": "is_flashing"}
CONTROLLER = "lights"


class TrafficLights:
    """The traffic lights of a document.

    Attributes:
        declared: Their declarations.
        is_switched: Whether an action switches one, for which a controller is declared.
    """

    def __init__(self, road_map: RoadMap | None, values: Values, names: Names) -> None:
        self._signals = None if road_map is None else Signals(road_map)
        self._values, self._names = values, names
        self._declared: dict[str, str] = {}
        self.declared: list[Declared] = []
        self.is_switched = False

    def switch(self, node: Node) -> Call:
        """Return the invocation that lets a light show something.

        Raises:
            Unresolved: The map has no such light, or its lamps have no such states.
        """
        light, states = self._read(node)
        self.is_switched = True
        return call(CONTROLLER, "set_state", traffic_light=light, state=states)

    def shows(self, node: Node) -> str:
        """Return the condition that a light shows something.

        Raises:
            Unresolved: The map has no such light, or its lamps have no such states.
        """
        light, states = self._read(node)
        return f"{light}.state_equal(bulbs: {states})"

    def _read(self, node: Node) -> tuple[str, str]:
        """Return the name of the light of an element, and the states of its lamps as a list."""
        signal, shown = self._values.text(node, "name"), self._values.text(node, "state")
        words = shown.split(";")
        try:
            if self._signals is None:
                raise Unresolved(
                    "traffic lights are those of the map, which is not here", node.place
                )
            lamps = self._signals.lamps(signal)
        except ScenarioError as error:
            raise Unresolved(str(error), node.place) from None
        if len(words) != len(lamps) or not STATES.keys() >= set(words):
            raise Unresolved(
                f"the {len(lamps)} lamps of traffic light {signal} have no state `{shown}`",
                node.place,
            )
        return self._named(signal), f"[{', '.join(STATES[word] for word in words)}]"

    def _named(self, signal: str) -> str:
        if signal not in self._declared:
            name = self._names.new("", kind="traffic light", base=snake(f"light_{signal}"))
            self._declared[signal] = name
            self.declared.append(Declared(name, "traffic_light", [f'it.map_id == "{signal}"']))
        return self._declared[signal]
