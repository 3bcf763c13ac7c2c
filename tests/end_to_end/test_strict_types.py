"""What is generated passes `mypy --strict`: a project, the scenarios and the public scenarios."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from osc2tx.building.build import build
from osc2tx.config import GivenOptions
from tests.corpus.report import compilation_of, manifest
from tests.end_to_end.harness import REPOSITORY
from tests.end_to_end.projects import write_project
from tests.processes import HANGING

pytestmark = pytest.mark.slow


def errors_in(folder: Path, cache: Path, *options: str) -> str:
    """Return what mypy finds in the modules below a folder."""
    done = subprocess.run(
        [
            *(sys.executable, "-m", "mypy", "--strict", "--no-error-summary"),
            *("--explicit-package-bases", "--cache-dir", str(cache), *options, "."),
        ],
        capture_output=True,
        text=True,
        timeout=HANGING,
        cwd=folder,
        env={**os.environ, "MYPYPATH": str(REPOSITORY / "runtime_lib")},
    )
    return done.stdout + done.stderr


def test_a_project_of_a_hundred_scenarios(tmp_path: Path) -> None:
    report = build(
        [write_project(tmp_path, 100)], tmp_path / "generated", GivenOptions(target="py")
    )
    assert len(list((tmp_path / "generated").rglob("pass_*.py"))) == 100, report
    assert errors_in(tmp_path / "generated", tmp_path / "cache") == ""


def test_a_repository_of_a_hundred_scenarios(test_data: Path, tmp_path: Path) -> None:
    """Eight families in 32 folders with libraries beside them and on an import path."""
    maker = test_data / "project" / "make_repository.py"
    subprocess.run([sys.executable, str(maker), str(tmp_path / "made"), "100"], check=True)
    settings = 'sources = ["scenarios"]\nimport_paths = ["shared"]\nmap_paths = ["maps"]\n'
    (tmp_path / "made" / "osc2tx.toml").write_text(settings, encoding="utf-8")
    generated = tmp_path / "made" / "generated"
    build([tmp_path / "made" / "scenarios"], generated, GivenOptions(target="py"))
    assert len(list(generated.rglob("*.py"))) >= 100
    assert errors_in(generated, tmp_path / "cache") == ""


def test_the_scenarios_of_the_repository(tmp_path: Path) -> None:
    assert errors_in(REPOSITORY / "generated", tmp_path, "--warn-unreachable") == ""


def test_the_golden_modules(tmp_path: Path) -> None:
    assert errors_in(REPOSITORY / "tests" / "golden" / "py_trees", tmp_path) == ""


def test_the_public_scenarios(test_data: Path, tmp_path: Path) -> None:
    count = 0
    for number, row in enumerate(manifest(test_data / "corpus")):
        module = compilation_of(test_data / "corpus", row).module
        if module is not None:
            folder = tmp_path / f"module_{number}"
            folder.mkdir()
            (folder / f"{module.stem}.py").write_text(module.python, encoding="utf-8")
            count += 1
    assert count > 100
    assert errors_in(tmp_path, tmp_path / "cache") == ""
