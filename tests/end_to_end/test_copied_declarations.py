"""Declarations of imported files that are copied: they are not the same there, and why."""

from __future__ import annotations

from pathlib import Path

import pytest

from osc2tx.building.build import build
from osc2tx.config import GivenOptions
from osc2tx.testing import run_scenario as measure
from tests.end_to_end.importing_files import (
    LIBRARY,
    MAIN,
    classes_in,
    imports_in,
    module_of,
    write,
)


@pytest.mark.parametrize(
    ("main", "copied"),
    [
        pytest.param("\nextend limits:\n    extra: speed = 1kph\n", ["Limits", "Approach"]),
        pytest.param("\nextend approach:\n    more: time = 1s\n", ["Approach"]),
    ],
    ids=["type", "scenario"],
)
def test_what_the_importing_file_extends_is_its_own(
    tmp_path: Path, main: str, copied: list[str]
) -> None:
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc") + main, b=LIBRARY)
    text = module_of(tmp_path / "a.osc")
    assert [name for name in classes_in(text) if name != "Top"] == copied
    assert text.count("# A copy from b.osc: here it is not as in that file alone\n") == len(copied)


def test_files_that_import_each_other_have_copies(tmp_path: Path) -> None:
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc"), b=f'import "a.osc"\n{LIBRARY}')
    text = module_of(tmp_path / "a.osc")
    assert imports_in(text) == {}
    assert text.count("# A copy from b.osc: it imports this file as well\n") == 2
    assert imports_in(module_of(tmp_path / "b.osc")) == {}


def test_other_settings_make_copies(tmp_path: Path) -> None:
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc"), b=LIBRARY)
    settings = tmp_path / "osc2tx.toml"
    settings.write_text('[scenarios.b]\none_of = "first"\n', encoding="utf-8")
    assert "# A copy from b.osc: it has other settings\n" in module_of(tmp_path / "a.osc")
    settings.write_text('[scenarios.b]\none_of = "race"\n', encoding="utf-8")
    assert imports_in(module_of(tmp_path / "a.osc")) != {}


def test_what_lies_outside_of_the_folders_is_copied(tmp_path: Path) -> None:
    """A file that a third one hides has no name that a module could import it by."""
    text = MAIN.replace("LIBRARY", "../b.osc")
    write(tmp_path, urban__a=text, b=LIBRARY, urban__b="import osc.standard\n")
    (tmp_path / "osc2tx.toml").write_text('sources = ["urban"]\n', encoding="utf-8")
    reason = "its module lies where this one cannot import it from"
    assert f"# A copy from ../b.osc: {reason}\n" in module_of(tmp_path / "urban/a.osc")


def test_a_module_in_the_way_of_a_folder(tmp_path: Path) -> None:
    """Python would take `lib.py` for the package `lib`."""
    write(tmp_path, a=MAIN.replace("LIBRARY", "lib/b.osc"), lib__b=LIBRARY)
    assert imports_in(module_of(tmp_path / "a.osc")) == {"lib.b": ["Approach", "Limits"]}
    write(tmp_path, lib="import osc.standard\n")
    assert imports_in(module_of(tmp_path / "a.osc")) == {}


def test_a_scenario_is_tested_as_a_file_and_as_a_module(tmp_path: Path) -> None:
    write(tmp_path, urban__a=MAIN.replace("LIBRARY", "../lib/b.osc"), lib__b=LIBRARY)
    build([tmp_path], tmp_path / "out", GivenOptions(target="py"))
    source, module = (
        measure(tmp_path / path, seed=3) for path in ("urban/a.osc", "out/urban/a.py")
    )
    assert (source.status, source.time) == (module.status, module.time)
    assert source.states("hero") == module.states("hero")
