"""A recorded session of Neovim, without a screen: what its user sees, step by step."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("pygls")

FOLDER = Path(__file__).parent / "neovim"
SECONDS = 120


@pytest.mark.skipif(shutil.which("nvim") is None, reason="Neovim is not installed")
def test_diagnostic_completion_fix_rename_and_formatting(tmp_path: Path) -> None:
    shutil.copy(FOLDER / "scenario.osc", tmp_path)
    script = f"luafile {FOLDER / 'session.lua'}"
    environment = {
        **os.environ,
        "SCENARIO": "scenario.osc",
        "SESSION": "session.txt",
        "SERVER": f"{sys.executable} -m osc2tx lsp",
        "XDG_STATE_HOME": str(tmp_path / "state"),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
    }
    command = ["nvim", "--headless", "-u", "NONE", "-i", "NONE", "-n", "-c", script]
    subprocess.run(command, cwd=tmp_path, env=environment, timeout=SECONDS, check=True)
    found = (tmp_path / "session.txt").read_text(encoding="utf-8")
    assert found == (FOLDER / "session.txt").read_text(encoding="utf-8")
