"""The wheel works in an environment of its own, away from the checkout."""

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

REPOSITORY = Path(__file__).parents[2]
SCENARIOS = REPOSITORY / "scenarios"


def run(*command: str | Path, folder: Path, **variables: str) -> str:
    kept = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    ended = subprocess.run(
        command, cwd=folder, env=kept | variables, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, f"{command}:\n{ended.stdout}{ended.stderr}"
    return ended.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "wheel", "--quiet"]
    if importlib.util.find_spec("hatchling") is not None:  # else pip fetches it
        pip.append("--no-build-isolation")
    run(*pip, "--no-deps", "--wheel-dir", folder, REPOSITORY, folder=folder)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the programs of an environment that has the wheel, and sees our dependencies."""
    environment = tmp_path_factory.mktemp("environment")
    run(sys.executable, "-m", "venv", "--without-pip", environment, folder=environment)
    programs = environment / ("Scripts" if os.name == "nt" else "bin")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    pip += ["--python", str(programs / "python"), "install", "--quiet", "--no-deps", "--no-index"]
    run(*pip, wheel, folder=environment)
    return programs


def in_environment(installed: Path, program: str, *arguments: str, folder: Path) -> str:
    # Folders of PYTHONPATH do not run `.pth` files: the checkout stays invisible.
    dependencies = sysconfig.get_path("purelib")
    return run(installed / program, *arguments, folder=folder, PYTHONPATH=dependencies)


def test_what_is_in_the_wheel(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    tops = {name.split("/")[0] for name in names if ".dist-info" not in name}
    assert tops == {"osc2tx", "osc2tx_runtime"}
    for needed in (
        "osc2tx/py.typed",
        "osc2tx/grammar/OpenSCENARIO2.g4",
        "osc2tx/stdlib/domain.osc",
        "osc2tx/diagnostics/texts/1xx.toml",
        "osc2tx_runtime/py.typed",
        "osc2tx_runtime/maps/highway.xodr",
        "osc2tx_runtime/report/report.html",
    ):
        assert needed in names
    assert any(name.startswith("osc2tx/templates/py_trees/") for name in names)
    assert not [name for name in names if "__pycache__" in name]


def test_the_environment_is_away_from_the_checkout(installed: Path, tmp_path: Path) -> None:
    program = "import osc2tx, osc2tx_runtime; print(osc2tx.__file__, osc2tx_runtime.__file__)"
    places = in_environment(installed, "python", "-c", program, folder=tmp_path).split()
    assert all(Path(place).is_relative_to(installed.parent) for place in places)


def test_our_scenarios_compile_import_and_run(installed: Path, tmp_path: Path) -> None:
    shutil.copytree(SCENARIOS, tmp_path / "scenarios")
    in_environment(installed, "osc2tx", "build", "scenarios", "-o", "out", folder=tmp_path)
    modules = sorted((tmp_path / "out").glob("*.py"))
    assert [path.stem for path in modules] == sorted(path.stem for path in SCENARIOS.glob("*.osc"))
    for module in modules:
        program = f"import {module.stem}; print({module.stem}.create_root().name)"
        assert in_environment(installed, "python", "-c", program, folder=tmp_path / "out").strip()
    source = str(Path("scenarios", "cut_in.osc"))
    assert "success" in in_environment(installed, "osc2tx", "run", source, folder=tmp_path)
    assert "success" in in_environment(installed, "python", "out/cut_in.py", folder=tmp_path)
