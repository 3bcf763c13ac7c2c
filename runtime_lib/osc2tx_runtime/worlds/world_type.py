"""The description of a world: its name, its options, and its creation."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import Any, Literal

from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_runtime.opendrive import MapError, RoadMap, read_map
from osc2tx_runtime.world.protocol import ActorSpec, ControlMode, World
from osc2tx_shared.classes import dataclass
from osc2tx_shared.steps import DEFAULT_STEP

SECONDS = {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 0.001, "min": 60.0}
NUMBER_AND_UNIT = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([A-Za-z]*)", re.ASCII)


@dataclass(frozen=True, slots=True)
class Option:
    """One option of `python scenario.py` and `osc2tx run`.

    Attributes:
        name: Its name after `--`.
        metavar: Form of its value; empty for a flag.
        help: One line.
        parse: Reads one text.
        gather: Combines the values of a repeatable option: `tuple`, `dict` of (key, value) pairs;
            None: the last value counts.
        default: Default for the help page; None: not shown.
        is_trusted: Whether only the command line may give it: it names Python code, or a file to
            write. Settings files come with third-party repositories.
    """

    name: str
    metavar: str
    help: str
    parse: Callable[[str], Any]
    gather: Callable[[Iterable[Any]], Any] | None = None
    default: object = None
    is_trusted: bool = False

    @property
    def field(self) -> str:
        """Name of the field of `RunSettings`, or of the options of its world."""
        return self.name.replace("-", "_")

    @property
    def repeatable(self) -> bool:
        """Whether it may be given several times."""
        return self.gather is not None

    @property
    def is_flag(self) -> bool:
        """Whether it has no value."""
        return not self.metavar

    @classmethod
    def flag(cls, name: str, help: str) -> Option:
        """An option without a value: `true` or `false` in a settings file."""
        return cls(name, "", help, lambda text: _parse_flag(name, text))

    def read(self, texts: Sequence[str]) -> Any:
        """Return the field's value for the given texts."""
        values = [self.parse(text) for text in texts]
        return values[-1] if self.gather is None else self.gather(values)


def _parse_flag(name: str, text: str) -> bool:
    if text not in ("true", "false"):
        raise SettingsError(f"--{name} is given or not; in a settings file it is true or false")
    return text == "true"


def parse_seconds(text: str, example: str) -> float:
    """Read `1`, `1.5s` or `500ms` as seconds."""
    found = NUMBER_AND_UNIT.fullmatch(text.strip())
    if found is None or found[2] not in SECONDS:
        raise SettingsError(f"`{text}` is not a time: write seconds, as in {example}")
    return float(found[1]) * SECONDS[found[2]]


def parse_pair(text: str, option: str, form: str, example: str) -> tuple[str, str]:
    """Read `KEY=VALUE`.

    Args:
        text: The given text.
        option: As `--spawn`.
        form: The required form: `ACTOR=ROAD,LANE,S`.
        example: An example of the form.
    """
    key, equals, value = (part.strip() for part in text.partition("="))
    if not (equals and key and value):
        raise SettingsError(f"{option} {text}: write {form}, as in {option} {example}")
    return key, value


@dataclass(frozen=True, slots=True)
class WorldRequest:
    """The request of a run to its world.

    Attributes:
        map_file: The map as stated in the scenario; None if it leaves the map open.
        find_map: Returns the path of that map on this machine; InputError if it does not exist.
        dt: Length of a step (s).
        seed: Seed of all random values.
        control: Control mode of an actor, by its id; `""` stands for all others.
        options: Given values of the options of the world, by `Option.field`.
        read: Reads the map; callers with many runs can cache it.
    """

    map_file: str | None
    find_map: Callable[[], Path]
    dt: float = DEFAULT_STEP
    seed: int = 0
    control: Mapping[str, ControlMode] = field(default_factory=dict)
    options: Mapping[str, Any] = field(default_factory=dict)
    read: Callable[[Path], RoadMap] = read_map

    def road_map(self) -> RoadMap:
        """Read the map of the scenario.

        Raises:
            InputError: It does not exist, or is not a usable map.
        """
        path = self.find_map()
        try:
            return self.read(path)
        except (MapError, OSError) as error:
            raise InputError(f"the map cannot be read: {error}") from error


CheckStatus = Literal["ok", "differs", "unknown"]
"""`unknown`: not tried, or cannot be determined."""


@dataclass(frozen=True, slots=True)
class CheckRequest:
    """The task of a check.

    Attributes:
        world: The request of a run to the world.
        actors: The actors of the scenario; empty without a scenario.
        drives: Whether actors may be spawned and moved, which takes over the simulator.
        fixes: Whether remnants of other clients are removed.
    """

    world: WorldRequest
    actors: tuple[ActorSpec, ...] = ()
    drives: bool = False
    fixes: bool = False


@dataclass(frozen=True, slots=True)
class CheckResult:
    """One line of a check.

    Attributes:
        number: Number of the line.
        name: The compared property.
        status: The result.
        found: The finding, in one line.
        meaning: Its effect on runs; empty without one.
        blocks: Whether it prevents runs.
    """

    number: int
    name: str
    status: CheckStatus
    found: str
    meaning: str = ""
    blocks: bool = False


@dataclass(frozen=True, slots=True)
class WorldType:
    """A world that runs can choose.

    Attributes:
        name: Its name in `--world NAME`.
        make: Creates it for a run. Exceptions other than ScenarioError are its internal errors.
        controls: Control modes of its actors; the first one is the default.
        options: Its own options, besides those of all runs.
        check: Checks its simulator against the requirements of runs, line by line; None without
            one.
    """

    name: str
    make: Callable[[WorldRequest], World]
    controls: tuple[ControlMode, ...] = ("exact",)
    options: tuple[Option, ...] = ()
    check: Callable[[CheckRequest], Iterable[CheckResult]] | None = None
