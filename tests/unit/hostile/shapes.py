"""Shapes of outputs: what must be the same for a hostile text and for its harmless twin."""

from __future__ import annotations

import json
import unicodedata
from html.parser import HTMLParser
from typing import Any
from xml.etree import ElementTree

from tests.unit.hostile.texts import skeleton

__all__ = ["assert_calm", "html_shape", "json_shape", "lines_shape", "skeleton", "xml_shape"]

STEERING = {"Cc", "Cf", "Cs", "Zl", "Zp"}


def assert_calm(text: str, *, colored: bool = False, commands: bool = False) -> None:
    """Check that a text steers no terminal, and that no line of it is a command of a CI server."""
    if colored:
        import re

        text = re.sub("\x1b\\[[0-9;]*m", "", text)
    for line in text.replace("\t", " ").split("\n"):
        found = [char for char in line if unicodedata.category(char) in STEERING]
        assert not found, ascii(line)
        if not commands:
            assert not line.lstrip().startswith("::"), ascii(line)
            for name in ("", "vso", "teamcity", "error"):
                assert f"##{name}[" not in line, ascii(line)


def xml_shape(text: str) -> list[tuple[str, tuple[str, ...]]]:
    """Return the elements of a document with the names of their attributes."""
    assert not any(unicodedata.category(c) in STEERING for c in text.replace("\n", ""))
    return [(node.tag, tuple(node.attrib)) for node in ElementTree.fromstring(text).iter()]


class _Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: list[tuple[str, tuple[str, ...]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, tuple(name for name, _ in attrs)))


def html_shape(text: str) -> list[tuple[str, tuple[str, ...]]]:
    """Return the tags of a page as a browser takes them."""
    parser = _Tags()
    parser.feed(text)
    return parser.tags


def json_shape(text: str) -> Any:
    """Return a document without its texts; names of keys stay where they are few."""
    assert_calm(text, commands=True)

    def shape(value: Any) -> Any:
        if isinstance(value, dict):
            return sorted((shape(each) for each in value.values()), key=repr)  # keys are names
        if isinstance(value, list):
            return [shape(each) for each in value]
        return "number" if isinstance(value, int | float) else type(value).__name__

    return shape(json.loads(text))


def lines_shape(text: str) -> list[str]:
    """Return how each line of a text for people begins."""
    return [line[: len(line) - len(line.lstrip())] for line in text.split("\n")]
