"""The documentation shows only what was run, and what is made from code is up to date."""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

REPOSITORY = Path(__file__).parents[2]
TUTORIAL = REPOSITORY / "docs" / "tutorial.md"
CAMPAIGNS = REPOSITORY / "docs" / "how-to" / "campaigns.md"
ALKS = REPOSITORY / "docs" / "how-to" / "import-alks.md"
_BLOCK = re.compile(r"^```console\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_FILE = re.compile(r"^```python\n# (\w+\.py)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_SECONDS = re.compile(r"in \d+\.\d+s\b")


@pytest.mark.slow
@pytest.mark.parametrize("page", [TUTORIAL, CAMPAIGNS], ids=lambda page: page.stem)
def test_commands_of_pages(page: Path, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    """Every command of a page prints what stands there, one after the other."""
    text = page.read_text(encoding="utf-8")
    shell = Shell(tmp_path)
    if page is CAMPAIGNS:  # its reader has a project already
        shutil.copytree(REPOSITORY / "scenarios", tmp_path / "scenarios")
    check_page(page, text, shell, request)


@pytest.mark.slow
def test_commands_of_the_tutorial_with_public_documents(
    tmp_path: Path, test_data: Path, request: pytest.FixtureRequest
) -> None:
    """Likewise; its reader has cloned the documents, and written the files of the page."""
    text = ALKS.read_text(encoding="utf-8")
    shutil.copytree(test_data / "xosc" / "alks", tmp_path / "sl-3-1-osc-alks-scenarios")
    for name, content in _FILE.findall(text):
        (tmp_path / name).write_text(content, encoding="utf-8")
    check_page(ALKS, text, Shell(tmp_path), request)


def check_page(page: Path, text: str, shell: Shell, request: pytest.FixtureRequest) -> None:
    """Compare what a page shows with what its commands print."""
    shown = _BLOCK.sub(lambda block: f"```console\n{shell.repeat(block[1])}```", text)
    if request.config.getoption("--update-golden"):
        page.write_text(shown, encoding="utf-8")
    assert _SECONDS.sub("in 1.00s", text) == _SECONDS.sub("in 1.00s", shown)


class Shell:
    """Runs commands in a folder that they may change."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        scripts = Path(sys.executable).parent
        self.environment = {
            **os.environ,
            "HOME": str(folder),
            "PATH": f"{scripts}{os.pathsep}{os.environ['PATH']}",
            "PYTHONDONTWRITEBYTECODE": "1",
            "COLUMNS": "100",
            "PYTEST_ADDOPTS": f"{os.environ['PYTEST_ADDOPTS']} -p no:cacheprovider",
        }
        for key in ("GIT_AUTHOR", "GIT_COMMITTER"):
            self.environment |= {f"{key}_NAME": "A", f"{key}_EMAIL": "a@example.org"}

    def repeat(self, block: str) -> str:
        """Run the commands of a block; return it with what they print."""
        commands = [line[2:] for line in block.splitlines() if line.startswith("$ ")]
        return "".join(f"$ {command}\n{self.run(command)}" for command in commands)

    def run(self, command: str) -> str:
        if command.startswith("cd "):
            self.folder /= command.removeprefix("cd ")
            return ""
        ended = subprocess.run(
            ["bash", "-c", command],
            cwd=self.folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        return ended.stdout


def test_reference_of_the_command_line() -> None:
    tool = load("make_cli_doc")
    assert tool.PAGE.read_text(encoding="utf-8") == tool.render()


def load(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, REPOSITORY / "tools" / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_tables_of_the_conditions_of_a_run() -> None:
    page = REPOSITORY / "docs" / "reference" / "monitors.md"
    text = page.read_text(encoding="utf-8")
    assert text == load("make_monitors_doc").render(text), "run `make tables`"
