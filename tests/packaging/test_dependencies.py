"""The page of dependencies says what both distributions require, and their versions are one."""

import re
import tomllib
from pathlib import Path
from typing import Any

import osc2tx

REPOSITORY = Path(__file__).parents[2]
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")


def distribution(folder: str) -> dict[str, Any]:
    return tomllib.loads((REPOSITORY / folder / "pyproject.toml").read_text(encoding="utf-8"))


COMPILER, RUNTIME = distribution("."), distribution("runtime_lib")


def test_every_dependency_has_its_reason() -> None:
    required: set[str] = set()
    for settings in (COMPILER, RUNTIME):
        requirements = [*settings["build-system"]["requires"], *settings["project"]["dependencies"]]
        hooks = (
            settings["tool"]["hatch"]["build"].get("targets", {}).get("wheel", {}).get("hooks", {})
        )
        for hook in hooks.values():
            requirements += hook["dependencies"]
        for extra in settings["project"]["optional-dependencies"].values():
            requirements += extra
        required |= {found[0] for text in requirements if (found := NAME.match(text))}
    page = (REPOSITORY / "docs" / "dependencies.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"^\| `([^`]+)`", page, re.MULTILINE))
    assert documented == required


def test_the_compiler_requires_the_runtime_of_its_own_version() -> None:
    assert RUNTIME["project"]["version"] == osc2tx.__version__
    assert f"osc2tx-runtime=={osc2tx.__version__}" in COMPILER["project"]["dependencies"]


def test_what_both_state_is_stated_alike() -> None:
    assert COMPILER["build-system"] == RUNTIME["build-system"]
    assert COMPILER["project"]["requires-python"] == RUNTIME["project"]["requires-python"]
    (lxml,) = (text for text in RUNTIME["project"]["dependencies"] if text.startswith("lxml"))
    assert lxml in COMPILER["project"]["dependencies"]
