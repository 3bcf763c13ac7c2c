"""The build hook that compiles the compiler, for `make compiled`.

It copies the package, writes out its value classes (`native_classes.py`), has mypyc compile the
modules that `pyproject.toml` names, and adds the extension modules to the wheel.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

sys.path.insert(0, str(Path(__file__).parents[1]))

from tools.native_classes import compiled_modules, rewrite

SETUP = """\
import sys
from setuptools import setup
from mypyc.build import mypycify

modules = mypycify(
    sys.argv[1:], opt_level="1", debug_level="0", multi_file=True, group_name="osc2tx"
)
setup(name="osc2tx", packages=[], ext_modules=modules, script_args=["-q", "build_ext", "--inplace"])
"""
UNCHECKED = ["type-var", "arg-type"]
"""Errors of mypy, as classes that are written out are no dataclasses; lint checks the sources."""


class CompiledWheel(BuildHookInterface[Any]):
    """Adds the extension modules to the wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile; called before the files of the wheel are collected."""
        root = Path(self.root)
        self._folder = TemporaryDirectory()
        folder = Path(self._folder.name)
        shutil.copytree(root / "osc2tx", folder / "osc2tx", ignore=shutil.ignore_patterns("*.pyc"))
        shutil.copy(root / "pyproject.toml", folder)
        rewrite(folder)
        options = [f"--config-file={root / 'pyproject.toml'}", "--no-warn-unused-ignores"]
        options += [f"--disable-error-code={code}" for code in UNCHECKED]
        command = [sys.executable, "-c", SETUP, *options, *compiled_modules(folder)]
        subprocess.run(command, cwd=folder, check=True)
        suffix = sysconfig.get_config_var("EXT_SUFFIX")
        for path in sorted(folder.rglob(f"*{suffix}")):
            if "build" not in path.relative_to(folder).parts:
                name = path.relative_to(folder).as_posix()
                build_data["force_include"][str(path)] = name
        build_data["infer_tag"] = True
        build_data["pure_python"] = False

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove the copy."""
        self._folder.cleanup()
