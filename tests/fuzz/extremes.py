"""Numbers that nobody would write, in place of one number of a scenario."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.options import CompileOptions

EXTREMES = ("0", "-1", "1e308", "-1e308", "1e-308", "nan", "inf", "9223372036854775808")
SECONDS = 4.0  # of simulated time

_PARTS = re.compile(
    r"""\#.*                                   # a comment
      | \"(?:\\.|[^\"\\\n])*\"                 # a string
      | '(?:\\.|[^'\\\n])*'
      | (?<!\w)(?<!\w\.)(?P<number>\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)""",
    re.VERBOSE,
)


@dataclass(frozen=True, slots=True)
class Scenario:
    """A scenario whose numbers are replaced.

    Attributes:
        path: The file; imports and maps are found from it.
        text: Its text.
        options: How it is compiled.
    """

    path: Path
    text: str
    options: CompileOptions

    def numbers(self) -> list[tuple[int, int]]:
        """Return where its numbers stand, outside of comments and strings."""
        return [found.span() for found in _PARTS.finditer(self.text) if found["number"]]

    def with_number(self, span: tuple[int, int], value: str) -> str:
        """Return its text with another number."""
        return self.text[: span[0]] + value + self.text[span[1] :]


@cache
def scenarios(folder: Path) -> Sequence[Scenario]:
    """Return the scenarios below a folder, with the options of their settings."""
    configs = ConfigFiles()
    found = []
    for path in sorted(folder.rglob("*.osc")):
        options = configs.for_source(path).options_for(path, GivenOptions())
        found.append(Scenario(path, path.read_text(encoding="utf-8", errors="replace"), options))
    return tuple(each for each in found if each.numbers())


def every(scenario: Scenario) -> Iterator[str]:
    """Yield the texts with each extreme in place of each number."""
    for span in scenario.numbers():
        for value in EXTREMES:
            yield scenario.with_number(span, value)


def write_extreme(random: Random, folder: Path) -> tuple[Scenario, str]:
    """Return a scenario, and its text with an extreme in place of one number."""
    scenario = random.choice(scenarios(folder))
    return scenario, scenario.with_number(
        random.choice(scenario.numbers()), random.choice(EXTREMES)
    )
