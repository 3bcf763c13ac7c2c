"""Hover text of every name of the library and of every word of the language."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("pygls")
from lsprotocol import types as lsp

from osc2tx.language_server.descriptions import describe, hover
from osc2tx.language_server.project import Project
from osc2tx.reference import Topic, entries, topics
from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.symbols import (
    ActorSymbol,
    BehaviorSymbol,
    EnumSymbol,
    ModifierSymbol,
    PhysicalTypeSymbol,
    StructSymbol,
    Symbol,
    UnitSymbol,
)

KINDS = (
    (ModifierSymbol, "modifier"),
    (BehaviorSymbol, "action"),
    (ActorSymbol, "actor"),
    (StructSymbol, "struct"),
    (EnumSymbol, "enum"),
    (PhysicalTypeSymbol, "type"),
    (UnitSymbol, "unit"),
)
LIBRARY = shared_library("2.2", "asam", "all").scope.declared


def named(symbol: Symbol) -> tuple[str, str]:
    """Return what the reference calls a declaration: kind and name."""
    kind = next((kind for class_, kind in KINDS if isinstance(symbol, class_)), "")
    return kind, getattr(symbol, "qualified_name", symbol.name)


def members() -> Iterator[tuple[str, Symbol]]:
    for symbol in LIBRARY:
        for name, member in getattr(symbol, "members", {}).items():
            if member.origin == "library":
                yield f"{named(symbol)[1]}.{name}", member


def lacking(topic: Topic, text: str) -> list[str]:
    """Return what a hover text lacks of a topic."""
    section = topic.section and f"section {topic.section}"
    units = [f"`{unit}`" for unit in topic.units]
    wanted = [topic.signature, section, topic.meaning[1:].rstrip("."), *units]
    return [part for part in wanted if part not in text]


def test_every_declaration_of_the_library() -> None:
    by_name = {named(symbol): symbol for symbol in LIBRARY}
    for entry in entries():
        each = entry.declaration
        text = describe(by_name[each.kind, each.name], None)
        assert f"{each.kind} {each.name}" in text and each.meaning[1:].rstrip(".") in text
        assert each.section in text
        assert all(f"`{unit}`" in text for unit in each.units), each.name
        assert all(member.name in text for member in each.members), each.name


def test_every_member_and_unit_of_the_library() -> None:
    """Members that only 2.1 has are described where they are; this is the library of 2.2."""
    texts = {name: describe(symbol, None) for name, symbol in members()}
    texts |= {s.name: describe(s, None) for s in LIBRARY if isinstance(s, UnitSymbol)}
    asked = [each for each in topics() if not each.is_of_language]
    found = {each.name: lacking(each, texts[each.name]) for each in asked if each.name in texts}
    assert {name: parts for name, parts in found.items() if parts} == {}
    assert len(found) > 0.95 * len(asked)
    assert {each.kind for each in asked} >= {"method", "field", "variable", "parameter", "unit"}


@pytest.mark.parametrize(
    "topic", [each for each in topics() if each.is_of_language], ids=lambda topic: topic.name
)
def test_every_word_of_the_language(topic: Topic, tmp_path: Path) -> None:
    words = [word for word in topic.names if word.isidentifier()]
    for word in words:
        document = Project().change(tmp_path / "a.osc", word)
        found = hover(document, lsp.Position(0, 0))
        assert found is not None, word
        assert lacking(topic, found.contents.value) == [], word  # type: ignore[union-attr]
