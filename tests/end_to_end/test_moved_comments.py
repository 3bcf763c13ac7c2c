"""A comment at any line of a scenario is in its module once, beside what the line becomes.

Every logical line gets a comment of its own: above it, above it behind a blank line, behind it, or
below it. The neighbour of the comment in the module shares a word with the statement.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.config import ConfigFiles, GivenOptions
from tests.end_to_end.harness import SCENARIOS
from tests.end_to_end.test_comments import Line, Source
from tests.golden.test_stages import HERE as GOLDEN
from tests.golden.test_stages import options_for

NUMBER = re.compile(r"<(\d+)>")
WORD = re.compile(r"[a-z0-9]+(?:_[a-z0-9]+)*")
KINDS = ("above", "apart", "behind", "below")

OURS = ("cut_in", "cut_in_and_evade", "follow_leader", "hello_world", "pedestrian_crossing")
CAPABILITIES = tuple(sorted(path.stem for path in SCENARIOS.glob("capabilities/*.osc")))
CASES = (
    *OURS,
    *(pytest.param(each, marks=pytest.mark.slow) for each in CAPABILITIES),
    *("own_events", "own_objects", "own_modifiers", "fields", "reactions", "coverage"),
)

IN_A_LINE_OF_OTHERS = ("keep(", "until", "modifier", "extend")
"""Statements that say something of what the line of another one makes."""

WITHOUT_CODE = {
    r"type \w+ is SI": "a module has units, and no physical types",
    r"export |use ": "a module exports all that it has",
    r"action vehicle.\w+ inherits": "an action of the library has its class in the runtime",
    r"modifier vehicle.careful": "places an actor, so that it is written out where it is applied",
    r"(limit: speed|in_lane: int = 2|speed\(limit\)|lane\(in_lane)": "parts of that modifier",
    r"mode: string$": "a parameter of an action that the runtime has",
    r"with:": "not a statement: its comments are those of the first line below",
}
"""Lines whose comments a module does not have, and why."""


def path_of(case: str) -> Path:
    if case in CAPABILITIES:
        return SCENARIOS / "capabilities" / f"{case}.osc"
    return SCENARIOS / f"{case}.osc" if case in OURS else GOLDEN / "py_trees" / case / "input.osc"


def with_comments(source: Source, kind: str) -> tuple[str, dict[int, Line]]:
    """Return a text with a comment at each line, and the lines by the numbers of the comments."""
    rows, found = list(source.rows), dict[int, Line]()
    for number, line in enumerate(source.lines):
        comment, indent = f"# <{number}>", " " * line.column
        first, last = line.first - 1, line.last - 1
        follows = source.rows[last + 1 : last + 2]
        if kind in ("behind", "below") and "#" in "".join((source.rows[last], *follows)):
            continue
        found[number] = line
        match kind:
            case "above":
                rows[first] = f"{indent}{comment}\n{rows[first]}"
            case "apart":
                rows[first] = f"\n{indent}{comment}\n\n{rows[first]}"
            case "behind":
                rows[last] += f"  {comment}"
            case "below":
                is_header = any(x.column > line.column for x in following(source, line))
                if is_header:
                    del found[number]
                else:
                    rows[last] += f"\n{indent}{comment}\n"
    return "\n".join(rows), found


def following(source: Source, line: Line) -> list[Line]:
    place = source.lines.index(line)
    return source.lines[place + 1 : place + 2]


def words(text: str) -> set[str]:
    """Return the words of some code; of names in camel case also their parts."""
    plain = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", text).lower()
    found = set(WORD.findall(plain))
    return {part for word in found for part in (word, *word.split("_")) if len(part) > 1}


def around(python: list[str], place: int) -> str:
    """Return the code beside a comment: its line, and those next to it; of a docstring its head."""
    line = python[place]
    if "#" not in line:
        heads = (n for n in range(place, 0, -1) if re.match(r" *(def|class) ", python[n]))
        head = next(heads, None)
        return "module" if head is None else "\n".join(python[head : place + 6])
    code = [each for each in python if not each.strip().startswith("#") and each.strip()]
    before = sum(1 for e in python[:place] if not e.strip().startswith("#") and e.strip())
    return "\n".join(code[max(before - 8, 0) : before + 3])


def is_behind(python: list[str], place: int) -> bool:
    """Whether a comment is behind code, or above what has several lines, parts or no room."""
    line = python[place].split("#")[0].strip()
    below = next((x for x in python[place + 1 :] if x.strip() and x.strip()[0] != "#"), "")
    is_long = below.endswith(("(", "[", "{", ":")) or len(below) + len("  # <10>") > 100
    is_gathered = "#" in below or "self.place(" in below or "self.require(" in below
    return bool(line) or is_long or is_gathered


def said_by(source: Source, line: Line) -> str:
    """Return a statement, what it is in, and its first member, which tells of a composition."""
    above = [x for x in source.lines if x.first < line.first and x.column < line.column]
    inside = [x for x in following(source, line) if x.column > line.column]
    return "\n".join(source.rows[x.first - 1] for x in (*above[-1:], line, *inside))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("case", CASES)
def test_each_line(case: str, kind: str) -> None:
    path = path_of(case)
    source = Source(path.read_text(encoding="utf-8"))
    text, lines = with_comments(source, kind)
    options = (
        ConfigFiles().for_source(path).options_for(path, GivenOptions())
        if case in (*OURS, *CAPABILITIES)
        else options_for(path.parent)
    )
    module = Compilation(path, path.name, options, text=text).module
    assert module is not None
    python = module.python.splitlines()
    places: dict[int, list[int]] = {}
    for place, row in enumerate(python):
        for number in NUMBER.findall(row):
            places.setdefault(int(number), []).append(place)
    wrong = []
    for number, line in lines.items():
        statement = source.rows[line.first - 1].strip()
        if any(re.match(pattern, statement) for pattern in WITHOUT_CODE):
            continue
        found = places.get(number, [])
        if len(found) != 1:
            wrong.append((len(found), statement))
        elif (beside := around(python, found[0])) != "module":
            is_body = statement.startswith("do ") and "def behavior" in beside
            is_block = statement.endswith(":") or statement.startswith(IN_A_LINE_OF_OTHERS)
            if kind == "behind" and not (is_block or is_behind(python, found[0])):
                wrong.append(("not behind", statement))
            if not is_body and not words(said_by(source, line)) & words(beside):
                wrong.append((statement, beside))
    assert wrong == []
