"""The base class of generated scenarios: a scenario of the language with a map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx_runtime.domain.actors import Actor, Map
from osc2tx_runtime.domain.map.objects import MapObject
from osc2tx_runtime.domain.modifiers import MapModifier, Modifier, SetMapFile
from osc2tx_runtime.domain.placing.entries import acting_at_once, with_entries
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.scenario import BaseScenario
from osc2tx_runtime.language.tree.base import Behaviour


class Scenario(BaseScenario):
    """A scenario. Generated classes write `declare`, `placement` and `behavior`.

    Attributes:
        implied_starts: Implied starts of actors that enter, by actor id.
    """

    implied_starts: Mapping[str, Sequence[Modifier]]

    def require(self, road_map: Map, *modifiers: MapModifier) -> None:
        """State the constraints on the declared roads and lanes of the map."""
        self.place(road_map, *modifiers)

    def completed(self, tree: Behaviour) -> Behaviour:
        """Return the whole tree of a run, with the actors that enter."""
        race = self.one_of == "race"
        acting = acting_at_once(tree, race)
        late = [each for each in self.placements if each.implied and each.actor.id not in acting]
        self.implied_starts = {each.actor.id: each.modifiers for each in reversed(late)}
        self.placements = [each for each in self.placements if each not in late]
        placed = {each.actor.id for each in self.placements}
        return with_entries(tree, acting | placed, self.implied_starts, race)

    def map_file(self) -> str | None:
        """Return the map file that the scenario states; None if it leaves the map open.

        Raises:
            ScenarioError: It states two.
        """
        maps = [actor for actor in self.actors.values() if isinstance(actor, Map)]
        named = [(found.named_file, found.source) for found in maps if found.named_file]
        named += [
            (modifier.file, placement.source)
            for placement in self.placements
            for modifier in placement.modifiers
            if isinstance(modifier, SetMapFile)
        ]
        for file, source in named[1:]:
            if file != named[0][0]:
                raise ScenarioError(f"two maps are named: {named[0][0]} and {file}", source)
        return named[0][0] if named else None


def bind_all(scenario: Scenario, context: ExecutionContext) -> None:
    """Bind the actors of a scenario and its declared parts of the map to a run."""
    for actor in scenario.actors.values():
        if isinstance(actor, Actor):
            actor.bind(context)
    for each in scenario.map_objects:
        if isinstance(each, MapObject):
            each.bind(context)
