"""The base of generated scenarios: cast, values, placement, behavior."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, overload

from osc2tx_runtime.actors import Actor, Map
from osc2tx_runtime.behaviour.assembly import assemble, invoked_placements
from osc2tx_runtime.behaviour.base import Behaviour
from osc2tx_runtime.behaviour.events import Event, Trigger, argument_key
from osc2tx_runtime.behaviour.invocation import (
    Caller,
    Invocation,
    check_recursion,
    unique_name,
)
from osc2tx_runtime.behaviour.limits import Duration
from osc2tx_runtime.behaviour.override import Mode
from osc2tx_runtime.behaviour.parameters import Range, choose, within
from osc2tx_runtime.behaviour.variables import MISSING, Sampled
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.settings import RunSettings, check_known, near
from osc2tx_runtime.sidecar import read_source_map

if TYPE_CHECKING:
    from osc2tx_runtime.modifiers import Modifier

__all__ = ["Placement", "Range", "Scenario", "within"]

ValueT = TypeVar("ValueT", bool, int, float, str)
AnyT = TypeVar("AnyT")


@dataclass(frozen=True, slots=True)
class Placement:
    """Where and how an actor starts.

    Attributes:
        actor: Who.
        modifiers: position, lane, speed and so on, as written.
        source: Place in the scenario.
    """

    actor: Actor
    modifiers: tuple[Modifier, ...]
    source: str


class Scenario:
    """A scenario. Generated classes write `declare`, `placement` and `behavior`.

    Args:
        settings: Of the run.
        caller: The scenario that invokes this one; `invoke` gives it.
        **arguments: Values of parameters, before those of the settings; for an invoked scenario
            also the actors that take the place of the declared ones.

    Attributes:
        name: Name in the scenario file.
        source: Scenario file.
        one_of: How `OneOf` chooses: `race`, `first` or `seeded`.
        settings: Of the run.
        actors: Declared actors by id, in order; the scenario that runs also has those of all that
            it invokes.
        events: Declared events by name, in order; likewise.
        parameters: Values of the parameters, in order; likewise.
        placements: What `placement` asked for; likewise, once there is a tree.
        label_events: (label, `start` | `end` | `fail`) to the event that somebody waits for.
    """

    name: ClassVar[str] = ""
    source: ClassVar[str] = ""
    one_of: ClassVar[str] = "race"

    def __init__(
        self,
        settings: RunSettings | None = None,
        *,
        caller: Caller | None = None,
        **arguments: Any,
    ) -> None:
        self.settings = settings or RunSettings()
        self._caller = caller
        self._root: Scenario = self if caller is None else caller.scenario._root
        # Labels of the invocations from the scenario that runs down to this one.
        self._path = "" if caller is None else caller.path
        self.actors: dict[str, Actor] = {}
        self.events: dict[str, Event] = {}
        self.parameters: dict[str, Any] = {}
        self.placements: list[Placement] = []
        self.label_events: dict[tuple[str, str], Event] = {}
        self._arguments = arguments
        self._generator = random.Random(self.settings.seed)
        self._source_map = read_source_map(type(self), self.name, self.source)
        self._variables: dict[str, Sampled] = {}
        self._invoked: dict[str, Scenario] = {}
        self._keys: dict[str, None] = {}
        self._inner_events: dict[str, Event] = {}
        self._overrides: list[tuple[str, str, Mode]] = []
        self._declare()
        self._name_members()
        self._check_arguments()
        self.placement()
        self._own_placements = len(self.placements)

    def _declare(self) -> None:
        try:
            self.declare()
        except ArithmeticError as error:  # of a value that the scenario computes
            raise ScenarioError(f"a value cannot be computed: {error}", self.source) from error

    # --- written by generated classes ---

    def declare(self) -> None:
        """Set the cast, events and values as attributes."""

    def placement(self) -> None:
        """Call `place` for the actors that do not start just anywhere."""

    def behavior(self) -> Behaviour:
        """Return the tree."""
        raise NotImplementedError

    # --- used by generated classes ---

    @overload
    def parameter(self, name: str, default: Range, domain: Range | None = None) -> float: ...
    @overload
    def parameter(self, name: str, default: ValueT, domain: Range | None = None) -> ValueT: ...
    def parameter(self, name: str, default: Any, domain: Range | None = None) -> Any:
        """Return the value of a parameter.

        An argument of the class counts before `--set`, that before a draw from a range, that
        before the default. Setting one parameter does not change what is drawn for another.
        Parameters of invoked scenarios are set by path: `--set p1.gap=12`.

        Args:
            name: Name of the parameter.
            default: Value, or range of values, SI units.
            domain: Range that settings must keep to; that of the default where it is a range.
        """
        path = f"{self._path}.{name}" if self._path else name
        generator = self._generator  # draws in the order of declaration
        if self._caller is not None:
            generator = random.Random(f"{self.settings.seed}/{self._caller.key}/{name}")
        given, chosen = self._arguments.get(name), self.settings.set
        value = choose(path, default, domain, generator, given=given, settings=chosen)
        self.parameters[name] = self._root.parameters[path] = value
        return value

    @overload
    def global_parameter(self, name: str, default: Range, domain: Range | None = None) -> float: ...
    @overload
    def global_parameter(
        self, name: str, default: ValueT, domain: Range | None = None
    ) -> ValueT: ...
    def global_parameter(self, name: str, default: Any, domain: Range | None = None) -> Any:
        """Return the value of a global parameter: one for all scenarios of the run."""
        known = self._root.parameters
        if name not in known:
            generator = random.Random(f"{self.settings.seed}/global/{name}")
            known[name] = choose(name, default, domain, generator, settings=self.settings.set)
        return known[name]

    def place(self, actor: Actor, *modifiers: Modifier) -> None:
        """Say where and how an actor starts."""
        lines = self._source_map.placements
        index = len(self.placements)
        source = self._source_map.place(lines[index] if index < len(lines) else None)
        self.placements.append(Placement(actor, modifiers, source))

    def sample(
        self,
        expression: Callable[[], AnyT],
        trigger: Trigger,
        default: Any = MISSING,
        *,
        condition: Callable[[], bool] | None = None,
    ) -> AnyT:
        """Make a variable: `self.v = self.sample(lambda: self.ego.speed, self.near, 0 * mps)`.

        Read later, `self.v` is its latest value: `default`, and from the pass after an occurrence
        on what `expression` gave at that occurrence.

        Args:
            expression: Gives the new value.
            trigger: When: an event, a condition or a boolean function.
            default: Value before the first sample; without it the variable cannot be read before.
            condition: With an event: only an occurrence at which this is true counts.
        """
        variable: Any = Sampled(expression, trigger, default, condition)
        return variable  # type: ignore[no-any-return]

    def invoke(
        self,
        scenario: type[Scenario],
        /,
        *,
        actor: Actor | None = None,
        label: str | None = None,
        duration: Duration | None = None,
        **arguments: Any,
    ) -> Behaviour:
        """Invoke another scenario: `self.invoke(Approach, actor=self.ego, lead=self.car1)`.

        Args:
            scenario: Its class.
            actor: Its `actor`, for a scenario of an actor.
            label: Name for `@label.end`, for settings (`--set label.gap=12`) and in the trace.
            duration: Seconds, or (least, most) seconds, that it takes.
            **arguments: Its parameters (a range is drawn from) and actors.

        Raises:
            ScenarioError: If it invokes itself, or does not take the arguments.
        """
        check_recursion(self, scenario)
        given = arguments if actor is None else {"actor": actor, **arguments}
        short = scenario.name.rpartition(".")[2]  # of `vehicle.approach`
        name = unique_name(label or short, self._invoked)
        path = f"{self._path}.{name}" if self._path else name
        # Without a label the arguments tell invocations apart, not the order of the members.
        key = label or f"{scenario.name}{argument_key(given)}"
        key = unique_name(key if self._caller is None else f"{self._caller.key}/{key}", self._keys)
        self._keys[key] = None
        invoked = scenario(self.settings, caller=Caller(self, path, key, given), **given)
        self._invoked[name] = invoked
        who = f"{actor.id} {short}" if actor is not None else short
        return Invocation(label or who, invoked, invoked.create_tree(), duration)

    def invoked(self, label: str) -> Any:
        """Return an invoked scenario, to read its values: `self.invoked("p1").gap`."""
        if label not in self._invoked:
            hint = near(label, self._invoked)
            raise ScenarioError(f"{label}: no invocation has this label{hint}", self.source)
        return self._invoked[label]

    def override(self, overridden: str, by: str, mode: Mode = "on_start") -> None:
        """Let a behavior end another when it starts; call it in `behavior`.

        Args:
            overridden: Label of the behavior that ends.
            by: Label of the behavior that overrides it.
            mode: `when_active`: it also does not start while the other one runs.
        """
        self._overrides.append((overridden, by, mode))

    def started(self, label: str) -> Event:
        """Return the event at which the node with this label starts."""
        return self._label_event(label, "start")

    def ended(self, label: str) -> Event:
        """Return the event at which the node with this label ends."""
        return self._label_event(label, "end")

    def failed(self, label: str) -> Event:
        """Return the event at which the node with this label fails."""
        return self._label_event(label, "fail")

    def event(self, path: str) -> Event:
        """Return an event of an invoked scenario: `self.event("p1.near")`, `"p1.cut.end"`."""
        found = self._inner_events.setdefault(path, Event())
        found.name = path
        return found

    # --- used by the runtime ---

    def create_tree(self) -> Behaviour:
        """Return the tree, each node with its place in the scenario."""
        self._invoked, self._keys, self._overrides = {}, {}, []
        tree = assemble(self, self.behavior())
        if self._caller is None:
            self.placements[self._own_placements :] = invoked_placements(self, tree)
            self._check_settings()
        return tree

    def map_file(self) -> str | None:
        """Return the map file the scenario names; None if it leaves the map open."""
        maps = [actor for actor in self.actors.values() if isinstance(actor, Map)]
        return next((found.map_file for found in maps if found.map_file), None)

    if not TYPE_CHECKING:  # so that type checkers still know which attributes there are

        def __setattr__(self, name: str, value: Any) -> None:
            if isinstance(value, Sampled):
                value.name = f"{self._path}.{name}" if self._path else name
                self._variables[name] = value
                return
            if isinstance(value, Actor) and self._caller is not None:
                value = self._caller.cast(name, value)
            object.__setattr__(self, name, value)

        def __getattr__(self, name: str) -> Any:
            variables = self.__dict__.get("_variables", {})
            if name in variables:
                return variables[name].read()
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")

    def _label_event(self, label: str, moment: str) -> Event:
        event = self.label_events.setdefault((label, moment), Event())
        event.name = f"{self._path}.{label}.{moment}" if self._path else f"{label}.{moment}"
        return event

    def _name_members(self) -> None:
        lines = self._source_map.fields
        handed_in = {id(actor) for actor in self._arguments.values()}
        handed_in.update(id(actor) for actor in self._root.actors.values())
        for attribute, value in vars(self).items():
            path = f"{self._path}.{attribute}" if self._path else attribute
            if isinstance(value, Actor) and id(value) not in handed_in:
                value.id = path
                value.source = self._source_map.place(lines.get(attribute))
                self.actors[attribute] = self._root.actors[path] = value
            elif isinstance(value, Event):
                value.name = path
                self.events[attribute] = self._root.events[path] = value

    def _check_arguments(self) -> None:
        for name in self._arguments:
            if name not in self.parameters and not isinstance(vars(self).get(name), Actor):
                if self._caller is None:
                    raise TypeError(f"{type(self).__name__}() has no parameter {name!r}")
                hint = near(name, self.parameters)
                raise ScenarioError(
                    f"{self._path}: scenario {self.name} has no parameter {name}{hint}",
                    self._caller.scenario.source,
                )

    def _check_settings(self) -> None:
        """Report settings that name nothing of this scenario."""
        settings = self.settings
        check_known("--set", "parameter", settings.set, self.parameters)
        check_known("--signal", "event", settings.signal, self.events)
        check_known("--spawn", "actor", settings.spawn, self.actors)
        check_known("--destination", "actor", settings.destination, self.actors)
