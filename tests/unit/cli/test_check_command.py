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


def test_check_shows_errors_where_the_reader_is(shell: Shell) -> None:
    shell.write("sub/a.osc", "scenario top:\n  hero: vehicel\n")
    shell.drive("sub/b.osc")
    ended = shell("check", "sub")
    assert ended.code == 3
    assert ended.out == f"b.osc: {LEVEL}\nchecked 2 files: 1 error, 0 warnings\n"
    assert ended.err.startswith("sub/a.osc:2:9: error[OSC202]: ")
    assert ended.err.endswith("\n\n`osc2tx explain OSC202` says more about a code.\n")


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
        assert "no address" in ended.err
