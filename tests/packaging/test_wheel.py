"""Both wheels work in environments of their own, away from the checkout and from any index."""

import importlib.metadata
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from collections.abc import Iterable, Iterator
from email.parser import Parser
from pathlib import Path

import pytest
from packaging.requirements import Requirement

pytestmark = pytest.mark.slow

REPOSITORY = Path(__file__).parents[2]
SCENARIOS = REPOSITORY / "scenarios"
PIP = (sys.executable, "-m", "pip", "--disable-pip-version-check")


def run(*command: str | Path, folder: Path) -> str:
    variables = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    ended = subprocess.run(
        command, cwd=folder, env=variables, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, f"{command}:\n{ended.stdout}{ended.stderr}"
    return ended.stdout


# --- Wheels ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the wheels of both distributions."""
    folder = tmp_path_factory.mktemp("wheels")
    options = ["--quiet", "--no-deps", "--wheel-dir", str(folder)]
    if importlib.util.find_spec("hatchling") is not None:  # else pip fetches it
        options.append("--no-build-isolation")
    run(*PIP, "wheel", *options, REPOSITORY / "runtime_lib", REPOSITORY, folder=folder)
    return folder


def wheel_of(wheels: Path, name: str) -> zipfile.ZipFile:
    (path,) = wheels.glob(f"{name}-*.whl")
    return zipfile.ZipFile(path)


def requirements_of(wheels: Path, name: str) -> list[str]:
    wheel = wheel_of(wheels, name)
    (path,) = (path for path in wheel.namelist() if path.endswith(".dist-info/METADATA"))
    return Parser().parsestr(wheel.read(path).decode()).get_all("Requires-Dist") or []


# --- Environments ---------------------------------------------------------------------------------


def distributions(requirements: Iterable[str]) -> Iterator[importlib.metadata.Distribution]:
    """Yield what is installed here of some requirements, and all that it requires in turn."""
    for text in requirements:
        requirement = Requirement(text)
        if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
            found = importlib.metadata.distribution(requirement.name)
            yield found
            yield from distributions(found.requires or ())


def environment_with(folder: Path, wheels: Path, *names: str) -> Path:
    """Make an environment of some of our wheels and what they require, and of nothing else.

    Packages of others are links to those installed here; pip finds them there and resolves the
    requirements of our wheels with them.

    Returns:
        The folder of its programs.
    """
    run(sys.executable, "-m", "venv", "--without-pip", folder, folder=folder)
    paths = sysconfig.get_paths("venv", vars={"base": str(folder), "platbase": str(folder)})
    others = [text for name in names for text in requirements_of(wheels, name)]
    for found in distributions(text for text in others if not text.startswith("osc2tx")):
        for top in {path.parts[0] for path in found.files or ()} - {"..", "__pycache__"}:
            link = Path(paths["purelib"], top)
            if not link.is_symlink():
                link.symlink_to(Path(str(found.locate_file(top))))
    programs = Path(paths["scripts"])
    pip = [*PIP, "--python", str(programs / "python")]
    chosen = names[-1].replace("_", "-")
    run(*pip, "install", "--quiet", "--no-index", "--find-links", wheels, chosen, folder=folder)
    run(*pip, "check", folder=folder)
    return programs


@pytest.fixture(scope="module")
def runtime_only(wheels: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return environment_with(tmp_path_factory.mktemp("runtime"), wheels, "osc2tx_runtime")


@pytest.fixture(scope="module")
def both(wheels: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("both")
    return environment_with(folder, wheels, "osc2tx_runtime", "osc2tx")


# --- What is in them ------------------------------------------------------------------------------


def contents(wheel: zipfile.ZipFile) -> set[str]:
    return {name for name in wheel.namelist() if ".dist-info" not in name}


def files_of(package: Path) -> set[str]:
    """Return the files of a package in the checkout, relative to the folder around it."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", package.name]
    return set(run(*command, folder=package.parent).split())


def test_the_wheel_of_the_runtime_holds_its_packages(wheels: Path) -> None:
    held = contents(wheel_of(wheels, "osc2tx_runtime"))
    packages = ("osc2tx_runtime", "osc2tx_shared")
    assert held == set[str]().union(*(files_of(REPOSITORY / "runtime_lib" / n) for n in packages))
    kinds = {Path(name).suffix for name in held if Path(name).name != "LICENSE"}
    assert kinds == {".py", ".typed", ".xodr", ".js", ".css", ".html"}


def test_the_wheel_of_the_compiler_holds_its_package_and_its_data(wheels: Path) -> None:
    data = files_of(REPOSITORY / "templates") | files_of(REPOSITORY / "grammar")
    schemas = {
        f"osc2tx/schemas/{path.name}" for path in (REPOSITORY / "docs").glob("*.schema.json")
    }
    expected = files_of(REPOSITORY / "osc2tx") | {f"osc2tx/{name}" for name in data} | schemas
    assert contents(wheel_of(wheels, "osc2tx")) == expected


def test_what_the_runtime_requires(wheels: Path) -> None:
    required = [Requirement(text) for text in requirements_of(wheels, "osc2tx_runtime")]
    always = {each.name for each in required if "extra" not in str(each.marker)}
    assert always == {"py-trees", "numpy", "lxml"}


# --- What they do ---------------------------------------------------------------------------------

OF_THE_COMPILER = ("osc2tx", "antlr4", "jinja2", "black", "pint", "click", "rich")
CODE = re.compile(r"```\w+\n(.*?)```", re.DOTALL)
# What imports the library of a simulator runs in a process of its own, with an extra of the wheel.
IMPORT_ALL = """
import importlib, importlib.util, pkgutil, sys, osc2tx_runtime
for found in pkgutil.walk_packages(osc2tx_runtime.__path__, "osc2tx_runtime."):
    if not found.name.startswith("osc2tx_runtime.simulators.carla.client."):
        importlib.import_module(found.name)
print(osc2tx_runtime.__file__)
print(*[name for name in sys.argv[1:] if importlib.util.find_spec(name) is not None])
"""


def test_the_runtime_is_whole_without_the_compiler(runtime_only: Path, tmp_path: Path) -> None:
    program = runtime_only / "python"
    found = run(program, "-c", IMPORT_ALL, *OF_THE_COMPILER, folder=tmp_path).splitlines()
    assert Path(found[0]).is_relative_to(runtime_only.parent)
    assert found[1] == ""


def test_the_readme_of_the_runtime_holds_there(runtime_only: Path, tmp_path: Path) -> None:
    shutil.copy(REPOSITORY / "generated" / "cut_in.py", tmp_path)
    console, program = CODE.findall((REPOSITORY / "runtime_lib" / "README.md").read_text())
    command, said = console.split("$ ")[2].split("\n", 1)
    assert run(runtime_only / "python", *command.split()[1:], folder=tmp_path) == said
    assert "<svg" in (tmp_path / "cut_in.html").read_text(encoding="utf-8")
    run(sys.executable, tmp_path / "cut_in.py", "--trace", "here.jsonl", folder=tmp_path)
    assert (tmp_path / "cut_in.jsonl").read_bytes() == (tmp_path / "here.jsonl").read_bytes()
    assert run(runtime_only / "python", "-c", program, folder=tmp_path).startswith("success ")


def test_the_compiler_is_away_from_the_checkout(both: Path, tmp_path: Path) -> None:
    program = "import osc2tx, osc2tx_runtime; print(osc2tx.__file__, osc2tx_runtime.__file__)"
    places = run(both / "python", "-c", program, folder=tmp_path).split()
    assert all(Path(place).is_relative_to(both.parent) for place in places)


def test_our_scenarios_compile_import_and_run(both: Path, tmp_path: Path) -> None:
    shutil.copytree(SCENARIOS, tmp_path / "scenarios")
    run(both / "osc2tx", "build", "scenarios", "-o", "out", folder=tmp_path)
    modules = sorted((tmp_path / "out").glob("*.py"))
    assert [path.stem for path in modules] == sorted(path.stem for path in SCENARIOS.glob("*.osc"))
    for module in modules:
        program = f"import {module.stem}; print({module.stem}.create_root().name)"
        assert run(both / "python", "-c", program, folder=tmp_path / "out").strip()
    source = Path("scenarios", "cut_in.osc")
    assert "success" in run(both / "osc2tx", "run", source, folder=tmp_path)
    assert "success" in run(both / "python", "out/cut_in.py", folder=tmp_path)
