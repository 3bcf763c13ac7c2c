"""The committed modules: fresh, clean by every tool, and running by themselves."""

import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from py_trees.display import ascii_tree

from osc2tx.testing import assert_build_fresh
from tests.end_to_end.harness import REPOSITORY, SCENARIOS, generate
from tests.processes import forked

GENERATED = REPOSITORY / "generated"
MODULES = sorted(GENERATED.glob("*.py"))
OWN_MAPS = [path for path in MODULES if path.stem != "hello_world"]


def tool(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=REPOSITORY
    )


def test_there_is_a_module_for_each_scenario() -> None:
    assert {path.stem for path in MODULES} == {path.stem for path in SCENARIOS.glob("*.osc")}


def test_they_are_what_the_compiler_makes() -> None:
    assert_build_fresh(REPOSITORY / "scenarios", REPOSITORY / "generated")


def test_black_leaves_them_alone() -> None:
    result = tool("black", "--check", "--line-length", "100", *map(str, MODULES))
    assert result.returncode == 0, result.stderr


def test_ruff_has_nothing_to_say_with_its_own_defaults() -> None:
    result = tool("ruff", "check", "--isolated", "--line-length", "100", *map(str, MODULES))
    assert result.returncode == 0, result.stdout


@pytest.mark.slow
@pytest.mark.parametrize("module", OWN_MAPS, ids=lambda path: path.stem)
def test_they_run_by_themselves(module: Path, tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    report = tmp_path / "report.html"
    place = shutil.copy(module, tmp_path)  # its map is not committed
    source_map = generate(SCENARIOS / f"{module.stem}.osc").source_map
    Path(place).with_suffix(".map.json").write_text(source_map, encoding="utf-8")
    result = subprocess.run(
        [sys.executable, place, "--trace", str(trace), "--report", str(report)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert result.returncode == 0, result.stderr
    assert f"{module.stem}: success" in result.stdout
    assert f'"source":"{module.stem}.osc:' in trace.read_text(encoding="utf-8")
    assert report.stat().st_size > 10_000


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.stem)
def test_viewers_get_a_tree(module: Path) -> None:
    """As with `py-trees-render`; in a copy of this process, as the module stays loaded."""
    ended = forked(
        lambda: print(ascii_tree(runpy.run_path(str(module))["create_root"]())),
        folder=module.parent,
    )
    assert ended.code == 0, ended.err
    assert module.stem in ended.out
