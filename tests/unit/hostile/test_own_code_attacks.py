"""Attacks by code and files beside a scenario: drivers, worlds, plants, settings, traces, maps.

Each from a seed. Whatever they are, a run ends with a verdict or with one message and an exit code
that says whose fault it is, and nothing that they say steers a terminal.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from random import Random
from types import ModuleType
from typing import Any

import pytest

from osc2tx import cli
from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import Control, Scenario, ScenarioError
from osc2tx_runtime.running.main import main
from osc2tx_runtime.simulators.carla.sensors import read_stack
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.world.plant.plant import Identity
from osc2tx_runtime.worlds import Option, WorldRequest, WorldType
from tests.end_to_end.harness import REPOSITORY
from tests.fuzz.inputs import INPUTS
from tests.processes import forked
from tests.unit.building.projects import drive, write
from tests.unit.hostile.attacks import POOL
from tests.unit.hostile.shapes import assert_calm

pytestmark = pytest.mark.slow
HOSTILE = "\x1b[2J::error::\u202ex\n::error::y"
EXITS = {0, 1, 2, 4, 5}


class Lying(float):
    """A number that is none when somebody looks."""

    def __abs__(self) -> Any:
        raise SystemExit(0)

    def __repr__(self) -> str:
        raise RuntimeError(HOSTILE)

    __str__ = __repr__


class Endless:
    """Has every attribute and any length, and says nothing of use."""

    __hash__ = None  # type: ignore[assignment]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return Endless()

    def __call__(self, *_: object, **__: object) -> Any:
        return Endless()

    def __iter__(self) -> Iterator[Any]:
        raise KeyError(HOSTILE)

    def __repr__(self) -> str:
        raise ZeroDivisionError(HOSTILE)


VALUES: tuple[Any, ...] = (
    *(None, True, 0, -1, 3.5, math.nan, math.inf, -math.inf, 1e308, 10**400, Lying(1.0)),
    *("", HOSTILE, "x" * 5000, "\ud800", b"\xff", [], [None], {}, {HOSTILE: math.nan}, {1: 2}),
    *(object(), Endless(), Endless, len, int, RuntimeError(HOSTILE), frozenset({HOSTILE}), ...),
    *((1, 2, 3), [[]], {"a": None, "ego": 5, "npc": HOSTILE}, {"ego": Endless()}, range(3)),
)
RAISED: tuple[Callable[[], BaseException], ...] = (
    *(lambda: SystemExit(0), lambda: SystemExit(HOSTILE), lambda: RuntimeError(HOSTILE)),
    *(lambda: GeneratorExit(), lambda: StopIteration(HOSTILE), lambda: RecursionError()),
    *(lambda: MemoryError(), lambda: OSError(5, HOSTILE), lambda: AssertionError(Endless())),
    *(lambda: BaseException(HOSTILE), lambda: UnicodeError("\ud800"), lambda: Lies()),
)


class Lies(Exception):
    """Cannot say what it is."""

    def __str__(self) -> str:
        raise SystemExit(0)

    __repr__ = __str__


def misbehaves(random: Random) -> Callable[..., Any]:
    """Return a function that answers garbage or raises something."""
    if random.random() < 0.4:
        error = random.choice(RAISED)

        def raise_it(*_: object, **__: object) -> Any:
            raise error()

        return raise_it
    value = random.choice(VALUES)
    return lambda *_, **__: value


@pytest.fixture(scope="module")
def cut_in() -> Iterator[type[Scenario]]:
    with scenarios_of_file(REPOSITORY / "generated/cut_in.py", "attacked") as scenarios:
        yield scenarios["cut_in"]


def ends_well(made: type[Scenario], *arguments: str, before: Callable[[], object] = bool) -> str:
    """Run a module in a process of its own; return what it complained."""

    def run() -> None:
        before()
        code = main(made, argv=["--max-time", "0.3", *arguments])
        sys.stdout.flush()
        os._exit(code)

    ended = forked(run)
    assert ended.code in EXITS, (ended.code, ended.err)
    assert "Traceback" not in ended.err
    assert_calm(ended.out)
    assert_calm(ended.err)
    return ended.err


# --- drivers ---


def hostile_driver(random: Random) -> ModuleType:
    module = ModuleType("drivers")
    place = random.choice(("step", "init", "field", "property", "name", "late"))
    bad = misbehaves(random)
    members: dict[str, Any] = {"step": lambda self, seen, dt: Control()}
    if place == "step":
        members["step"] = bad
    elif place == "init":
        members["__init__"] = bad
    elif place == "field":
        field = random.choice(("acceleration", "steering"))
        value = random.choice(VALUES)
        members["step"] = lambda self, seen, dt: replace(Control(), **{field: value})
    elif place == "property":
        members["step"] = property(bad)
    elif place == "late":
        members["step"] = lambda self, seen, dt: Control() if seen.time < 0.1 else bad()
    else:
        members["__module__"] = random.choice(VALUES)
    module.__dict__["Made"] = type("Made", (), members)
    return module


@pytest.mark.parametrize("seed", range(90))
def test_drivers(cut_in: type[Scenario], seed: int) -> None:
    module = hostile_driver(Random(f"driver {seed}"))
    before = lambda: sys.modules.update(drivers=module)  # noqa: E731
    ends_well(cut_in, "--ego", "ego=drivers:Made", "--expect", before=before)


@pytest.mark.parametrize("text", [text for text in POOL if "\0" not in text][::4], ids=ascii)
def test_names_of_drivers(cut_in: type[Scenario], text: str) -> None:
    for form in ("{0}", "{0}=a:B", "ego={0}", "ego={0}:B", "ego=os:{0}", "ego={0}.x:Y"):
        ends_well(cut_in, "--ego", form.format(text))


# --- worlds and plants ---

PLANT = ("name", "control", "capabilities", "shape", "begin", "moved", "close")
WORLD = (
    *("name", "dt", "map", "step", "time", "actors", "state", "motion", "control", "capabilities"),
    *("spawn", "begin", "advance", "progress", "command", "collisions", "environment", "lights"),
    *("set_lights", "close", "warnings", "overloads", "take_notes", "trailer_of", "deviation"),
)


class Other:
    """A world or a plant with some other member."""

    def __init__(self, real: object, name: str, value: object) -> None:
        self._real, self._name, self._value = real, name, value

    def __getattr__(self, name: str) -> Any:
        return self._value if name == self._name else getattr(self._real, name)


def hostile_world(random: Random) -> object:
    place = random.choice(("plant", "world", "make", "type", "option"))
    bad = misbehaves(random)
    value = random.choice((bad, bad, random.choice(VALUES)))

    def make(request: WorldRequest) -> Any:
        if place == "plant":
            plant: Any = Other(Identity(), random.choice(PLANT), value)
            return EmbeddedWorld(request.road_map(), request.dt, plant)
        real = EmbeddedWorld(request.road_map(), request.dt)
        return Other(real, random.choice(WORLD), value) if place == "world" else real

    if place == "make":
        return WorldType("hostile", random.choice((bad, value)))
    fields: dict[str, Any] = {"name": "hostile", "make": make}
    if place == "type":
        fields[random.choice(("name", "make", "controls", "options"))] = random.choice(VALUES)
        return random.choice((WorldType(**fields), random.choice(VALUES)))
    if place == "option":
        given: dict[str, Any] = {"name": "x", "metavar": "X", "help": "x", "parse": bad}
        if random.random() < 0.7:
            key = random.choice(("name", "metavar", "help", "parse", "gather", "default"))
            given[key] = random.choice((*VALUES, "seed", "help", "a b", "--x", "scenario"))
        fields["options"] = (Option(**given),)
    return WorldType(**fields)


class Entry:
    """An entry point of a package."""

    name = "hostile"
    value = "package:WORLD"

    def __init__(self, random: Random) -> None:
        self.random = random

    def load(self) -> object:
        """Return the world, or do something else."""
        return misbehaves(self.random)() if self.random.random() < 0.1 else self.world

    @property
    def world(self) -> object:
        """A world."""
        return hostile_world(self.random)


@pytest.mark.parametrize("seed", range(150))
def test_worlds(cut_in: type[Scenario], seed: int) -> None:
    entry = Entry(Random(f"world {seed}"))
    world: list[object] = []

    def load() -> object:
        if not world:
            world.append(Entry.load(entry))
        return world[0]

    entry.load = load  # type: ignore[method-assign]

    def before() -> None:
        import importlib.metadata

        importlib.metadata.entry_points = lambda **_: (entry,)  # type: ignore[assignment]

    ends_well(cut_in, "--world", "hostile", "--x", "1", before=before)
    ends_well(cut_in, "--world", "hostile", before=before)


# --- files: settings, source maps, traces, maps, sensors ---


def said(folder: Path, *arguments: str) -> None:
    def run() -> None:
        cli.main(list(arguments))

    ended = forked(run, folder=folder)
    assert ended.code in {*EXITS, 3}, ended.err
    assert "Traceback" not in ended.err
    assert_calm(ended.out)
    assert_calm(ended.err)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    drive(tmp_path / "a.osc")
    return tmp_path


@pytest.mark.parametrize("seed", range(60))
def test_settings(project: Path, seed: int) -> None:
    text = INPUTS["settings"].write(Random(f"settings {seed}"))
    write(project / "osc2tx.toml", text)
    said(project, "run", "a.osc", "--max-time", "0.2")
    said(project, "config", "a.osc")


@pytest.mark.parametrize("seed", range(60))
def test_options(project: Path, seed: int) -> None:
    lines = INPUTS["options"].write(Random(f"options {seed}")).replace("\0", "").split("\n")
    given = [part for line in lines for part in ("--" + line).split(" ", 1)]
    said(project, "run", "a.osc", *given, "--max-time", "0.2")


@pytest.mark.parametrize("seed", range(60))
def test_sets(project: Path, cut_in: type[Scenario], seed: int) -> None:
    random = Random(f"set {seed}")
    names = ("v_ego", "v_other", "gap", "x", "", "v_ego.x", "..", "*", "ego.v", *POOL[:40])
    values = ("1", "-1", "1e308", "-0", "nan", "1_0", "1mps", "=", "a=b", "[1]", *POOL)
    for _ in range(3):
        text = f"{random.choice(names)}={random.choice(values)}".replace("\0", "")
        ends_well(cut_in, "--set", text)


@pytest.mark.parametrize("seed", range(60))
def test_source_maps_and_traces(tmp_path: Path, seed: int) -> None:
    random = Random(f"map and trace {seed}")
    module = tmp_path / "cut_in.py"
    shutil.copy(REPOSITORY / "generated/cut_in.py", module)
    entry = INPUTS["source_maps"].write(random)
    text = random.choice((f'{{"version":2,"scenarios":{{"cut_in":{entry}}}}}', entry))
    (tmp_path / "cut_in.map.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    said(tmp_path, "run", "cut_in.py", "--max-time", "0.2", "--trace", "t.jsonl")
    trace = INPUTS["traces"].write(random)
    (tmp_path / "own.jsonl").write_bytes(trace.encode("utf-8", "surrogateescape"))
    said(tmp_path, "report", "own.jsonl")
    said(tmp_path, "report", "own.jsonl", "t.jsonl", "-o", "both.html")
    said(tmp_path, "report", ".")


@pytest.mark.parametrize("seed", range(60))
def test_maps(tmp_path: Path, seed: int) -> None:
    path = drive(tmp_path / "a.osc")
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("highway.xodr", "m.xodr"), encoding="utf-8")
    made = INPUTS["maps"].write(Random(f"map file {seed}"))
    (tmp_path / "m.xodr").write_bytes(made.encode("utf-8", "surrogateescape"))
    said(tmp_path, "run", "a.osc", "--map-path", ".", "--max-time", "0.2", "--report", "r.html")
    said(tmp_path, "map", "m.xodr")


STACK = {"id": "a", "type": "sensor.camera.rgb", "spawn_point": {"x": 1.0}, "attributes": {"a": 1}}
JSON = [value for value in VALUES if isinstance(value, str | float | list | bool | None)][:20]


@pytest.mark.parametrize("seed", range(60))
def test_sensors(tmp_path: Path, seed: int) -> None:
    random = Random(f"sensors {seed}")
    sensor: dict[str, Any] = json.loads(json.dumps(STACK))
    target: Any = sensor if random.random() < 0.6 else sensor["spawn_point"]
    values = [v for v in JSON if not isinstance(v, Lying)]
    target[random.choice(("id", "type", "spawn_point", "attributes", "x", "yaw"))] = random.choice(
        [*values, 10**400, {"a": {}}, {"x": math.nan}]
    )
    path = tmp_path / "stack.json"
    path.write_text(random.choice(("{}", "[{}]", "{{}}"))[:9].replace("{}", json.dumps(sensor)))
    try:
        found = read_stack(path)
    except ScenarioError as error:
        assert error.exit_code == 4
    else:
        assert all(math.isfinite(x) for sensor in found for x in sensor.place)


def test_there_are_hundreds() -> None:
    assert 90 + 150 + 60 * 6 > 300
