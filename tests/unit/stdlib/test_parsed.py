"""The ASTs that osc2tx has of its library: those of its texts, and same as parsing."""

import json
from pathlib import Path

import pytest

from osc2tx import stdlib
from osc2tx.diagnostics import SourceFile
from osc2tx.semantics import DIALECTS, ModelBuilder
from osc2tx.semantics.builder import DiagnosticSink
from osc2tx.semantics.declarations import library
from osc2tx.semantics.dump import dump_model
from osc2tx.stdlib import LIBRARY, TYPES, library_file, library_source, parse_library_file, parsed
from osc2tx.stdlib.parsed import load_parsed
from osc2tx.syntax import parse
from osc2tx.syntax.dump import dump_ast
from osc2tx.syntax.packed_ast import PackingError, pack, unpack
from tools.make_library import PRELUDES, render

ROOT = Path(__file__).resolve().parents[3]
OWN = sorted(ROOT.glob("scenarios/*.osc")) + sorted(ROOT.glob("tests/golden/ast/*/input.osc"))
MISTAKES = sorted(ROOT.glob("tests/golden/diagnostics/semantic_*/*.osc"))
SCENARIOS = [*OWN, *MISTAKES]
TEXTS = [(name, standard) for name in (*LIBRARY, *PRELUDES) for standard in ("2.1", "2.2")]


def test_the_files_are_those_of_the_texts() -> None:
    expected = render()
    assert {
        path: path.read_text("utf-8") for path in expected
    } == expected, "the library or its AST has changed: run `python tools/make_library.py`"
    assert set(next(iter(expected)).parent.iterdir()) == set(expected)


@pytest.mark.parametrize(("name", "standard"), TEXTS)
def test_the_ast_is_that_of_parsing(name: str, standard: str) -> None:
    source = library_source(name, standard)
    loaded = load_parsed(source, standard)
    assert loaded is not None
    assert dump_ast(loaded) == dump_ast(parse_library_file(source))
    assert loaded.span.source is source


@pytest.mark.parametrize(
    "path",
    [*OWN, *(pytest.param(path, marks=pytest.mark.slow) for path in MISTAKES)],
    ids=lambda path: f"{path.parent.name}/{path.stem}",
)
def test_every_construct_survives_packing(path: Path) -> None:
    source = SourceFile(path.name, path.read_bytes().decode("utf-8", "replace"))
    file = parse(source, DiagnosticSink())
    data = json.loads(json.dumps(pack(file)))
    assert dump_ast(unpack(data, source)) == dump_ast(file)


def forget() -> None:
    library_file.cache_clear()
    library.shared_library.cache_clear()


def modelled(path: Path, dialect: str) -> tuple[str, list[str]]:
    """The model of a file and what is reported on it, places in the library included."""
    sink = DiagnosticSink()
    file = parse(SourceFile(path.name, path.read_bytes().decode("utf-8", "replace")), sink)
    builder = ModelBuilder(
        sink, standard="2.2", dialect=DIALECTS[dialect], load=lambda statement, source: None
    )
    model = builder.build(file)
    return dump_model(model), [
        f"{d.code} {d.primary!r} {d.message} {[(x.span, x.message) for x in d.labels]}"
        for d in sink.sorted()
    ]


@pytest.mark.parametrize("dialect", ["asam", pytest.param("carla", marks=pytest.mark.slow)])
def test_models_do_not_differ(dialect: str, monkeypatch: pytest.MonkeyPatch) -> None:
    forget()
    found = [modelled(path, dialect) for path in SCENARIOS]
    forget()
    monkeypatch.setattr(stdlib, "load_parsed", lambda source, standard: None)
    assert found == [modelled(path, dialect) for path in SCENARIOS]
    forget()


def test_a_text_that_has_changed_is_parsed() -> None:
    source = library_source(TYPES, "2.2")
    assert load_parsed(SourceFile(source.name, source.text + "\n"), "2.2") is None


def test_a_text_of_another_version_is_parsed(monkeypatch: pytest.MonkeyPatch) -> None:
    assert load_parsed(library_source(TYPES, "2.1"), "2.2") is None
    monkeypatch.setattr(parsed, "_FOLDER", Path("nowhere"))
    assert load_parsed(library_source(TYPES, "2.2"), "2.2") is None


@pytest.mark.parametrize(
    "packed",
    [None, [], [("File", 1, [])], [("Nothing", 1, [])], [("Name", 1, [("plain", [1])] * 3)]],
)
def test_data_that_are_no_ast_are_refused(packed: object) -> None:
    with pytest.raises(PackingError):
        unpack(packed, library_source(TYPES, "2.2"))  # type: ignore[arg-type]
