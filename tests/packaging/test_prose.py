"""Prose uses the terms of the field: no phrase of `prose.toml`, in code, messages and documents."""

from __future__ import annotations

import re
import subprocess
import tomllib
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
# Lines are joined: a phrase may go over the end of one, with the sign of a comment behind it.
PHRASES = {re.compile(rf"\b{p}".replace(" ", r"\s+(?:#\s+)?"), re.I): RULES[p] for p in RULES}


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


def findings(text: str) -> Iterator[tuple[int, str, str]]:
    """Yield line, phrase and replacement of each phrase in a text."""
    for phrase, instead in PHRASES.items():
        for found in phrase.finditer(text):
            yield text.count("\n", 0, found.start()) + 1, " ".join(found[0].split()), instead


def test_terms_of_the_field() -> None:
    found = [
        f"{path.relative_to(REPOSITORY)}:{line}: `{phrase}`: write {instead}"
        for path in files()
        for line, phrase, instead in findings(path.read_text(encoding="utf-8"))
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    "text", ["taken up at\n    # once", "Packages of others", "what nothing\ncan cut short"]
)
def test_phrases_are_found_across_lines(text: str) -> None:
    assert list(findings(text))
