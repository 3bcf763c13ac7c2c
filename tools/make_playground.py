"""Write the playground: a page that checks, draws and runs scenarios in the browser.

    python tools/make_playground.py PYODIDE FOLDER

PYODIDE is the folder of the npm package `pyodide`. FOLDER gets the page, Pyodide, and an archive of
osc2tx with the packages that it imports. Any web server can serve it.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

REPOSITORY = Path(__file__).resolve().parent.parent
PAGE = REPOSITORY / "tools" / "playground"
OURS = (
    REPOSITORY / "osc2tx",
    REPOSITORY / "runtime_lib" / "osc2tx_runtime",
    REPOSITORY / "runtime_lib" / "osc2tx_shared",
)
TEMPLATES = REPOSITORY / "templates"
# What a check, a draft of a module and a run import of others; all have a form in Python.
OTHERS = (
    *("antlr4", "jinja2", "markupsafe", "py_trees", "pydot", "pyparsing"),
    *("pint", "flexcache", "flexparser", "platformdirs", "typing_extensions"),
)
OF_PAGE = (PAGE / "playground.py", PAGE / "lxml")
OF_PYODIDE = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip")
OF_PYODIDE += ("pyodide-lock.json",)
COMPILED = frozenset({".pyc", ".so", ".pyd"})


def files_of(package: Path) -> Iterator[Path]:
    """Yield the files of a package, or the only one of a module."""
    found = [package] if package.is_file() else sorted(package.rglob("*"))
    kept = (path for path in found if path.is_file() and path.suffix not in COMPILED)
    yield from (path for path in kept if "__pycache__" not in path.parts)


def place_of(name: str) -> Path:
    """Return the folder or file of an installed package."""
    spec = find_spec(name)
    assert spec is not None and spec.origin is not None, f"{name} is not installed"
    origin = Path(spec.origin)
    return origin.parent if origin.name.startswith("__init__.") else origin


def write_archive(archive: Path) -> None:
    """Write the archive of osc2tx; the same bytes for the same files."""
    with ZipFile(archive, "w", ZIP_DEFLATED) as written:
        for package in (*OURS, *map(place_of, OTHERS), *OF_PAGE):
            for path in files_of(package):
                _add(written, path.relative_to(package.parent).as_posix(), path)
        for path in files_of(TEMPLATES):
            _add(written, f"osc2tx/{path.relative_to(REPOSITORY).as_posix()}", path)


def _add(archive: ZipFile, name: str, path: Path) -> None:
    entry = ZipInfo(name)
    entry.compress_type = ZIP_DEFLATED
    archive.writestr(entry, path.read_bytes())


def main(pyodide: Path, folder: Path) -> None:
    """Write all files."""
    (folder / "pyodide").mkdir(parents=True, exist_ok=True)
    for name in OF_PYODIDE:
        shutil.copyfile(pyodide / name, folder / "pyodide" / name)
    for name in ("index.html", "playground.css", "playground.js"):
        shutil.copyfile(PAGE / name, folder / name)
    write_archive(folder / "osc2tx.zip")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
