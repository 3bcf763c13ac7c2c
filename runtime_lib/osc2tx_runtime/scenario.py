"""The base of generated scenarios: cast, values, placement, behavior."""

from __future__ import annotations

import difflib
import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, overload

from osc2tx_runtime.actors import Actor, Map
from osc2tx_runtime.behaviour.base import Behaviour, Node
from osc2tx_runtime.behaviour.events import Event
from osc2tx_runtime.errors import ScenarioError, SettingsError
from osc2tx_runtime.settings import RunSettings
from osc2tx_runtime.sidecar import apply_nodes, every_node, read_source_map

if TYPE_CHECKING:
    from osc2tx_runtime.modifiers import Modifier

__all__ = ["Placement", "Range", "Scenario", "within"]

ValueT = TypeVar("ValueT", bool, int, float, str)


@dataclass(frozen=True, slots=True)
class Range:
    """Values from `low` to `high`, SI units; one is drawn from the seed of the run."""

    low: float
    high: float

    def __post_init__(self) -> None:
        if not self.low <= self.high:
            raise ValueError(f"within({self.low}, {self.high}): from the lower to the upper bound")


def within(low: float, high: float) -> Range:
    """Return the range of a sampled parameter."""
    return Range(low, high)


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
        **arguments: Values of parameters, before those of the settings.

    Attributes:
        name: Name in the scenario file.
        source: Scenario file.
        one_of: How `OneOf` chooses: `race`, `first` or `seeded`.
        settings: Of the run.
        actors: Declared actors by id, in order.
        events: Declared events by name, in order.
        parameters: Values of the parameters, in order.
        placements: What `placement` asked for.
        label_events: (label, `start` | `end` | `fail`) to the event that somebody waits for.
    """

    name: ClassVar[str] = ""
    source: ClassVar[str] = ""
    one_of: ClassVar[str] = "race"

    def __init__(self, settings: RunSettings | None = None, **arguments: float | str) -> None:
        self.settings = settings or RunSettings()
        self.actors: dict[str, Actor] = {}
        self.events: dict[str, Event] = {}
        self.parameters: dict[str, float | str] = {}
        self.placements: list[Placement] = []
        self.label_events: dict[tuple[str, str], Event] = {}
        self._arguments = arguments
        self._generator = random.Random(self.settings.seed)
        self._source_map = read_source_map(type(self), self.name, self.source)
        self.declare()
        self._name_members()
        self._check_names()
        self.placement()

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
        before the default. Ranges draw in the order of declaration, whether the value is used or
        not, so that setting one parameter does not change another.

        Args:
            name: Name of the parameter.
            default: Value, or range of values, SI units.
            domain: Range that settings must keep to; that of the default where it is a range.
        """
        drawn = default
        if isinstance(default, Range):
            drawn = self._generator.uniform(default.low, default.high)
            domain = domain or default
        if name in self._arguments:
            value: Any = self._arguments[name]
        elif name in self.settings.set:
            value = fit(name, self.settings.set[name], drawn)
            if domain is not None and not domain.low <= value <= domain.high:
                raise SettingsError(
                    f"--set {name}={value:g}: the scenario allows {domain.low:g} to"
                    f" {domain.high:g} (SI units)"
                )
        else:
            value = drawn
        self.parameters[name] = value
        return value

    def place(self, actor: Actor, *modifiers: Modifier) -> None:
        """Say where and how an actor starts."""
        lines = self._source_map.placements
        index = len(self.placements)
        source = self._source_map.place(lines[index] if index < len(lines) else None)
        self.placements.append(Placement(actor, modifiers, source))

    def started(self, label: str) -> Event:
        """Return the event at which the node with this label starts."""
        return self._label_event(label, "start")

    def ended(self, label: str) -> Event:
        """Return the event at which the node with this label ends."""
        return self._label_event(label, "end")

    def failed(self, label: str) -> Event:
        """Return the event at which the node with this label fails."""
        return self._label_event(label, "fail")

    # --- used by the runtime ---

    def create_tree(self) -> Behaviour:
        """Return the tree, each node with its place in the scenario."""
        root = self.behavior()
        apply_nodes(root, self._source_map)
        self._check_labels(root)
        return root

    def map_file(self) -> str | None:
        """Return the map file the scenario names; None if it leaves the map open."""
        maps = [actor for actor in self.actors.values() if isinstance(actor, Map)]
        return next((found.map_file for found in maps if found.map_file), None)

    def _label_event(self, label: str, moment: str) -> Event:
        event = self.label_events.setdefault((label, moment), Event())
        event.name = f"{label}.{moment}"
        return event

    def _name_members(self) -> None:
        lines = self._source_map.fields
        for attribute, value in vars(self).items():
            if isinstance(value, Actor):
                value.id = attribute
                value.source = self._source_map.place(lines.get(attribute))
                self.actors[attribute] = value
            elif isinstance(value, Event):
                value.name = attribute
                self.events[attribute] = value

    def _check_names(self) -> None:
        """Report settings that name nothing of this scenario."""
        settings = self.settings
        check_known("--set", "parameter", settings.set, self.parameters)
        check_known("--signal", "event", settings.signal, self.events)
        check_known("--spawn", "actor", settings.spawn, self.actors)
        check_known("--destination", "actor", settings.destination, self.actors)
        for name in self._arguments:
            if name not in self.parameters:
                raise TypeError(f"{type(self).__name__}() has no parameter {name!r}")

    def _check_labels(self, root: Behaviour) -> None:
        known = {node.label for node in every_node(root) if isinstance(node, Node) and node.label}
        for label, moment in self.label_events:
            if label not in known:
                hint = near(label, known)
                raise ScenarioError(f"@{label}.{moment}: no node has this label{hint}", self.source)


def fit(name: str, value: float | str, like: Any) -> Any:
    """Return a value of the settings in the type of the parameter it is for."""
    text = str(value)
    if isinstance(like, bool):
        if text in ("true", "false"):
            return text == "true"
        raise SettingsError(f"--set {name}={text}: write true or false")
    if isinstance(like, str):
        return f"{value:g}" if isinstance(value, float) else value
    if isinstance(value, str):
        raise SettingsError(f"--set {name}={text}: write a number in SI units")
    if isinstance(like, int):
        if value != int(value):
            raise SettingsError(f"--set {name}={text}: write a whole number")
        return int(value)
    return value


def check_known(option: str, what: str, given: Any, known: Any) -> None:
    """Raise SettingsError for a name of the settings that the scenario does not have."""
    for name in given:
        if name not in known:
            has = f"it has {', '.join(known)}" if known else "it has none"
            hint = near(name, known) or f" ({has})"
            raise SettingsError(f"{option} {name}: the scenario has no such {what}{hint}")


def near(name: str, known: Any) -> str:
    """Return a question that offers similar names, or nothing."""
    found = difflib.get_close_matches(name, sorted(known), n=3)
    return f"; did you mean {' or '.join(found)}?" if found else ""
