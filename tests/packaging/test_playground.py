"""The playground: its answers without installed packages, and the page in a browser."""

from __future__ import annotations

import functools
import json
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from runpy import run_path
from typing import Any
from zipfile import ZipFile

import pytest

from osc2tx.testing import run_scenario
from tests.end_to_end.harness import REPOSITORY

TOOL: dict[str, Any] = run_path(str(REPOSITORY / "tools" / "make_playground.py"))
PYODIDE = REPOSITORY / "out" / "npm" / "node_modules" / "pyodide"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
RECIPE = REPOSITORY / "docs" / "recipes" / "cut_in_at_gap.osc"
SECONDS = 600
# Only the standard library and the archive are there, as in the browser.
ASK = """
import json, sys
sys.path.insert(0, sys.argv[1])
import playground
text = sys.stdin.read()
wrong = text.replace("do parallel:", "do paralel:")
print(json.dumps({
    "found": json.loads(playground.check(wrong)),
    "fixed": playground.fixed(wrong, True) == text,
    "formatted": playground.formatted(text) == text,
    "tree": playground.tree(text),
    "no tree": playground.tree(wrong),
    "run": playground.run(text),
}))
"""


@pytest.mark.slow
def test_answers_need_no_installed_package(tmp_path: Path) -> None:
    archive = tmp_path / "osc2tx.zip"
    TOOL["write_archive"](archive)
    with ZipFile(archive) as packed:
        packed.extractall(tmp_path / "site")
    command = [sys.executable, "-I", "-S", "-c", ASK, str(tmp_path / "site")]
    text = RECIPE.read_text(encoding="utf-8")
    ended = subprocess.run(command, input=text, text=True, capture_output=True, timeout=SECONDS)
    assert ended.returncode == 0, ended.stderr
    answers = json.loads(ended.stdout)
    assert [each["code"] for each in answers["found"]] == ["OSC100"]
    assert answers["fixed"] and answers["formatted"]
    assert answers["tree"].startswith("<svg") and answers["no tree"] == ""
    run = run_scenario(RECIPE)
    assert answers["run"].splitlines()[0] == f"success after {run.time:.2f} s"
    times = {f"{line['t']:7.2f} s" for line in run.of_kind("action")}
    assert {line[:9] for line in answers["run"].splitlines()[1:]} == times


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """Serve a folder on a free port of this machine."""
    handler = functools.partial(SimpleHTTPRequestHandler, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/index.html"
        server.shutdown()


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
@pytest.mark.skipif(not PYODIDE.is_dir(), reason="Pyodide is not there: `make playground`")
def test_the_page_checks_fixes_draws_and_runs(tmp_path: Path) -> None:
    TOOL["main"](PYODIDE, tmp_path)
    with served(tmp_path) as address:
        command = [str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"]
        limits = ["--virtual-time-budget=300000", f"--user-data-dir={tmp_path / 'profile'}"]
        ended = subprocess.run(
            [*command, *limits, f"{address}#fix-all,tree,run"],
            capture_output=True,
            text=True,
            timeout=SECONDS,
        )
    assert ">no errors</span>" in ended.stdout
    assert 'src="data:image/svg+xml,%3Csvg' in ended.stdout
    assert "success after 5.00 s" in ended.stdout
