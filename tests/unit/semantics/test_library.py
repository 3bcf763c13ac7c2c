"""The library is shared by all programs, and no program changes it."""

import re

import pytest

from osc2tx.options import STANDARDS, Standard
from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.dialects import DIALECTS
from osc2tx.semantics.symbols import ActionSymbol, EnumSymbol, TypeSymbol
from osc2tx.stdlib import LIBRARY, library_source
from tests.unit.semantics.support import build_text, codes

HEAD = "import osc.standard\n\n"
USE = HEAD + "scenario s:\n    v: vehicle\n    n: string = v.nickname\n"
EXTENSION = "extend vehicle:\n    nickname: string\n\nextend color: [pink]\n"


@pytest.mark.parametrize("standard", STANDARDS)
@pytest.mark.parametrize("dialect", DIALECTS)
def test_every_action_of_the_text_is_declared(standard: Standard, dialect: str) -> None:
    scope = shared_library(standard, dialect, "all").scope
    found = [s.qualified_name for s in scope.declared if isinstance(s, ActionSymbol)]
    files = [*LIBRARY] if dialect == "asam" else [*LIBRARY, f"dialects/{dialect}.osc"]
    text = "".join(library_source(file, standard).text for file in files)
    assert sorted(found) == sorted(re.findall(r"^action ([\w.]+)", text, re.MULTILINE))


def test_it_is_built_once() -> None:
    assert shared_library("2.1", "asam", "all") is shared_library("2.1", "asam", "all")


def test_extensions_stay_in_their_program() -> None:
    assert codes(build_text(USE + "\n" + EXTENSION)[1]) == []
    assert codes(build_text(USE)[1]) == ["OSC208"]


def test_checking_does_not_write_to_it() -> None:
    scope = shared_library("2.1", "carla", "all").scope
    before = _snapshot(scope.declared)
    text = "scenario s:\n    v: vehicle\n    do serial:\n        wait @go\n        v.drive()\n"
    build_text(HEAD + text, dialect="carla")
    build_text(HEAD + text + "\n" + EXTENSION, dialect="carla")
    assert _snapshot(scope.declared) == before


def _snapshot(symbols: object) -> list[tuple[str, ...]]:
    assert isinstance(symbols, list)
    return [(s.name, *s.members) for s in symbols if isinstance(s, TypeSymbol | EnumSymbol)]


def test_types_alone_bring_no_actors() -> None:
    text = "import osc.standard.types\n\nnamespace null use stdtypes\n\nstruct s:\n    v: speed\n"
    assert codes(build_text(text)[1]) == []
    assert codes(build_text(text + "    w: vehicle\n")[1]) == ["OSC202"]


def test_a_forgotten_import_is_one_mistake() -> None:
    text = "scenario s:\n    v: vehicle\n    d: length = 3m\n    do v.drive() with:\n"
    text += "        speed(3kph)\n"
    _, sink = build_text(text)
    assert [d.message for d in sink.sorted()] == [
        "`vehicle` belongs to the standard library, which is not imported"
    ]


def test_library_names_need_a_use_list_in_asam() -> None:
    text = "import osc.standard.all\n\nscenario s:\n    v: vehicle\n"
    assert codes(build_text(text)[1]) == ["OSC215"]
    assert codes(build_text(text, dialect="carla")[1]) == []


def test_legacy_import_ends_at_a_namespace_statement() -> None:
    text = HEAD + "struct a:\n    v: vehicle\n\nnamespace mine\n\nstruct b:\n    v: vehicle\n"
    _, sink = build_text(text)
    assert [(d.code, d.primary.line) for d in sink.sorted() if d.primary] == [("OSC215", 9)]


def test_prelude_changes_only_its_dialect() -> None:
    text = HEAD + "scenario s:\n    v: vehicle\n    c: bool = (v.color == red)\n"
    assert codes(build_text(text)[1]) == []
    assert "OSC304" in codes(build_text(text, dialect="carla")[1])
