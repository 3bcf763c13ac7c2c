"""One option of a run, as both command lines and the settings files have it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from osc2tx_runtime.errors import SettingsError
from osc2tx_shared.classes import dataclass

SECONDS = {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 0.001, "min": 60.0}
NUMBER_AND_UNIT = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([A-Za-z]*)", re.ASCII)


@dataclass(frozen=True, slots=True)
class Option:
    """One option of `python scenario.py` and `osc2tx run`.

    Attributes:
        name: As written after `--`.
        metavar: Form of its value; empty for a flag, which is written without one.
        help: One line.
        parse: Reads one text.
        gather: Puts the values together of an option that may be given several times: `tuple`,
            `dict` of (key, value) pairs; None: the last one counts.
        default: For the help page; None where there is nothing to say.
        is_trusted: Whether only the command line may give it: it names Python code, or a file to
            write. Settings files come with repositories of other people.
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
        """Whether it stands without a value."""
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
        raise SettingsError(f"`{text}` is no time: write seconds, as in {example}")
    return float(found[1]) * SECONDS[found[2]]


def parse_pair(text: str, option: str, form: str, example: str) -> tuple[str, str]:
    """Read `KEY=VALUE`.

    Args:
        text: What was written.
        option: As `--spawn`.
        form: What to write: `ACTOR=ROAD,LANE,S`.
        example: One of that form.
    """
    key, equals, value = (part.strip() for part in text.partition("="))
    if not (equals and key and value):
        raise SettingsError(f"{option} {text}: write {form}, as in {option} {example}")
    return key, value
