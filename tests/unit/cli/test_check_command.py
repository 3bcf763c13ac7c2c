"""The command `check`: what it prints and returns."""

import pytest

from osc2tx.cli import reporting
from tests.unit.cli.shell import DRIVE, Ended, Shell

LEVEL = "scenario top: abstract (open: map file; place of ego)"


def test_check_of_a_good_file(shell: Shell) -> None:
    shell.drive("a.osc")
    ended = shell("check", "a.osc")
    level = f"a.osc: {LEVEL}\n"
    assert ended == Ended(0, f"{level}checked 1 file: 0 errors, 0 warnings\n", "")


def test_levels_of_many_scenarios_in_folders_are_counted(shell: Shell) -> None:
    for number in range(10):
        shell.drive(f"sub/s{number}.osc")
    assert shell("check", "sub").out.splitlines() == [
        *(f"s{number}.osc: {LEVEL}" for number in range(10)),
        "checked 10 files: 0 errors, 0 warnings",
    ]
    place = "speed(9mps)\n        lane(1, at: start)\n        position(9m, at: start)\n"
    fixed = ON_A_MAP.format(map="highway").replace("1s)", f"1s) with:\n        {place}")
    shell.write("sub/c.osc", fixed)
    counted = "11 scenarios: 1 concrete, 10 abstract\n"
    assert shell("check", "sub").out == f"{counted}checked 11 files: 0 errors, 0 warnings\n"
    shell.drive("sub/t.osc")
    mixed = shell("check", "sub/t.osc", "sub").out.splitlines()
    assert mixed[:2] == [f"t.osc: {LEVEL}", counted.strip()]


def test_check_shows_errors_where_the_reader_is(shell: Shell) -> None:
    shell.write("sub/a.osc", "scenario top:\n  hero: vehicel\n")
    shell.drive("sub/b.osc")
    ended = shell("check", "sub")
    assert ended.code == 3
    assert ended.out == f"b.osc: {LEVEL}\nchecked 2 files: 1 error, 0 warnings\n"
    assert ended.err.startswith("sub/a.osc:2:9: error[OSC202]: ")
    assert ended.err.endswith("\n\n`osc2tx explain OSC202` explains the code.\n")


def test_warnings_do_not_fail(shell: Shell) -> None:
    shell.write("a.osc", DRIVE.format(name="top").replace("\n\n", "\nuse std.stdtypes\n"))
    ended = shell("check", "--dialect", "carla", "a.osc")
    assert ended.code == 0, ended.err
    assert "warning[OSC601]" in ended.err


def test_an_avalanche_is_cut(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reporting, "MOST_SHOWN", 2)
    fields = "".join(f"  a{number}: nothing{number}\n" for number in range(5))
    shell.write("a.osc", "scenario top:\n" + fields)
    ended = shell("check", "a.osc")
    assert ended.err.count("error[") == 2
    assert "\na.osc: 3 more not shown\n" in ended.err


def test_a_mistake_in_an_imported_file_counts_once(shell: Shell) -> None:
    shell.write("lib.osc", "struct place:\n  x: nothing\n")
    for name in ("a.osc", "b.osc"):
        shell.write(name, 'import "lib.osc"\n')
    ended = shell("check", ".")
    assert ended.code == 3
    assert ended.out == "checked 3 files: 1 error, 0 warnings\n"
    assert ended.err.count("error[OSC202]") == 1


def test_missing_folder_and_file(shell: Shell) -> None:
    (shell.folder / "empty").mkdir()
    assert shell("check", "no.osc") == Ended(
        4, "", "osc2tx: error: no.osc: no such file or folder\n"
    )
    assert shell("check", "empty").code == 2


def test_binary_file(shell: Shell) -> None:
    (shell.folder / "a.osc").write_bytes(b"\x00\xff")
    ended = shell("check", "a.osc")
    assert ended.code == 4
    assert "error[OSC101]: cannot read `a.osc`" in ended.err


def test_wrong_settings_file(shell: Shell) -> None:
    shell.drive("a.osc")
    shell.write("osc2tx.toml", 'dialct = "carla"\n')
    ended = shell("check", "a.osc")
    assert ended.code == 2
    assert ended.err.endswith("osc2tx.toml: unknown key `dialct`; did you mean `dialect`?\n")


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["check"],
        ["chek", "a.osc"],
        ["check", "--std", "3.0", "a.osc"],
        ["build", "a.osc"],
        ["build", "a.osc", "-o", "out", "--emit", "ast"],
        ["build", "a.osc", "-o", "out", "--target", "xml"],
        ["run"],
        ["run", "a.osc", "--seed", "x"],
        ["run", "a.osc", "--signal", "go"],
        ["run", "a.osc", "--dt", "-1"],
        ["run", "a.osc", "--scenario", "nobody"],
        ["run", "a.osc", "--set", "nobody=1"],
        ["explain", "OSC999"],
    ],
)
def test_wrong_usage(shell: Shell, arguments: list[str]) -> None:
    shell.drive("a.osc")
    ended = shell(*arguments)
    assert ended.code == 2
    assert ended.err


def test_sarif_links_only_to_addresses(shell: Shell) -> None:
    shell.write("a.osc", "scenario top:\n  hero: vehicel\n")
    sarif = ("check", "a.osc", "--output-format", "sarif", "--docs-url")
    assert '"helpUri": "https://a.example/diagnostics/osc202.html"' in (
        shell(*sarif, "https://a.example").out
    )
    for address in ("javascript:alert(1)", "https://a\nb", "docs"):
        ended = shell(*sarif, address)
        assert ended.code == 2
        assert "not an address" in ended.err


ON_A_MAP = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "{map}.xodr")
    ego: vehicle
    do ego.drive(duration: 1s)
"""


def test_a_map_that_is_not_there(shell: Shell) -> None:
    """It is looked for beside the file, in the folders that are given, and among those shipped."""
    shell.write("a.osc", ON_A_MAP.format(map="highwy"))
    (shell.folder / "maps").mkdir()
    ended = shell("check", "--map-path", "maps", "a.osc")
    assert ended.code == 0
    assert "a.osc:7:29: warning[OSC443]: there is no map `highwy.xodr`" in ended.err
    assert "searched in the folder of the file, `maps`, the maps of the runtime" in ended.err
    assert "did you mean `highway.xodr`?" in ended.err
    for place in ("highwy.xodr", "maps/highwy.xodr"):
        path = shell.write(place, "")
        assert "OSC443" not in shell("check", "--map-path", "maps", "a.osc").err
        path.unlink()
    shell.write("a.osc", ON_A_MAP.format(map="highway"))
    assert "OSC443" not in shell("check", "a.osc").err


def test_both_values_of_a_set_are_named(shell: Shell) -> None:
    place = (
        "lane(1, at: start)\n        position(gap, at: start)\n        speed(gap / 1s, at: start)\n"
    )
    field = "    gap: length with:\n        keep(it in [12m, 40m])\n    do"
    text = ON_A_MAP.format(map="highway").replace("    do", field)
    shell.write("a.osc", text.replace("(duration: 1s)", f"(duration: 1s) with:\n        {place}"))
    assert "logical (open: gap in {12m, 40m})" in shell("check", "a.osc").out
