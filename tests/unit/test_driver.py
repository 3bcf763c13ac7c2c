"""The line of stages, and imports."""

from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.dump import dump_product
from osc2tx.compilation.inputs import InputError, find_inputs
from osc2tx.compilation.roots import Roots
from osc2tx.diagnostics import SourceFile
from osc2tx.options import PRODUCT_NAMES, CompileOptions
from osc2tx.resources import resource_dir

DRIVE = """import osc.standard

scenario {name}:
  ego: vehicle
  do serial:
    ego.drive(duration: 5s) with:
      speed(30kph)
"""


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def drive(path: Path, name: str = "top", head: str = "") -> Path:
    return write(path, head + DRIVE.format(name=name))


def compile_file(path: Path, *roots: Path) -> Compilation:
    compilation = Compilation(path, path.name, CompileOptions(), roots=Roots(roots))
    compilation.check()
    return compilation


def codes(compilation: Compilation) -> list[str]:
    return [diagnostic.code for diagnostic in compilation.diagnostics]


# --- products ---


def test_every_product_can_be_printed(tmp_path: Path) -> None:
    compilation = compile_file(drive(tmp_path / "a.osc"))
    texts = {name: dump_product(compilation, name) for name in PRODUCT_NAMES}
    assert not compilation.diagnostics
    assert all(text and "top" in text for text in texts.values())
    assert "class Top(Scenario):" in str(texts["py"])


def test_products_are_made_once(tmp_path: Path) -> None:
    compilation = compile_file(drive(tmp_path / "a.osc"))
    assert compilation.ir is compilation.ir
    assert compilation.module is compilation.module


def test_syntax_errors_stop_before_the_model(tmp_path: Path) -> None:
    compilation = compile_file(write(tmp_path / "a.osc", "scenario top\n  x: unknown\n"))
    assert compilation.ast is not None
    assert compilation.model is None
    assert compilation.module is None
    assert all(code.startswith("OSC1") for code in codes(compilation))


def test_errors_of_meaning_stop_before_the_ir(tmp_path: Path) -> None:
    compilation = compile_file(write(tmp_path / "a.osc", "scenario top:\n  x: unknown\n"))
    assert compilation.model is not None
    assert compilation.ir is None
    assert dump_product(compilation, "py") is None
    assert codes(compilation) == ["OSC202"]


def test_a_library_makes_no_module(tmp_path: Path) -> None:
    compilation = compile_file(write(tmp_path / "a.osc", "global shade: int = 1\n"))
    assert compilation.ir is not None
    assert compilation.module is None
    assert not compilation.diagnostics


@pytest.mark.parametrize("data", [b"\xff\xfe\x00", b"abc\x00"])
def test_binary_input_is_a_diagnostic(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "a.osc").write_bytes(data)
    compilation = compile_file(tmp_path / "a.osc")
    assert compilation.source is None
    assert codes(compilation) == ["OSC101"]


# --- imports ---


@pytest.mark.parametrize(
    "statement",
    [
        'import "lib/cars.osc"',
        'import "./lib/../lib/cars.osc"',
        "import lib.cars",
        'import "file:lib/cars.osc"',
    ],
)
def test_imports_inside_of_the_folder(tmp_path: Path, statement: str) -> None:
    write(tmp_path / "lib/cars.osc", "enum paint: [red, green]\n")
    text = f"{statement}\nscenario top:\n  color: paint = red\n"
    compilation = compile_file(write(tmp_path / "a.osc", text))
    assert compilation.model is not None
    names = [file.span.source.name for file in compilation.model.files]
    assert names == ["lib/cars.osc", "a.osc"]
    assert "OSC205" not in codes(compilation)


def test_absolute_and_escaped_uris(tmp_path: Path) -> None:
    cars = write(tmp_path / "my cars.osc", "enum paint: [red, green]\n")
    escaped = cars.as_uri()
    assert "%20" in escaped
    for uri in (str(cars), escaped, "my%20cars.osc", "my cars.osc"):
        compilation = compile_file(write(tmp_path / "a.osc", f'import "{uri}"\n'))
        assert codes(compilation) == []


@pytest.mark.parametrize(
    "uri", ["../secret.osc", "{folder}/secret.osc", "file://{folder}/x", "link"]
)
def test_imports_outside_are_refused_unread(tmp_path: Path, uri: str) -> None:
    write(tmp_path / "secret.osc", "enum secret: [a, b]\n")
    (tmp_path / "in").mkdir()
    (tmp_path / "in/link").symlink_to(tmp_path / "secret.osc")
    text = f'import "{uri.format(folder=tmp_path)}"\n'
    compilation = compile_file(write(tmp_path / "in/a.osc", text))
    (found,) = compilation.diagnostics
    assert found.code == "OSC205"
    assert "outside of the folders" in found.message
    assert found.primary is not None
    assert found.primary.line == 1


def test_a_further_root_allows_more(tmp_path: Path) -> None:
    write(tmp_path / "cars.osc", "enum paint: [red, green]\n")
    source = write(tmp_path / "in/a.osc", 'import "../cars.osc"\n')
    compilation = Compilation(source, "in/a.osc", CompileOptions(), roots=Roots((tmp_path,)))
    assert compilation.check()
    assert compilation.model is not None
    assert [f.span.source.name for f in compilation.model.files] == ["cars.osc", "in/a.osc"]


@pytest.mark.parametrize("uri", ["folder", "binary.osc", "http://example.org/a.osc", "//["])
def test_what_cannot_be_imported_is_one_error_at_the_import(tmp_path: Path, uri: str) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "binary.osc").write_bytes(b"\x00")
    compilation = compile_file(write(tmp_path / "a.osc", f'import "{uri}"\n'))
    (found,) = compilation.diagnostics
    assert found.primary is not None
    assert found.primary.source.name == "a.osc"


def test_import_cycles_end(tmp_path: Path) -> None:
    write(tmp_path / "b.osc", 'import "a.osc"\nenum paint: [red]\n')
    assert codes(compile_file(write(tmp_path / "a.osc", 'import "b.osc"\n'))) == []


# --- inputs ---


def test_folders_are_walked_in_order_and_files_count_once(tmp_path: Path) -> None:
    for name in ("b.osc", "a/c.osc", ".hidden/d.osc", ".e.osc", "f.txt"):
        write(tmp_path / name, "")
    found = find_inputs([tmp_path, tmp_path / "b.osc"])
    assert [item.path.relative_to(tmp_path).as_posix() for item in found] == ["b.osc", "a/c.osc"]
    assert find_inputs([tmp_path / "f.txt"])[0].path.name == "f.txt"


@pytest.mark.parametrize("path", ["nothing.osc", "empty", "a\0b"])
def test_paths_without_a_source_are_errors(tmp_path: Path, path: str) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError):
        find_inputs([tmp_path / path])


def test_resources() -> None:
    assert (resource_dir("templates") / "py_trees").is_dir()
    assert list(resource_dir("grammar").glob("*.g4"))
    with pytest.raises(FileNotFoundError):
        resource_dir("nothing")


def test_source_without_path_imports_nothing(tmp_path: Path) -> None:
    from osc2tx.compilation.imports import ImportLoader
    from osc2tx.diagnostics import DiagnosticSink
    from osc2tx.syntax import parse

    sink = DiagnosticSink()
    source = SourceFile("text", 'import "a.osc"\n')
    loader = ImportLoader(tmp_path / "x.osc", "x.osc", Roots((tmp_path,)), sink, frozenset())
    assert loader(parse(source, sink).imports[0], source) is None
