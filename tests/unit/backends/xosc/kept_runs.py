"""Runs that documents share: tests grade a scenario in ten versions and profiles, in several files.

A run of the same module with the same settings is the same run, and so is a document that differs
in its header alone. Runs, and what they show, are kept under a digest of all that they depend on.
They are in a folder of the session that all its workers share.
"""

import hashlib
import os
import pickle
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar
from unittest.mock import patch
from weakref import WeakKeyDictionary

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx.backends.xosc import XmlScenario
from osc2tx.grading import grading, measuring
from osc2tx.grading.comparison import Recording
from osc2tx.grading.measuring import Finding, Measuring
from osc2tx.grading.runs import (
    NoEvidence,
    WorldRun,
    cached_map,
    reading_of,
    run_in_player,
    run_in_world,
)
from osc2tx.losses.entries import Grade
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import XmlOptions
from osc2tx.xosc.element import Element
from osc2tx.xosc.elements import FileHeader
from osc2tx.xosc.profiles import PROFILES
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.opendrive import RoadMap

FOLDER = "OSC2TX_TESTS_RUNS"
"""The variable that names the folder of the session; without it, runs are kept in memory alone."""
KEPT = 32
"""Runs that are kept in memory: those of one source."""

VERSION = re.compile(r' revMinor="\d+"')
"""In the head of a document: neither the player nor a comparison asks for it."""

R = TypeVar("R")

_texts: WeakKeyDictionary[type[Scenario], tuple[str, str]] = WeakKeyDictionary()
"""The module of each scenario, and where its nodes are in the source."""
_maps: WeakKeyDictionary[RoadMap, str] = WeakKeyDictionary()
"""The digest of each map."""


@contextmanager
def kept_runs() -> Iterator[None]:
    """Let the grading carry out each run once."""
    with (
        patch.object(grading, "scenarios_of_module", _scenarios_of_module),
        patch.object(grading, "Measuring", _Measuring),
        patch.object(measuring, "cached_map", _cached_map),
        patch.object(measuring, "run_in_world", _run_in_world),
        patch.object(measuring, "run_in_player", _run_in_player),
    ):
        yield


@contextmanager
def _scenarios_of_module(module: GeneratedModule) -> Iterator[Mapping[str, type[Scenario]]]:
    with scenarios_of_module(module) as scenarios:
        _texts.update(dict.fromkeys(scenarios.values(), (module.python, module.source_map)))
        yield scenarios


def _cached_map(path: Path) -> RoadMap:
    found = cached_map(path)
    if found not in _maps:
        _maps[found] = _digest_of(path)
    return found


def _digest_of(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


class _Call:
    """A call that may be remembered: calls are equal if their names are."""

    def __init__(self, key: object, carry_out: Callable[[], Any]) -> None:
        self.name = hashlib.sha256(repr(key).encode()).hexdigest()
        self.carry_out = carry_out

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Call) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)


@lru_cache(maxsize=KEPT)
def _result(call: _Call) -> Any:
    folder = os.environ.get(FOLDER)
    place = None if folder is None else Path(folder, call.name[:2], call.name)
    if place is not None and place.is_file():
        return pickle.loads(place.read_bytes())
    try:
        result = call.carry_out()
    except NoEvidence as error:
        return error  # in memory alone: such runs are short
    finally:
        call.carry_out = bool  # what it refers to is not kept
    if place is not None:
        _write(place, pickle.dumps(result, pickle.HIGHEST_PROTOCOL))
    return result


def _write(place: Path, content: bytes) -> None:
    """Write a file that is whole as soon as it is there: other workers may look for it."""
    place.parent.mkdir(parents=True, exist_ok=True)
    part = place.with_suffix(f".{os.getpid()}")
    part.write_bytes(content)
    part.replace(place)


def _once(key: object, carry_out: Callable[[], R]) -> R:
    result = _result(_Call(key, carry_out))
    if isinstance(result, NoEvidence):
        raise result
    found: R = result
    return found


def without_version(xml: str) -> str:
    """Return a document without the version in its head."""
    return VERSION.sub("", xml, count=1)


class _Measuring:
    """The measurement of a document, done once for those that differ in their version alone."""

    def __init__(
        self, found: XmlScenario, scenario: type[Scenario], options: XmlOptions, folder: Path
    ) -> None:
        self._found, self._scenario = found, scenario
        self._options, self._folder = options, folder

    def run(self) -> Finding:
        found, scenario, options = self._found, self._scenario, self._options
        entries = (each for each in found.report.entries if each.grade is Grade.APPROXIMATED)
        key = (
            *("finding", _texts[scenario], scenario.name, found.choices),
            *(without_version(text or "") for text in (found.xml, found.parameters)),
            sorted((event, str(span)) for event, span in found.origins.items()),
            [(each.is_open, type(each.bound).__name__, str(each.bound)) for each in entries],
            *(options.signals, options.spawns, reading_of(PROFILES[options.profile])),
            list(map(_digest_of, _maps_in((self._folder, *map(Path, options.map_path))))),
        )
        return _once(key, Measuring(found, scenario, options, self._folder).run)


def _run_in_world(scenario: type[Scenario], settings: RunSettings) -> WorldRun:
    maps = [_digest_of(each) for each in _maps_in(settings.map_path)]
    key = "world", _texts[scenario], scenario.name, repr(settings), maps
    return _once(key, lambda: run_in_world(scenario, settings))


def _maps_in(folders: tuple[Path, ...]) -> list[Path]:
    return [each for folder in folders for each in sorted(folder.glob("*.xodr"))]


def _run_in_player(document: Element, road_map: Any, dt: float, **others: Any) -> Recording:
    given = sorted(others["given"].items())
    said = _said(_Root(document))
    key = "player", said, _maps[road_map], dt, others["reading"], given, others["most"]
    return _once(key, lambda: run_in_player(document, road_map, dt, **others))


class _Root:
    """A document, equal to itself alone."""

    def __init__(self, document: Element) -> None:
        self.document = document

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Root) and self.document is other.document

    def __hash__(self) -> int:
        return id(self.document)


@lru_cache(maxsize=1)  # the runs of a document follow each other
def _said(root: _Root) -> str:
    """Return a digest of a document without its header."""
    said = [
        (node.tag, node.attributes, node.text, len(node.children))
        for part in root.document.children
        if not isinstance(part, FileHeader)
        for node in part.walk()
    ]
    return hashlib.sha256(repr(said).encode()).hexdigest()
