"""The options of a run: the table that both command lines are built from, and their texts."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.language.settings import RunSettings

__all__ = ["OPTIONS", "Option", "parse_signal", "parse_spawn", "read_options"]

SECONDS = {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 0.001, "min": 60.0}
NUMBER_AND_UNIT = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([A-Za-z]*)")


@dataclass(frozen=True, slots=True)
class Option:
    """One option of `python scenario.py` and `osc2tx run`.

    Attributes:
        name: As written after `--`.
        metavar: Form of its value.
        help: One line.
        parse: Reads one text; (key, value) pairs for options that fill a mapping.
        repeatable: May be given several times.
        default: For the help page; None where there is nothing to say.
    """

    name: str
    metavar: str
    help: str
    parse: Callable[[str], Any]
    repeatable: bool = False
    default: object = None

    @property
    def field(self) -> str:
        """Name of the field of `RunSettings`."""
        return self.name.replace("-", "_")

    def read(self, texts: Sequence[str]) -> Any:
        """Return the field's value for the given texts; the last one counts where one is wanted."""
        values = [self.parse(text) for text in texts]
        if not self.repeatable:
            return values[-1]
        return tuple(values) if self.name in LISTS else dict(values)


def parse_seconds(text: str, example: str) -> float:
    """Read `1`, `1.5s` or `500ms` as seconds."""
    found = NUMBER_AND_UNIT.fullmatch(text.strip())
    if found is None or found[2] not in SECONDS:
        raise SettingsError(f"`{text}` is no time: write seconds, as in {example}")
    return float(found[1]) * SECONDS[found[2]]


def parse_signal(text: str) -> tuple[str, float]:
    """Read `go_signal@1s`."""
    example = "--signal go_signal@1s"
    name, at, time = text.partition("@")
    if not at or not name.strip():
        raise SettingsError(f"--signal {text}: write NAME@SECONDS, as in {example}")
    seconds = parse_seconds(time, example)
    if seconds < 0:
        raise SettingsError(f"--signal {text}: the time is negative; the scenario starts at 0s")
    return name.strip(), seconds


def parse_spawn(text: str) -> tuple[str, tuple[str, int, float]]:
    """Read `hero=16,-3,10`."""
    actor, place = _split(text, "--spawn", "ACTOR=ROAD,LANE,S", "hero=16,-3,10")
    parts = [part.strip() for part in place.split(",")]
    try:
        road, lane, s = parts
        return actor, (road, int(lane), float(s))
    except ValueError:
        raise SettingsError(
            f"--spawn {text}: write ACTOR=ROAD,LANE,S with a road id, a lane id and metres along"
            " the road, as in --spawn hero=16,-3,10"
        ) from None


def parse_destination(text: str) -> tuple[str, str]:
    """Read `hero=obstacle` or `hero=16,-3,200`."""
    return _split(text, "--destination", "ACTOR=ACTOR or ACTOR=ROAD,LANE,S", "hero=obstacle")


def parse_set(text: str) -> tuple[str, float | str]:
    """Read `v=12.5`; what is no number stays text."""
    name, value = _split(text, "--set", "NAME=VALUE", "v=12.5")
    try:
        return name, float(value)
    except ValueError:
        return name, value


def _split(text: str, option: str, form: str, example: str) -> tuple[str, str]:
    key, equals, value = (part.strip() for part in text.partition("="))
    if not (equals and key and value):
        raise SettingsError(f"{option} {text}: write {form}, as in {option} {example}")
    return key, value


def parse_seed(text: str) -> int:
    """Read a whole number."""
    try:
        return int(text)
    except ValueError:
        raise SettingsError(f"--seed {text}: write a whole number, as in --seed 7") from None


LISTS = ("map-path", "allow-external")
"""Repeatable options whose values are a list; those of the others are pairs."""

OPTIONS: tuple[Option, ...] = (
    Option("map-path", "PATH", "folder with maps, or the map itself (.xodr)", Path, True),
    Option("signal", "NAME@SECONDS", "send the event NAME from outside", parse_signal, True),
    Option("spawn", "ACTOR=ROAD,LANE,S", "start position of an actor", parse_spawn, True),
    Option(
        "destination", "ACTOR=GOAL", "where a vehicle goes: actor or R,L,S", parse_destination, True
    ),
    Option("set", "NAME=VALUE", "value of a parameter, in SI units", parse_set, True),
    Option("seed", "N", "seed of all that is sampled", parse_seed, default=0),
    Option(
        "dt", "SECONDS", "length of a step", lambda t: parse_seconds(t, "--dt 0.05"), default=0.05
    ),
    Option(
        "max-time",
        "SECONDS",
        "end the run at this time, with a failure",
        lambda t: parse_seconds(t, "--max-time 60"),
        default=300.0,
    ),
    Option("trace", "FILE", "write the trace (JSON Lines)", Path),
    Option("report", "FILE", "write the report (HTML)", Path),
    Option(
        "allow-external",
        "MODULE.FUNCTION",
        "let the scenario call this Python function",
        str.strip,
        True,
    ),
)


def read_options(texts: Mapping[str, str | Sequence[str] | None]) -> RunSettings:
    """Build settings from the texts of a command line.

    Args:
        texts: Option name (`map-path` or `map_path`) to what was written: one text, a sequence
            for repeatable options, None or nothing at all for the default.

    Raises:
        SettingsError: If a text does not have the form of its option.
    """
    given = {name.replace("_", "-"): text for name, text in texts.items()}
    values: dict[str, Any] = {}
    for option in OPTIONS:
        text = given.pop(option.name, None)
        if text is None:
            continue
        many = [text] if isinstance(text, str) else list(text)
        if many:
            values[option.field] = option.read(many)
    if given:
        raise SettingsError(f"unknown option --{min(given)}")
    return RunSettings(**values)
