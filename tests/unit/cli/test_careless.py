"""Wrong paths, settings and files: each message names the file and the way out."""

from __future__ import annotations

import pytest

from tests.unit.cli.shell import Shell


@pytest.fixture(autouse=True)
def there(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(shell.folder)
    shell.drive("scenarios/a.osc")


@pytest.mark.parametrize(
    ("settings", "arguments", "code", "message"),
    [
        (
            'sources = ["scnarios"]',
            "check",
            2,
            "osc2tx.toml: `sources`: there is no file or folder",
        ),
        ('map_paths = ["maps"]', "run scenarios/a.osc", 4, "`map_paths` of the settings"),
        (
            '[scenarios.a.campaign]\nsamples = "many"',
            "campaign run scenarios/a.osc",
            2,
            "osc2tx.toml: Invalid value for '--samples': 'many'",
        ),
        ("", "campaign run scenarios/a.osc --samples many", 2, "Usage: osc2tx campaign run"),
        ("", "config scenaros", 4, "scenaros: no such file or folder"),
        ("", "report scenarios/a.osc", 4, "trace scenarios/a.osc cannot be read: no header"),
        ("", "verify scenarios/a.osc scenarios/a.osc", 4, "cannot be read: no JSON Lines"),
        ("", "build scenarios -o osc2tx.toml", 2, "`-o osc2tx.toml`: is a file"),
        ("", "run scenarios/a.osc --ego ego=drivers:Mine", 2, "name its folder, PYTHONPATH=FOLDER"),
    ],
)
def test_mistakes(shell: Shell, settings: str, arguments: str, code: int, message: str) -> None:
    shell.write("osc2tx.toml", settings + "\n")
    ended = shell(*arguments.split())
    assert (ended.code, message in ended.err + ended.out) == (code, True), ended
    assert not (shell.folder / "scenarios" / "a.html").exists()


def test_settings_with_a_byte_order_mark(shell: Shell) -> None:
    """As some editors of Windows save them."""
    shell.write("osc2tx.toml", '\ufeffsources = ["scenarios"]\n')
    assert shell("check").code == 0


def test_a_folder_is_no_map(shell: Shell) -> None:
    shell.write("maps/town.xodr/readme", "")
    assert "town.xodr" not in shell("map", "--map-path", "maps").out
    shell.write("maps/bad.xodr", "<OpenDRIVE><road")
    ended = shell("map", "bad", "--map-path", "maps")
    assert "bad.xodr:1: is not well-formed XML (" in ended.err
    assert "<string>" not in ended.err
