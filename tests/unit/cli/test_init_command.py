"""`osc2tx init`: a project that works as it is."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from osc2tx.cli import cli
from osc2tx.cli.init import FILES
from osc2tx.cli.reporting import Session
from tests.processes import forked

REPOSITORY = Path(__file__).parents[3]


def command(*words: str | Path) -> Result:
    arguments = list(map(str, words))
    return CliRunner().invoke(cli, arguments, standalone_mode=False, obj=Session())


@pytest.mark.parametrize("std", ["2.1", "2.2"])
def test_the_project_builds_runs_and_passes_its_test(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, std: str
) -> None:
    assert command("init", tmp_path / "project", "--std", std).return_value == 0
    monkeypatch.chdir(tmp_path / "project")
    assert command("fmt", "--check", "scenarios").return_value == 0
    assert command("check", "scenarios", "--strict").return_value == 0
    assert command("build").return_value == 0
    assert command("build", "--check").return_value == 0
    assert f'std = "{std}" ' in command("config").output
    ended = forked(lambda: sys.exit(pytest.main(["-q", "-p", "no:cacheprovider"])))
    assert ended.code == 0, ended.out
    assert "passed" in ended.out


def test_files_of_the_user_stay(tmp_path: Path) -> None:
    (tmp_path / "osc2tx.toml").write_text("# mine\n")
    result = command("init", tmp_path)
    assert result.return_value == 0
    assert "osc2tx.toml: exists, unchanged" in result.output
    assert (tmp_path / "osc2tx.toml").read_text() == "# mine\n"
    assert all((tmp_path / name).is_file() for name in FILES)


def test_commands_in_the_snippets_exist(tmp_path: Path) -> None:
    """Every `osc2tx …` in the hook file and the workflow is a command with these options."""
    command("init", tmp_path)
    lines = [
        line.partition("osc2tx ")[2]
        for name in (".pre-commit-config.yaml", ".github/workflows/scenarios.yml")
        for line in (tmp_path / name).read_text().splitlines()
        if "entry: osc2tx " in line or "run: osc2tx " in line
    ]
    lines += [
        line.partition("osc2tx ")[2]
        for line in (REPOSITORY / ".pre-commit-hooks.yaml").read_text().splitlines()
        if "entry: osc2tx " in line
    ]
    assert len(lines) == 9
    for line in lines:
        name, *options = line.split()
        found = cli.get_command(cli.make_context("osc2tx", ["check"]), name)
        assert found is not None
        known = {option for parameter in found.params for option in parameter.opts}
        assert {option for option in options if option.startswith("--")} <= known


def test_settings_are_those_of_the_reference(tmp_path: Path) -> None:
    command("init", tmp_path)
    settings = tomllib.loads((tmp_path / "osc2tx.toml").read_text())
    assert settings == {"sources": ["scenarios"], "out": "generated", "std": "2.1"}
