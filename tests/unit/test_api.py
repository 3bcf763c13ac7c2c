"""The compiler as a library."""

from __future__ import annotations

import doctest
from pathlib import Path
from typing import Any

import pytest

import osc2tx
from osc2tx import Diagnostic, api, compile_file, compile_text
from osc2tx.compilation.inputs import InputError

SCENARIOS = Path(__file__).parents[2] / "scenarios"
GENERATED = Path(__file__).parents[2] / "generated"
SUFFIXES = (".py", ".map.json", ".xosc", ".params.xosc")


def test_examples_in_the_documentation() -> None:
    assert doctest.testmod(api).attempted > 5
    assert doctest.testmod(api).failed == 0


def test_a_file_gives_what_build_writes() -> None:
    result = compile_file(SCENARIOS / "cut_in.osc")
    assert result.ok and not result.diagnostics
    committed = {name for name in result.outputs if not name.endswith(".map.json")}
    assert committed == {path.name for path in GENERATED.glob("cut_in.*")} - {"cut_in.map.json"}
    for name in committed:
        assert result.outputs[name] == (GENERATED / name).read_text(encoding="utf-8")


def test_settings_files_count_and_arguments_beat_them() -> None:
    hello_world = SCENARIOS / "hello_world.osc"
    assert compile_file(hello_world).ok
    refused = compile_file(hello_world, dialect="asam")
    assert not refused.ok and not refused.outputs and refused.python is None


def test_a_text_may_import_its_neighbours(tmp_path: Path) -> None:
    (tmp_path / "shared.osc").write_text("struct limits:\n    top: int\n")
    text = 'import "shared.osc"\nactor a:\n    x: limits\n'
    assert compile_text(text, folder=tmp_path).ok
    assert not compile_text(text, folder=tmp_path / "elsewhere").ok


def test_diagnostics_say_where() -> None:
    (found,) = compile_text("actor a:\n    x: lenght\n", name="folder/a.osc").diagnostics
    assert isinstance(found, Diagnostic)
    assert found.primary is not None
    assert str(found.primary) == "folder/a.osc:2"


def test_levels() -> None:
    assert compile_file(SCENARIOS / "cut_in.osc").levels == {"cut_in": "logical"}


def test_outputs_are_written(tmp_path: Path) -> None:
    result = compile_file(SCENARIOS / "cut_in.osc")
    written = result.write(tmp_path / "new")
    assert [path.name for path in written] == [f"cut_in{suffix}" for suffix in SUFFIXES]
    assert written[0].read_text(encoding="utf-8") == result.python


def test_xml_of_a_version() -> None:
    path = SCENARIOS / "cut_in.osc"
    result = compile_file(path, target="xosc", xml_version="1.0")
    assert not result.ok and result.xml is None and result.python is None
    result = compile_file(path, target="xosc", xml_version="1.0", allow_approx=True)
    assert result.ok and result.xml is not None and 'revMinor="0"' in result.xml
    both = compile_file(path)
    assert both.python is not None and both.xml == both.outputs["cut_in.xosc"]


def test_what_is_not_a_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        compile_file(tmp_path / "none.osc")
    with pytest.raises(InputError, match="is a folder"):
        compile_file(tmp_path)


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"standard": "2.2"}, TypeError, "no option `standard`; known options: std, dialect"),
        ({"std": "3"}, ValueError, "std is '3': write '2.1' or '2.2'"),
        ({"dialect": "carlaa"}, ValueError, "write 'asam' or 'carla'"),
        ({"xml_version": "1.9"}, ValueError, "xml_version is '1.9'"),
    ],
)
def test_wrong_options_are_refused(
    options: dict[str, Any], error: type[Exception], message: str
) -> None:
    for call in (compile_text, api.check_text, api.apply_fixes):
        with pytest.raises(error, match=message):
            call("", **options)


def test_names_of_the_package() -> None:
    assert all(hasattr(osc2tx, name) for name in osc2tx.__all__)
    with pytest.raises(AttributeError, match="no attribute 'compile'"):
        osc2tx.compile  # noqa: B018
