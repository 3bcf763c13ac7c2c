"""The command `run`: sources, modules, settings, verdicts."""

import json
import runpy
import sys
from pathlib import Path

import click
import pytest
from click.shell_completion import ShellComplete

from osc2tx.cli import cli
from osc2tx.cli.reporting import Session
from osc2tx.cli.run import choose_scenario, merge_settings
from osc2tx.config import ConfigError, ConfigFiles
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.errors import SettingsError
from osc2tx_shared.map_files import SHIPPED
from tests.processes import forked
from tests.unit.cli.shell import Shell

ON_ITS_OWN_MAP = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "own.xodr")
    ego: vehicle
    do ego.drive(duration: 1s) with:
        speed(10mps)
"""


def test_run_of_a_source_leaves_nothing_behind(shell: Shell) -> None:
    shell.drive("a.osc")
    before = set(sys.modules)
    ended = shell("run", "a.osc", "--trace", "t.jsonl", "--max-time", "10s")
    assert ended.code == 0, ended.err
    assert ended.out.startswith("top: success after 2.00 s")
    assert {name for name in set(sys.modules) - before if "osc2tx:" in name} == set()
    lines = [json.loads(line) for line in (shell.folder / "t.jsonl").read_text().splitlines()]
    actions = [line for line in lines if line["kind"] == "action"]
    assert {line["source"] for line in actions} == {"a.osc:6"}
    assert sorted(path.name for path in shell.folder.iterdir()) == ["a.osc", "t.jsonl"]


def test_run_of_a_module(shell: Shell) -> None:
    shell.drive("a.osc")
    shell("build", "a.osc", "-o", "out")
    ended = shell("run", "out/a.py", "--trace", "t.jsonl")
    assert ended.code == 0, ended.err
    assert '"a.osc:6"' in (shell.folder / "t.jsonl").read_text()


def test_a_scenario_that_does_not_end_in_time_failed(shell: Shell) -> None:
    shell.drive("a.osc")
    ended = shell("run", "a.osc", "--max-time", "1")
    assert ended.code == 5
    assert ended.out.startswith("a.osc:6:5: error[OSC809]: top: timeout after 1.00 s")


def test_run_stops_at_errors_in_the_source(shell: Shell) -> None:
    shell.write("a.osc", "scenario top:\n  x: nothing\n")
    ended = shell("run", "a.osc")
    assert (ended.code, ended.out) == (3, "")
    assert "a.osc:2:6: error[OSC202]" in ended.err


def test_run_takes_settings_of_the_file(shell: Shell) -> None:
    shell.drive("a.osc")
    shell.write("osc2tx.toml", "[scenarios.a.run]\nmax-time = 1\n")
    assert shell("run", "a.osc").code == 5
    assert shell("run", "a.osc", "--max-time", "5").code == 0


@pytest.mark.parametrize(
    ("name", "text", "code"),
    [
        ("library.osc", "enum color: [red]\n", 2),
        ("empty.py", "", 2),
        ("broken.py", "def\n", 4),
        ("binary.py", "\0", 4),
        ("strange.py", "import a_module_that_is_not_there\n", 4),
        ("text.txt", "hello\n", 3),
    ],
)
def test_run_of_what_cannot_run(shell: Shell, name: str, text: str, code: int) -> None:
    shell.write(name, text)
    ended = shell("run", name)
    assert ended.code == code, ended.err
    assert name in ended.err


def test_run_of_a_folder(shell: Shell) -> None:
    assert shell("run", ".").code == 4
    assert shell("run", "no.osc").code == 4


@pytest.mark.parametrize("command", [("run",), ("campaign", "run", "--samples", "1")])
def test_a_map_in_a_folder_that_is_given(shell: Shell, command: tuple[str, ...]) -> None:
    """The compiler looks for it where the run does."""
    shell.write("maps/own.xodr", (SHIPPED / "highway.xodr").read_text(encoding="utf-8"))
    shell.write("own.osc", ON_ITS_OWN_MAP)
    ended = shell(*command, "own.osc", "--map-path", "maps")
    assert ended.code == 0, ended.err
    assert "OSC443" not in ended.err
    missing = shell(*command, "own.osc").err
    assert "OSC443" in missing
    assert "searched in the folder of the file, the maps of the runtime" in missing


def test_unknown_map_folder(shell: Shell) -> None:
    shell.drive("a.osc")
    ended = shell("run", "a.osc", "--map-path", "nowhere")
    assert ended.code == 4
    assert "nowhere" in ended.err


def scenarios(*names: str) -> dict[str, type[Scenario]]:
    return {name: type(name, (Scenario,), {"name": name}) for name in names}


def test_which_scenario_runs() -> None:
    path = Path("a.osc")
    assert choose_scenario(scenarios("a", "main", "top"), None, path).name == "top"
    assert choose_scenario(scenarios("a", "main"), None, path).name == "main"
    assert choose_scenario(scenarios("a"), None, path).name == "a"
    assert choose_scenario(scenarios("a", "top"), "a", path).name == "a"
    several = scenarios("a", "b", "c")
    several["b"].is_main = True
    assert choose_scenario(several, None, path).name == "b"
    with pytest.raises(click.UsageError, match="choose one with --scenario: a, b"):
        choose_scenario(scenarios("a", "b"), None, path)
    with pytest.raises(click.UsageError, match="no scenario `c`; available: a, b"):
        choose_scenario(scenarios("a", "b"), "c", path)


def test_command_line_beats_settings_item_by_item(tmp_path: Path) -> None:
    (tmp_path / "osc2tx.toml").write_text(
        '[scenarios.a.run]\nmap-path = ["maps"]\nseed = 1\ndt = 0.1\n'
        'spawn = ["hero=1,-1,5", "npc=1,-2,5"]\n'
    )
    source = tmp_path / "a.osc"
    config = ConfigFiles().for_source(source)
    given = {"seed": "2", "spawn": ("hero=9,-1,7",), "map_path": ("mine",), "signal": ()}
    assert merge_settings(config, source, given) == RunSettings(
        map_path=(Path("mine"), tmp_path / "maps", tmp_path),
        spawn={"hero": ("9", -1, 7.0), "npc": ("1", -2, 5.0)},
        seed=2,
        dt=0.1,
    )


def test_whose_mistake_a_wrong_run_option_is(tmp_path: Path) -> None:
    (tmp_path / "osc2tx.toml").write_text('[scenarios.a.run]\nsignal = ["go"]\n')
    config = ConfigFiles().for_source(tmp_path / "a.osc")
    with pytest.raises(ConfigError, match=r"osc2tx.toml: in \[scenarios.a.run\]: --signal go"):
        merge_settings(config, tmp_path / "a.osc", {})
    with pytest.raises(SettingsError):
        merge_settings(config, tmp_path / "b.osc", {"signal": ("go",)})


INVOKING = """import osc.standard

scenario vehicle.cruise:
  v: speed = 36kph
  do drive(duration: 1s) with:
    speed(v)

scenario two:
  ego: vehicle
  do cruise_it: ego.cruise()
"""


def test_the_one_that_no_other_invokes_runs_everywhere(shell: Shell) -> None:
    """By `run` of source and module, and by the module itself; values in any unit."""
    source = shell.write("two.osc", INVOKING)
    assert shell("build", source, "-o", shell.folder / "out").code == 0
    module = shell.folder / "out" / "two.py"
    for file in (source, module):
        ended = shell("run", file, "--set", "cruise_it.v=20mph")
        assert (ended.code, ended.out) == (0, "two: success after 1.00 s\n")
    wrong = shell("run", source, "--set", "cruise_it.v=20m")
    assert wrong.code == 2 and f"{source}:4:3: error[OSC806]" in wrong.err
    assert "m is a unit of length" in wrong.err

    def script() -> None:
        sys.argv = [str(module), "--set", "cruise_it.v=20mph"]
        runpy.run_path(str(module), run_name="__main__")

    own = forked(script)
    assert own.code == 0, own.out


def test_the_scenarios_of_a_file_are_offered(shell: Shell) -> None:
    source = shell.write("two.osc", INVOKING)
    assert shell("build", source, "-o", shell.folder / "out").code == 0
    complete = ShellComplete(cli, {"obj": Session()}, "osc2tx", "_OSC2TX_COMPLETE")
    for file in (source, shell.folder / "out" / "two.py"):
        for command in ("run", "tree"):
            found = complete.get_completions([command, str(file), "--scenario"], "")
            assert [each.value for each in found] == ["vehicle.cruise", "two"]
    found = complete.get_completions(["run", str(source), "--scenario"], "t")
    assert [each.value for each in found] == ["two"]
    assert complete.get_completions(["run", "nowhere.osc", "--scenario"], "") == []


def test_a_scenario_that_says_it_failed_says_where(shell: Shell) -> None:
    text = "import osc.standard\n\nscenario vehicle.inner:\n  do serial:\n    emit fail\n\n"
    shell.write("a.osc", f"{text}scenario top:\n  ego: vehicle\n  do serial:\n    ego.inner()\n")
    ended = shell("run", "a.osc")
    assert ended.out.startswith("a.osc:5:5: error[OSC809]: top: failure after 0.00 s: inner")
