"""What was reported in words: small files with the exit code and what is said about them.

A case in `reported/*.txt` begins with `=== item | command and options | exit code | text`: the text
is part of what is printed; one that begins with `not ` is no part of it. Below stands the file,
with the imports of `PRELUDE` if it has none. A line `--> item | file | text` names a test elsewhere
that shows the item: the text stands in that file.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.unit.cli.shell import Shell

FOLDER = Path(__file__).parent / "reported"
TESTS = Path(__file__).parent.parent
PRELUDE = "import osc.standard.all\n\nnamespace null use std, stdtypes\n\n"


@dataclass(frozen=True)
class Item:
    """A case.

    Attributes:
        title: What was reported.
        command: With its options.
        code: Exit code.
        says: What it prints; several texts are parted by ` & `.
        text: The file.
    """

    title: str
    command: tuple[str, ...]
    code: int
    says: tuple[str, ...]
    text: str


def read_items() -> list[Item]:
    found = []
    for path in sorted(FOLDER.glob("*.txt")):
        for chunk in re.split(r"^=== ", path.read_text(encoding="utf-8"), flags=re.M)[1:]:
            head, _, body = chunk.partition("\n")
            body = re.sub(r"^--> .*\n", "", body, flags=re.M)
            title, command, code, says = (part.strip() for part in head.split(" | "))
            text = body if body.startswith("import") else PRELUDE + body
            found.append(
                Item(title, tuple(command.split()), int(code), tuple(says.split(" & ")), text)
            )
    return found


def read_references() -> list[tuple[str, str, str]]:
    found = []
    for path in sorted(FOLDER.glob("*.txt")):
        for line in re.findall(r"^--> (.*)$", path.read_text(encoding="utf-8"), flags=re.M):
            title, file, text = line.split(" | ")
            found.append((title, file, text))
    return found


ITEMS, REFERENCES = read_items(), read_references()


def test_titles_tell_items_apart() -> None:
    titles = [item.title for item in ITEMS] + [title for title, _, _ in REFERENCES]
    assert len(set(titles)) == len(titles) > 50


@pytest.mark.parametrize("item", ITEMS, ids=lambda item: item.title)
def test_item(item: Item, shell: Shell) -> None:
    shell.write("item.osc", item.text)
    ended = shell(*item.command, "item.osc")
    said = ended.out + ended.err
    assert ended.code == item.code, said
    for text in item.says:
        if text.startswith("not "):
            assert text.removeprefix("not ") not in said
        else:
            assert text in said


@pytest.mark.parametrize("reference", REFERENCES, ids=lambda reference: reference[0])
def test_named_test_is_there(reference: tuple[str, str, str]) -> None:
    _, file, text = reference
    assert text in (TESTS / file).read_text(encoding="utf-8")
