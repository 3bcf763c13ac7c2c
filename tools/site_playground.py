"""Hook of mkdocs: the playground is a page of the site, where Pyodide was fetched.

`make playground` fetches it. A site without it has no such entry in its navigation.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parent.parent
sys.path[:0] = [str(Path(__file__).parent)]

from make_playground import main as write_playground  # noqa: E402

PYODIDE = REPOSITORY / "out" / "npm" / "node_modules" / "pyodide"
PLACE = "playground.md"
BEFORE = "Tutorial"  # in the navigation
PAGE = """# Playground

Write a scenario, see its diagnostics and its behavior tree, and run it: in this browser, with
nothing to install. The page loads about 16 MB; no text leaves it.

<a class="md-button md-button--primary" href="playground/index.html">Open the playground</a>
"""


def on_config(config: Any, **_: Any) -> Any:
    """Add the page to the navigation; called by mkdocs."""
    if PYODIDE.is_dir():
        titles = [title for entry in config.nav for title in entry]
        config.nav.insert(titles.index(BEFORE), {"Playground": PLACE})
    return config


def on_files(files: Any, config: Any, **_: Any) -> Any:
    """Make the page; called by mkdocs."""
    from mkdocs.structure.files import File

    if PYODIDE.is_dir():
        files.append(File.generated(config, PLACE, content=PAGE))
    return files


def on_post_build(config: Any, **_: Any) -> None:
    """Write the playground beside its page; called by mkdocs."""
    if PYODIDE.is_dir():
        write_playground(PYODIDE, Path(config.site_dir) / "playground")
