"""Runs that the documents of one scenario share: tests grade it in ten versions and profiles.

A run of the same module with the same settings is the same run, and so is a document that differs
in the number of its version alone.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from typing import Any, TypeVar
from unittest.mock import patch
from weakref import WeakKeyDictionary

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx.grading import grading, measuring
from osc2tx.grading.comparison import Recording
from osc2tx.grading.runs import NoEvidence, WorldRun, run_in_player, run_in_world
from osc2tx.module_loading import scenarios_of_module
from osc2tx.xosc.element import Element
from osc2tx.xosc.elements import FileHeader
from osc2tx_runtime import RunSettings, Scenario

KEPT = 32
"""Runs that are kept: those of one source."""

R = TypeVar("R")

_texts: WeakKeyDictionary[type[Scenario], str] = WeakKeyDictionary()
"""The module of each scenario."""


@contextmanager
def kept_runs() -> Iterator[None]:
    """Let the grading carry out each run once."""
    with (
        patch.object(grading, "scenarios_of_module", _scenarios_of_module),
        patch.object(measuring, "run_in_world", _run_in_world),
        patch.object(measuring, "run_in_player", _run_in_player),
    ):
        yield


@contextmanager
def _scenarios_of_module(module: GeneratedModule) -> Iterator[Mapping[str, type[Scenario]]]:
    with scenarios_of_module(module) as scenarios:
        _texts.update(dict.fromkeys(scenarios.values(), module.python))
        yield scenarios


class _Call:
    """A call that may be remembered: calls are equal if their keys are."""

    def __init__(self, key: object, carry_out: Callable[[], Any]) -> None:
        self.key, self.carry_out = key, carry_out

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Call) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)


@lru_cache(maxsize=KEPT)
def _result(call: _Call) -> Any:
    try:
        return call.carry_out()
    except NoEvidence as error:
        return error
    finally:
        call.carry_out = bool  # what it refers to is not kept


def _once(key: object, carry_out: Callable[[], R]) -> R:
    result = _result(_Call(key, carry_out))
    if isinstance(result, NoEvidence):
        raise result
    found: R = result
    return found


def _run_in_world(scenario: type[Scenario], settings: RunSettings) -> WorldRun:
    key = _texts[scenario], scenario.name, repr(settings)
    return _once(key, lambda: run_in_world(scenario, settings))


def _run_in_player(document: Element, road_map: Any, dt: float, **others: Any) -> Recording:
    parts = tuple(part for part in document.children if not isinstance(part, FileHeader))
    given = tuple(sorted(others["given"].items()))
    key = parts, id(road_map), dt, others["reading"], given, others["most"]
    return _once(key, lambda: run_in_player(document, road_map, dt, **others))
