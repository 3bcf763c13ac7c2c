"""Whatever is typed so far, every question has an answer."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("pygls")
from lsprotocol import types as lsp

from osc2tx.language_server import decorations, descriptions, navigation, problems
from osc2tx.language_server.completion import completions, signature
from osc2tx.language_server.contexts import cursor_at
from osc2tx.language_server.positions import offset_of, position_of, whole
from osc2tx.language_server.project import Project
from tests.end_to_end.harness import REPOSITORY

SCENARIOS = REPOSITORY / "scenarios"
FILES = [
    SCENARIOS / "cut_in.osc",
    SCENARIOS / "follow_leader.osc",
    SCENARIOS / "capabilities" / "C21_along.osc",
]
STEP = 11  # characters between two questions


def ask_everything(project: Project, path: Path, text: str, offset: int) -> int:
    """Ask all that an editor asks about a text; return how much can be completed."""
    document = project.change(path, text)
    source, uri = document.source, path.as_uri()
    position = position_of(source, offset)
    assert offset_of(source, position) == offset
    problems.problems(document)
    problems.actions(document, uri, whole(source), None)
    descriptions.hover(document, position)
    navigation.definition(document, position)
    navigation.outline(document)
    navigation.foldings(document)
    decorations.semantic_tokens(document)
    decorations.inlay_hints(document, whole(source))
    decorations.lenses(document, uri)
    model = project.model_near(path, offset)
    signature(text, offset, model)
    return len(completions(text, offset, model, document.job))


@pytest.mark.slow
@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_typing_a_file(file: Path, tmp_path: Path) -> None:
    text = file.read_text(encoding="utf-8")
    project = Project()
    for end in range(1, len(text)):  # character by character
        ask_everything(project, tmp_path / "typed.osc", text[:end], end)


@pytest.mark.slow
@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_deleting_a_word_in_a_file(file: Path, tmp_path: Path) -> None:
    text = file.read_text(encoding="utf-8")
    project = Project()
    for start in range(0, len(text), STEP):
        ask_everything(project, tmp_path / "typed.osc", text[:start] + text[start + 6 :], start)


@pytest.mark.parametrize(
    "text",
    ["", "\n", "(", "scenario", "scenario s:", "\t(((", '"', "'''", "@", ".", "1", "a.b.", "x: "],
)
def test_texts_that_are_nearly_nothing(text: str, tmp_path: Path) -> None:
    ask_everything(Project(), tmp_path / "typed.osc", text, len(text))


def test_positions_count_utf_16(tmp_path: Path) -> None:
    text = "# \N{PILE OF POO}é\r\nactor a\r\n"
    document = Project().change(tmp_path / "a.osc", text)
    assert position_of(document.source, 4) == lsp.Position(0, 5)
    assert offset_of(document.source, lsp.Position(0, 99)) == text.index("\r")
    assert offset_of(document.source, lsp.Position(9, 0)) == len(text)


@pytest.mark.parametrize(
    ("text", "block", "callee"),
    [
        ("scenario s:\n    do serial:\n        |", "do", ""),
        ("scenario s:\n    do serial:\n        a.b() with:\n            speed(|", "with", "speed"),
        ("scenario s:\n    x: vehicle with:\n        keep(|", "with", "keep"),
        ("scenario s:\n    |", "type", ""),
        ("scenario s:\n    on @e:\n        |", "on", ""),
        ("scenario s:\n    do parallel:\n        p: serial:\n            |", "do", ""),
        ('import "(|', "file", ""),
        ("scenario s:\n    do serial:\n        a.b(c.d(1, x: 2), |", "do", "a.b"),
    ],
)
def test_where_the_cursor_is(text: str, block: str, callee: str) -> None:
    offset = text.index("|")
    cursor = cursor_at(text.replace("|", ""), offset)
    assert cursor.block.value == block
    assert (cursor.call.callee if cursor.call else "") == callee
