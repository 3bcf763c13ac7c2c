"""State of a scenario: cast, events, placements, invocations, caller."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, TypeVar

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.placement import Placement
from osc2tx_runtime.language.declared import BaseActor, DeclaredObject
from osc2tx_runtime.language.settings import RunSettings, near
from osc2tx_runtime.language.source_map import read_source_map
from osc2tx_runtime.language.tree.events import Event
from osc2tx_runtime.language.tree.override import Mode
from osc2tx_runtime.language.tree.variables import Sampled
from osc2tx_runtime.language.values.scenario_values import ScenarioValues
from osc2tx_shared.classes import dataclass

ActorT = TypeVar("ActorT", bound=BaseActor)


class ScenarioParts(ScenarioValues):
    """The declarations of a scenario, from which its tree is assembled.

    Args:
        settings: Of the run.
        caller: The scenario that invokes this one.
        arguments: Values of parameters, and actors that replace the declared ones.

    Attributes:
        name: Name in the scenario file.
        source: Scenario file.
        one_of: How `OneOf` chooses: `race`, `first` or `seeded`.
        first_come: Durations and `until` end with whichever comes first, as in dialect `carla`.
        is_main: Whether it is the default scenario of its module.
        settings: Of the run.
        actors: Declared actors by id, in order; the scenario that runs also has those of all that
            it invokes.
        map_objects: Declared traffic lights and groups of them; likewise.
        events: Declared events by name, in order; likewise.
        parameters: Values of the parameters, in order; likewise.
        placements: The requests of `placement`; likewise, once there is a tree.
        label_events: (label, `start` | `end` | `fail`) to the awaited event.
    """

    name: ClassVar[str] = ""
    source: ClassVar[str] = ""
    one_of: ClassVar[str] = "race"
    first_come: ClassVar[bool] = False
    is_main: ClassVar[bool] = False

    def __init__(
        self,
        settings: RunSettings,
        caller: Caller | None,
        arguments: Mapping[str, Any],
    ) -> None:
        super().__init__(
            settings,
            arguments,
            read_source_map(type(self), self.name, self.source),
            caller=None if caller is None else caller.scenario,
            path="" if caller is None else caller.path,
            key="" if caller is None else caller.key,
            times={} if caller is None else caller.times,
        )
        self._caller = caller
        self._root: ScenarioParts = self if caller is None else caller.scenario._root
        self.actors: dict[str, BaseActor] = {}
        self.map_objects: list[DeclaredObject] = []
        self.events: dict[str, Event] = {}
        self.placements: list[Placement] = []
        self.label_events: dict[tuple[str, str], Event] = {}
        self._variables: dict[str, Sampled] = {}
        self._invoked: dict[str, ScenarioParts] = {}
        self._keys: dict[str, None] = {}
        self._inner_events: dict[str, Event] = {}
        self._overrides: list[tuple[str, str, Mode]] = []
        self._recursions = 0

    @property
    def short_name(self) -> str:
        """The name without that of the actor: `approach` of `vehicle.approach`."""
        return self.name.rpartition(".")[2]

    def invoked(self, label: str) -> Any:
        """Return an invoked scenario, to read its values: `self.invoked("p1").gap`."""
        if label not in self._invoked:
            hint = near(label, self._invoked)
            raise ScenarioError(f"{label}: no invocation has this label{hint}", self.source)
        return self._invoked[label]

    def _only(self, declared: ActorT) -> ActorT:
        """Return the unique actor of a type, if a caller has it already."""
        actors = self._root.actors.values() if self._caller is not None else ()
        return next((actor for actor in actors if type(actor) is type(declared)), declared)

    def _label_event(self, label: str, moment: str) -> Event:
        event = self.label_events.setdefault((label, moment), Event())
        event.name = f"{self._path}.{label}.{moment}" if self._path else f"{label}.{moment}"
        return event


@dataclass(frozen=True, slots=True)
class Caller:
    """The invocation of a scenario.

    Attributes:
        scenario: The scenario that invokes.
        path: Path of the invocation: the labels from the main scenario to it.
        key: Key of its draws from the seed.
        arguments: As given.
        times: Seconds that the invoked scenario would draw, and what it invokes, by path.
    """

    scenario: ScenarioParts
    path: str
    key: str
    arguments: Mapping[str, Any]
    times: Mapping[str, float]

    def cast(self, name: str, declared: ActorT) -> ActorT | None:
        """Return the actor passed for a declared one; `None` without one.

        Raises:
            ScenarioError: An actor of another kind was passed.
        """
        given = self.arguments.get(name)
        if given is None:
            return None
        if not isinstance(given, type(declared)):
            what = given.kinds[0] if isinstance(given, BaseActor) else repr(given)
            raise ScenarioError(
                f"{self.path}: {name} must be a {declared.kinds[0]}, not {what}",
                self.scenario.source,
            )
        return given
