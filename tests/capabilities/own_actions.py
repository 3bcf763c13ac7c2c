"""Runs a scenario in a process that has the package of docs/extending.md installed."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

from osc2tx.backends.py_trees import emit
from tests.capabilities.kit import CAPABILITIES
from tests.end_to_end.harness import REPOSITORY, compile_scenario
from tests.processes import HANGING


def install(folder: Path) -> None:
    """Put the classes of the document into a folder, with what an installer writes beside them."""
    document = (REPOSITORY / "docs/extending.md").read_text(encoding="utf-8")
    classes = re.findall(r"^```python\n(.*?)^```$", document, re.MULTILINE | re.DOTALL)
    (folder / "my_actions.py").write_text("\n".join(classes), encoding="utf-8")
    metadata = folder / "my_actions-1.0.dist-info"
    metadata.mkdir(parents=True)
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: my-actions\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text("[osc2tx.methods]\nmy_actions = my_actions\n")


def run_with_own_actions(name: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Build a scenario and run its module; the trace is `trace.jsonl` in the folder."""
    packages = folder / "packages"
    packages.mkdir()
    install(packages)
    generated = emit(compile_scenario(CAPABILITIES / f"{name}.osc"))
    module = folder / f"{generated.stem}.py"
    module.write_text(generated.python, encoding="utf-8")
    path = os.pathsep.join([str(REPOSITORY / "runtime_lib"), str(packages)])
    return subprocess.run(
        [sys.executable, str(module), "--trace", str(folder / "trace.jsonl")],
        capture_output=True,
        text=True,
        timeout=HANGING,
        env={**os.environ, "PYTHONPATH": path},
        check=False,
    )
