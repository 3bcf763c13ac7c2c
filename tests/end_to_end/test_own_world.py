"""The world of docs/extending.md, in a package of its own, found by its entry point."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx_runtime import Scenario, main
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.running.options import read_options
from osc2tx_runtime.worlds import find_world
from tests.end_to_end.harness import REPOSITORY, SCENARIOS, generate
from tests.unit.cli.shell import Shell

PAGE = REPOSITORY / "docs/extending.md"
FILE = SCENARIOS / "cut_in.osc"
Printed = pytest.CaptureFixture[str]


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The package of the page, installed in a folder."""
    page = PAGE.read_text(encoding="utf-8").partition("# Own worlds")[2]
    (text,) = re.findall(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    (entry,) = re.findall(r'^\[project\.entry-points\."(.*?)"\]\n(.*?)^```$', page, re.M | re.S)
    folder = tmp_path / "site"
    info = folder / "my_world-1.0.dist-info"
    info.mkdir(parents=True)
    (folder / "my_world.py").write_text(text)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: my-world\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[{entry[0]}]\n{entry[1].replace(chr(34), '')}")
    monkeypatch.syspath_prepend(folder)
    monkeypatch.delitem(sys.modules, "my_world", raising=False)
    return folder


@pytest.fixture
def cut_in(load: Callable[[GeneratedModule], type[Scenario]]) -> type[Scenario]:
    return load(generate(FILE))


def run(made: type[Scenario], trace: Path, *options: str) -> tuple[int, list[dict[str, Any]]]:
    """Run a module as `python cut_in.py` does."""
    code = main(made, argv=["--trace", str(trace), *options])
    return code, [json.loads(line) for line in trace.read_text().splitlines()]


def actions(lines: Sequence[dict[str, Any]]) -> list[tuple[str, str, float]]:
    return [(e["name"], e["status"], e["t"]) for e in lines if e["kind"] == "action"]


def test_it_is_about_sixty_lines() -> None:
    page = PAGE.read_text(encoding="utf-8").partition("# Own worlds")[2]
    (text,) = re.findall(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert len([line for line in text.splitlines() if line.strip()]) <= 65


def test_a_module_runs_in_it(
    package: Path, cut_in: type[Scenario], tmp_path: Path, capsys: Printed
) -> None:
    """The same actions in the same order, a little later."""
    _, exact = run(cut_in, tmp_path / "exact.jsonl")
    code, driven = run(cut_in, tmp_path / "driven.jsonl", "--world", "sluggish", "--lag", "0.1")
    assert code == 0
    assert capsys.readouterr().out.splitlines()[-2:] == [
        "the simulator is free again",
        "cut_in: success after 21.55 s",
    ]
    assert driven[0]["world"] == "sluggish 1.0"
    assert set(driven[0]["control"].values()) == {"driven"}
    before, after = actions(exact), actions(driven)
    assert [a[:2] for a in after] == [a[:2] for a in before]
    assert all(abs(a[2] - b[2]) <= 0.2 for a, b in zip(after, before, strict=True))
    states = [[e for e in lines if e["kind"] == "state"] for lines in (exact, driven)]
    assert any(abs(a["v"] - b["v"]) > 0.02 for a, b in zip(*states, strict=False))


def test_the_command_line_knows_its_options(package: Path, shell: Shell) -> None:
    assert "--lag SECONDS" in shell("run", "--world", "sluggish", "--help").out
    assert "--lag" not in shell("run", "--help").out
    shell.drive("a.osc")
    (shell.folder / "osc2tx.toml").write_text('[scenarios.a.run]\nworld = "sluggish"\nlag = 0.3\n')
    for more in ((), ("--lag", "0.4")):
        ended = shell("run", "a.osc", *more)
        assert ended.code == 0, ended.err
        assert "the simulator is free again" in ended.out


def test_a_settings_file_may_not_say_anything(package: Path, shell: Shell) -> None:
    shell.drive("a.osc")
    (shell.folder / "osc2tx.toml").write_text('[scenarios.a.run]\nworld = "sluggish"\nleg = 0.3\n')
    ended = shell("run", "a.osc")
    assert ended.code == 2
    assert "in [scenarios.a.run]: unknown option --leg" in ended.err


def test_a_world_that_nobody_has(cut_in: type[Scenario], capsys: Printed) -> None:
    assert main(cut_in, argv=["--world", "nowhere"]) == 2
    assert capsys.readouterr().err.startswith(
        "error: --world nowhere: there is no such world; available: "
    )


def test_a_package_that_does_not_load(package: Path) -> None:
    (package / "my_world.py").write_text("import no_such_module\n")
    with pytest.raises(
        SettingsError, match="my_world:WORLD: ModuleNotFoundError: No module named 'no_such_module'"
    ):
        find_world("sluggish")
    (package / "my_world.py").write_text("WORLD = 1\n")
    sys.modules.pop("my_world", None)
    with pytest.raises(SettingsError, match="my_world:WORLD is not a WorldType"):
        find_world("sluggish")


def test_options_of_another_world_are_unknown(package: Path) -> None:
    with pytest.raises(SettingsError, match="unknown option --lag"):
        read_options({"lag": "1"})
    assert read_options({"world": "sluggish", "lag": "1"}).world_options == {"lag": 1.0}


# --- a simulator that is lost ---------------------------------------------------------------------

LOST = """
from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.world import FEATURES, EmbeddedWorld
from osc2tx_runtime.worlds import WorldType


class Dying:
    name = "dying 1.0"

    def control(self, actor):
        return "exact"

    def capabilities(self):
        return FEATURES

    def shape(self, spec):
        return None

    def begin(self, scene):
        return {}

    def moved(self, scene):
        if scene.step == 10:
            raise SimulatorError("the simulator does not answer any more")
        return {}

    def close(self):
        print("left")


def make(request):
    if request.seed:
        raise SimulatorError("there is no simulator at localhost:1")
    return EmbeddedWorld(request.road_map(), request.dt, Dying())


WORLD = WorldType("sluggish", make)
"""


def test_one_that_dies_ends_the_run_with_4_and_the_trace_up_to_there(
    package: Path, cut_in: type[Scenario], tmp_path: Path, capsys: Printed
) -> None:
    (package / "my_world.py").write_text(LOST)
    code, lines = run(cut_in, tmp_path / "t.jsonl", "--world", "sluggish")
    printed = capsys.readouterr()
    assert code == 4
    assert printed.out == "left\n"
    assert "error[OSC808]: the simulator does not answer any more (at 0.500 s)" in printed.err
    assert max(line.get("t", 0.0) for line in lines) == 0.5
    assert (lines[-1]["kind"], lines[-1]["status"]) == ("result", "error")


def test_one_that_is_not_there_ends_it_with_4(package: Path, shell: Shell) -> None:
    (package / "my_world.py").write_text(LOST)
    shell.drive("a.osc")
    ended = shell("run", "a.osc", "--world", "sluggish", "--seed", "1")
    assert ended.code == 4
    assert ended.err == "a.osc: error[OSC808]: there is no simulator at localhost:1\n"
