"""Pages in a real browser: what is left in attributes of the document."""

import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import pytest

from osc2tx_runtime.report.page import Trace, render_runs
from tests.processes import HANGING

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-sync",
    "--disable-background-networking",
    "--disable-component-update",
    "--window-size=1400,1600",
    "--virtual-time-budget=10000",
    "--dump-dom",
]

# Marks of all tests of a module.
IN_A_BROWSER = [
    pytest.mark.slow,
    pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed"),
]

# What is drawn after the first frame is drawn at once, for a script that looks at all of it.
COMPLETE = "<script>drawWaiting()</script>"


def attributes_of(
    path: Path, profile: Path, fragment: str = "", flags: Sequence[str] = ()
) -> dict[str, str]:
    """Attributes of the document's root once the page has settled."""
    command = [
        str(CHROMIUM),
        *FLAGS,
        *flags,
        f"--user-data-dir={profile}",
        path.as_uri() + fragment,
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=HANGING, check=True)
    root = re.search(r"<html([^>]*)>", done.stdout)
    assert root is not None, done.stderr
    return dict(re.findall(r'data-([a-z-]+)="([^"]*)"', root[1]))


def looked_at(
    folder: Path, traces: Sequence[Trace], driver: str, flags: Sequence[str] = ()
) -> dict[str, str]:
    return shown_page(folder, render_runs(traces), COMPLETE + driver, flags)


def shown_page(folder: Path, page: str, driver: str, flags: Sequence[str] = ()) -> dict[str, str]:
    """Attributes of a page with a script of the test at its end, which its policy forbids."""
    page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
    path = folder / "page.html"
    path.write_text(page.replace("</body>", driver + "</body>"), encoding="utf-8")
    return attributes_of(path, folder / "profile", flags=flags)
