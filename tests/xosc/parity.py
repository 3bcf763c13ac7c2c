"""Documents, evaluated by the standard's text, against what the embedded world does.

The product does the same when it builds (`osc2tx.grading`); here everything is played at fine
steps, and in every version.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache
from math import inf
from pathlib import Path
from types import MappingProxyType

from osc2tx.backends.xosc import XmlScenario
from osc2tx.diagnostics import Span
from osc2tx.grading import comparison
from osc2tx.grading.comparison import Deviation, Recording
from osc2tx.grading.measuring import PACE
from osc2tx.grading.runs import (
    cached_map,
    declared_values,
    reading_of,
    run_in_player,
    run_in_world,
    values_for,
)
from osc2tx.losses.bounds import Metres, rounded_up
from osc2tx.losses.entries import Grade
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions, XmlOptions
from osc2tx.xosc import read
from osc2tx.xosc.player import BY_THE_STANDARD, Reading, map_of
from osc2tx.xosc.profiles import PROFILES
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_shared.map_files import SHIPPED
from tests.unit.backends.xosc.documents import PLAIN, compiled, generated, graded_documents
from tests.unit.backends.xosc.kept_runs import without_version

FINE = 0.01  # s
NEAR = comparison.EXACT
LONG = 400.0  # s: beyond the end of any document
KEPT = 16
"""How many runs are kept: those of one source, whose documents often are the same in versions."""
NOTHING: Mapping[str, str] = MappingProxyType({})

WRITTEN = [(name, version) for name, tool in PROFILES.items() for version in tool.versions]
"""The profiles, each with the versions of the documents that it has."""


@dataclass(frozen=True)
class Given:
    """A source, and what it needs from outside."""

    path: Path
    settings: RunSettings = field(default_factory=lambda: RunSettings(dt=FINE), compare=False)
    options: CompileOptions = PLAIN
    xml: XmlOptions = field(default_factory=XmlOptions)
    maps: tuple[Path, ...] = (SHIPPED,)


# --- the world ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Run:
    """A scenario of a file with its settings, two of which are equal if they say the same."""

    path: Path
    name: str
    options: CompileOptions
    said: str
    settings: RunSettings = field(compare=False)

    @contextmanager
    def loaded(self) -> Iterator[type[Scenario]]:
        """Give the class of the scenario."""
        with scenarios_of_module(generated(compiled(self.path, self.options))) as scenarios:
            yield scenarios[self.name]


Values = tuple[tuple[str, float | str], ...]


@lru_cache(maxsize=KEPT)
def _values(run: Run, declared: Values) -> Values:
    """Return what of the declared values the scenario is given; documents declare more than it."""
    with run.loaded() as scenario:
        return tuple(values_for(scenario, run.settings, dict(declared)).items())


@lru_cache(maxsize=KEPT)
def _outcome(run: Run, values: Values) -> Recording:
    """Return what the embedded world does with a scenario."""
    settings = run.settings
    with run.loaded() as scenario:
        found = run_in_world(scenario, replace(settings, set={**dict(values), **settings.set}))
    assert found.is_whole, "the time is over"
    return found.recording


def world(
    path: Path,
    name: str,
    settings: RunSettings,
    options: CompileOptions,
    declared: Mapping[str, float | str] = MappingProxyType({}),
) -> Recording:
    """Return what the embedded world does with the values that a document declares."""
    return _world(Run(path, name, options, repr(settings), settings), declared)


def _world(run: Run, declared: Mapping[str, float | str]) -> Recording:
    return _outcome(run, _values(run, tuple(declared.items())))


def values_of(document: XmlScenario) -> dict[str, float | str]:
    """Return what a document declares as parameters."""
    assert document.xml is not None
    return declared_values(read(document.xml), {})


# --- documents ------------------------------------------------------------------------------------


def played(
    xml: str,
    dt: float,
    maps: tuple[Path, ...] = (SHIPPED,),
    *,
    reading: Reading = BY_THE_STANDARD,
    given: Mapping[str, str] = NOTHING,
    most: float = LONG,
) -> Recording:
    """Return what the standard makes of a document.

    Args:
        xml: The document.
        dt: Length of a step (s).
        maps: Folders with its map.
        reading: How it is read.
        given: Values of parameters, instead of those that the document has for them.
        most: Seconds after which it is left.
    """
    named = map_of(xml, maps)
    return _played(without_version(xml), named, dt, reading, tuple(given.items()), most)


@lru_cache(maxsize=KEPT)
def _played(
    xml: str,
    map_path: Path,
    dt: float,
    reading: Reading,
    given: tuple[tuple[str, str], ...],
    most: float,
) -> Recording:
    """Play a document whose version is left out: the evaluator does not ask for it."""
    road_map = cached_map(map_path)
    return run_in_player(read(xml), road_map, dt, reading=reading, given=dict(given), most=most)


def scenarios(given: Given) -> tuple[XmlScenario, ...]:
    """Return the scenarios of a source with their documents, as builds grade them."""
    return graded_documents(compiled(given.path, given.options), given.xml)


def is_exact(document: XmlScenario) -> bool:
    """Whether all of a document is graded so."""
    return document.xml is not None and all(
        entry.grade is Grade.EXACT for entry in document.report.entries
    )


def reading_for(xml: XmlOptions, *, is_lazy: bool = False) -> Reading:
    """Return how the tool of a profile reads its documents."""
    return reading_of(PROFILES[xml.profile], is_lazy=is_lazy)


# --- both -----------------------------------------------------------------------------------------


def compare(
    document: XmlScenario, expected: Recording, found: Recording, dt: float, patience: float = 0.0
) -> Deviation:
    """Compare what a tool has done with what the embedded world does.

    Args:
        document: What was played.
        expected: What the embedded world does.
        found: What the tool has done.
        dt: Length of a step (s), of both.
        patience: Seconds that events may be off, besides those for the ones before.

    Raises:
        AssertionError: Something has not happened, came too late, or in another order.
    """
    assert document.xml is not None
    root = read(document.xml)
    deviation = comparison.compare(root, document.origins, expected, found, dt, patience)
    assert not deviation.problems
    return deviation


def difference(
    given: Given, document: XmlScenario, *, is_lazy: bool = False, patience: float = 0.0
) -> Deviation:
    """Return how far a document is from the world, at the steps of its settings.

    Args:
        given: Its source.
        document: The document.
        is_lazy: Of a group of conditions a tool looks at none behind a false one.
        patience: Seconds that events may be off, besides a step for each one before them.

    Raises:
        AssertionError: An event has not happened, came too late, or in another order.
    """
    assert document.xml is not None
    run = Run(given.path, document.name, given.options, repr(given.settings), given.settings)
    origins = tuple(sorted(document.origins.items(), key=lambda origin: origin[0]))
    reading = reading_for(given.xml, is_lazy=is_lazy)
    xml = without_version(document.xml)
    deviation = _difference(run, xml, origins, given.maps, reading, patience)
    assert not deviation.problems
    return deviation


@lru_cache(maxsize=KEPT)
def _difference(
    run: Run,
    xml: str,
    origins: tuple[tuple[str, Span], ...],
    maps: tuple[Path, ...],
    reading: Reading,
    patience: float,
) -> Deviation:
    """Return how far a document whose version is left out is from the world."""
    root, dt = read(xml), run.settings.dt
    expected = _world(run, declared_values(root, {}))
    found = played(xml, dt, maps, reading=reading, given=expected.choices)
    return comparison.compare(root, dict(origins), expected, found, dt, patience)


def bound_of(document: XmlScenario) -> float | None:
    """Return how far (m) a document says to be off; `None` if it does not say so in metres."""
    report = document.report
    bounds = [entry.bound for entry in report.approximations]
    stated = [bound.rounded for bound in bounds if isinstance(bound, Metres)]
    if len(stated) == len(bounds):
        return sum(stated)
    if report.measured is None or report.measured.events:
        return None
    return sum(stated) + rounded_up(report.measured.place)


def is_stated(document: XmlScenario) -> bool:
    """Whether all approximations of a document state metres, whatever a run has shown."""
    return all(isinstance(each.bound, Metres) for each in document.report.approximations)


def is_measured(document: XmlScenario) -> bool:
    """Whether all approximations of a document say in metres how far off they are."""
    return bound_of(document) is not None


def check(given: Given, document: XmlScenario, *, is_lazy: bool = False) -> None:
    """Compare a document with the world whose approximations, if there are some, state metres.

    Places may be off by `NEAR`, by what it makes that events come some steps late, and by what the
    report states. Events may wait for places: they may be off by the time for that way at `PACE`,
    and by any time where only a run has shown how far off the places are.
    """
    allowed = bound_of(document)
    assert allowed is not None, "it says how far it is off"
    patience = allowed / PACE if is_stated(document) else inf
    found = difference(given, document, is_lazy=is_lazy, patience=patience)
    assert not found.beyond(NEAR + allowed), found
