"""Packages of own actions: installed into a folder, found by the modules that run with it."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path

from osc2tx_runtime.language.actions.registry import methods
from tests.processes import Ended, forked

DOCUMENT = Path(__file__).parent.parent / "docs" / "extending.md"
ENTRY_POINTS = "[osc2tx.methods]\nmy_actions = my_actions\n"


def install(folder: Path, actions: str | None = None) -> None:
    """Put a package into a folder, with the metadata that an installer writes.

    Args:
        folder: Where to.
        actions: Its text; by default that of the document.
    """
    text = DOCUMENT.read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    code = "\n".join(blocks) if actions is None else actions
    (folder / "my_actions.py").write_text(code, encoding="utf-8")
    info = folder / "my_actions-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: my-actions\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(ENTRY_POINTS)


def run_module(module: Path, trace: Path, *packages: Path) -> Ended:
    """Run a module by itself, with folders of packages on the path."""

    def main() -> None:
        methods._extended = False  # this process may have looked for packages already
        sys.path[:0] = map(str, packages)
        sys.argv = [str(module), "--trace", str(trace)]
        runpy.run_path(str(module), run_name="__main__")

    return forked(main)
