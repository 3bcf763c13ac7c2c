"""Prose uses the terms of the field: no phrase of `prose.toml`, in code, messages and documents."""

from __future__ import annotations

import re
import subprocess
import tomllib
from collections import ChainMap
from collections.abc import Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
FOLDERS = (
    "osc2tx",
    "runtime_lib",
    "templates",
    "grammar",
    "scenarios",
    "tools",
    "benchmarks",
    "docs",
)
SUFFIXES = {".py", ".md", ".osc", ".toml", ".j2", ".g4", ".yml"}
GLOSSARY = REPOSITORY / "docs" / "glossary.md"  # names what not to write
RULES = tomllib.loads(Path(__file__).with_name("prose.toml").read_text(encoding="utf-8"))
SCOPED = RULES.pop("scoped")


def compiled(rules: dict[str, str]) -> dict[re.Pattern[str], str]:
    """Return rules by pattern; a phrase may continue in the next line, also of a comment."""
    return {re.compile(rf"\b{p}".replace(" ", r"\s+(?:#\s+)?"), re.I): rules[p] for p in rules}


PHRASES = compiled(RULES)
OF_FOLDERS = [(tuple(each["folders"]), compiled(each["phrases"])) for each in SCOPED]


def files() -> Iterator[Path]:
    listed = subprocess.run(
        [
            "git",
            "ls-files",
            "--cached",
            "--others",
            "--exclude-standard",
            *FOLDERS,
            "*.md",
            "*.toml",
        ],
        cwd=REPOSITORY,
        capture_output=True,
        text=True,
        check=True,
    )
    for name in listed.stdout.splitlines():
        path = REPOSITORY / name
        is_ours = path != GLOSSARY and not {"_antlr", "tests"} & set(path.parts)
        if is_ours and path.suffix in SUFFIXES and path.is_file():
            yield path


def phrases_for(path: Path) -> dict[re.Pattern[str], str]:
    """Return the rules for a file."""
    name = path.relative_to(REPOSITORY)
    scoped = [rules for folders, rules in OF_FOLDERS if any(map(name.is_relative_to, folders))]
    return dict(ChainMap(PHRASES, *scoped))


def findings(
    text: str, phrases: dict[re.Pattern[str], str] = PHRASES
) -> Iterator[tuple[int, str, str]]:
    """Yield line, phrase and replacement of each phrase in a text."""
    for phrase, instead in phrases.items():
        for found in phrase.finditer(text):
            yield text.count("\n", 0, found.start()) + 1, " ".join(found[0].split()), instead


def test_terms_of_the_field() -> None:
    found = [
        f"{path.relative_to(REPOSITORY)}:{line}: `{phrase}`: write {instead}"
        for path in files()
        for line, phrase, instead in findings(path.read_text(encoding="utf-8"), phrases_for(path))
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    "text", ["taken up at\n    # once", "Packages of others", "what nothing\ncan cut short"]
)
def test_phrases_are_found_across_lines(text: str) -> None:
    assert list(findings(text))
