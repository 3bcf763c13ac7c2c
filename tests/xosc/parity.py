"""Documents, evaluated by the standard's text, against what the embedded world does."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path

from osc2tx.backends.xosc import XmlScenario
from osc2tx.backends.xosc.profiles import PROFILES
from osc2tx.backends.xosc.report import Grade, Metres
from osc2tx.options import CompileOptions, XmlOptions
from osc2tx.xosc.player.conditions import BY_THE_STANDARD, Reading
from osc2tx.xosc.player.storyboard import NOTHING, Evaluator, map_of
from osc2tx_runtime import RunSettings
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_shared.map_files import SHIPPED
from tests.unit.backends.xosc.documents import PLAIN, compiled, documents
from tests.xosc.played import KEPT, Difference, Played, compare, values_of, world

FINE = 0.01  # s
NEAR = 0.1  # m: how far what is graded exact may be off at steps of `FINE`
PACE = 1.0  # m/s: nobody who is approximated goes on more slowly
LONG = 400.0  # s: beyond the end of any document

VERSION = re.compile(r' revMinor="\d+"')
"""In the head of a document."""

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


@cache
def map_read(path: Path) -> RoadMap:
    """Return a map, read once."""
    return read_map(path)


def played(
    xml: str,
    dt: float,
    maps: tuple[Path, ...] = (SHIPPED,),
    *,
    reading: Reading = BY_THE_STANDARD,
    given: Mapping[str, str] = NOTHING,
    most: float = LONG,
) -> Played:
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
    return _played(VERSION.sub("", xml), named, dt, reading, tuple(given.items()), most)


@lru_cache(maxsize=KEPT)
def _played(
    xml: str,
    map_path: Path,
    dt: float,
    reading: Reading,
    given: tuple[tuple[str, str], ...],
    most: float,
) -> Played:
    """Play a document whose version is left out: the evaluator does not ask for it."""
    evaluator = Evaluator(xml, map_read(map_path), dt, reading=reading, given=dict(given))
    end = evaluator.play(most)
    return Played(end, evaluator.starts, evaluator.track)


def scenarios(given: Given) -> tuple[XmlScenario, ...]:
    """Return the scenarios of a source with their documents."""
    return documents(compiled(given.path, given.options), given.xml)


def is_exact(document: XmlScenario) -> bool:
    """Whether all of a document is graded so."""
    return document.xml is not None and all(
        entry.grade is Grade.EXACT for entry in document.report.entries
    )


def reading_of(xml: XmlOptions, *, is_lazy: bool = False) -> Reading:
    """Return how the tool of a profile reads its documents."""
    tool = PROFILES[xml.profile]
    return Reading(
        is_lazy=is_lazy,
        latches=tool.latches_conditions,
        counts_from_looking=not tool.has_delays,
        carries_acceleration=tool.carries_acceleration,
    )


def difference(
    given: Given, document: XmlScenario, *, is_lazy: bool = False, patience: float = 0.0
) -> Difference:
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
    declared, dt = values_of(document), given.settings.dt
    expected = world(given.path, document.name, given.settings, given.options, declared)
    reading = reading_of(given.xml, is_lazy=is_lazy)
    found = played(document.xml, dt, given.maps, reading=reading, given=expected.choices)
    return compare(document, expected, found, dt, patience)


def stated_bounds(document: XmlScenario) -> list[Metres | str]:
    """Return how far the approximations of a document say to be off."""
    entries = document.report.entries
    return [entry.bound for entry in entries if entry.grade is Grade.APPROXIMATED]


def is_measured(document: XmlScenario) -> bool:
    """Whether all approximations of a document say in metres how far off they are."""
    return all(isinstance(bound, Metres) for bound in stated_bounds(document))


def check(given: Given, document: XmlScenario, *, is_lazy: bool = False) -> None:
    """Compare a document with the world whose approximations, if there are some, state metres.

    Places may be off by `NEAR`, by what it makes that events come some steps late, and by what the
    report states. Events may wait for places: they may be off by the time for that way at `PACE`.
    """
    stated = [bound.rounded for bound in stated_bounds(document) if isinstance(bound, Metres)]
    allowed = sum(stated)
    found = difference(given, document, is_lazy=is_lazy, patience=allowed / PACE)
    for actor, (metres, t) in found.apart.items():
        shifted = found.late * found.spread[actor]
        assert metres < NEAR + allowed + shifted, f"{actor} is {metres:.3f} m off at {t} s"
