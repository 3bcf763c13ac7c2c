"""What must hold for every text: stable, same syntax tree, same comments, blind to blanks."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.formatter import format_source
from osc2tx.stdlib import library_source
from osc2tx.syntax import parse
from osc2tx.syntax.dump import dump_ast

SCENARIOS = sorted((Path(__file__).parents[3] / "scenarios").rglob("*.osc"))
_EXTENT = re.compile(r"<[^<>\n]*>$|@\d+:\d+-[\d:]+", re.MULTILINE)


@pytest.mark.parametrize("path", SCENARIOS, ids=lambda path: path.stem)
def test_scenarios(path: Path) -> None:
    assert_well_formatted(path.read_text("utf-8"))


@pytest.mark.slow
def test_corpus(test_data: Path) -> None:
    formatted = 0
    for path in sorted((test_data / "corpus").rglob("*.osc")):
        text = path.read_bytes().decode("utf-8-sig", errors="replace")
        formatted += assert_well_formatted(text)
    assert formatted > 600


@given(st.data())
def test_blanks_between_tokens_do_not_matter(data: st.DataObject) -> None:
    """Blanks around punctuation and line breaks in brackets come and go without a trace."""
    text = library_source("types.osc", "2.1").text if data.draw(st.booleans()) else SAMPLE
    blanks = data.draw(st.lists(st.sampled_from(["", " ", "  ", "\t"]), min_size=1, max_size=20))
    count = iter(range(10**9))

    def respace(match: re.Match[str]) -> str:
        return match[1] + blanks[next(count) % len(blanks)]

    lines = [
        line if "#" in line or '"' in line else re.sub(r"([,:(\[])[ ]*(?=\S)(?!::)", respace, line)
        for line in text.splitlines()
    ]
    formatted = format_of(text)
    assert formatted is not None
    assert format_of("\n".join(lines)) == formatted


@given(st.data())
def test_comments_stay_with_what_they_belong_to(data: st.DataObject) -> None:
    """Comment lines of any indentation, with blank lines around them or not."""
    lines = SAMPLE.strip().splitlines()
    indents = st.sampled_from(["", "  ", "    ", "\t", "          ", "                "])
    for number in data.draw(st.lists(st.integers(0, len(lines)), min_size=1, max_size=8)):
        shown = data.draw(st.sampled_from([[], [""], ["  "]]))
        text = f"{data.draw(indents)}# {number}"
        lines[number:number] = [*shown, text, *data.draw(st.sampled_from([[], [""]]))]
    assert assert_well_formatted("\n".join(lines))


def assert_well_formatted(text: str) -> bool:
    """Return whether the text could be formatted: it has no syntax errors."""
    formatted = format_of(text)
    if formatted is None:
        return False
    assert format_of(formatted) == formatted
    assert tree_of(formatted) == tree_of(text)
    return True


@cache
def format_of(text: str) -> str | None:
    """Return the formatted text; `None` if it has syntax errors."""
    sink, source = DiagnosticSink(), SourceFile("s.osc", text)
    parse(source, sink)
    return None if sink.has_errors else format_source(source)


def tree_of(text: str) -> str:
    """The syntax tree with its comments, without places."""
    return _EXTENT.sub("", dump_ast(parse(SourceFile("s.osc", text), DiagnosticSink())))


SAMPLE = """
import osc.standard

enum kind: [one = 1, two, three]

scenario vehicle.approach:
    lead: vehicle with:
        keep(it.name == "lead")
    gap: length with:
        keep(it in [10m..30m])
    event near(distance: length) is @closer as c if c.distance < 2 * gap
    def closing(a: speed, b: speed) -> speed is expression (a > b) ? a - b : b - a

    do parallel(duration: [5s, 10s], overlap: start):
        serial:
            drive(duration: 3s) with:
                speed(30kph, faster_than: lead, at: start)
                until @near if not (gap > 3m and gap < -1m + 2 * 3m)
        one_of:
            wait elapsed(3s)
            emit near(distance: 3m)
"""
