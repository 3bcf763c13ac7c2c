"""Snapshots of parsed library texts in the user's cache folder.

Where there is none that can be trusted (`osc2tx_shared.cache`), the text is parsed as if there
were no snapshots, and a new one is written if that is possible.
"""

from __future__ import annotations

from pathlib import Path

from osc2tx.diagnostics import SourceFile
from osc2tx.syntax import ast
from osc2tx.syntax.packed_ast import PackingError, pack, unpack
from osc2tx.version import __version__
from osc2tx_shared.cache import Snapshots

# The inputs of the AST of a text besides the text.
SNAPSHOTS = Snapshots(
    kind=f"osc2tx {__version__} AST 1",
    code=Path(__file__).resolve().parent.parent,
    parts=("syntax", "syntax/ast", "syntax/ast_builder", "syntax/_antlr"),
)


def load_snapshot(source: SourceFile, standard: str) -> ast.File | None:
    """Return the AST of a library text, if there is a snapshot that can be trusted."""
    packed = SNAPSHOTS.load(_name(source, standard), source.text)
    try:
        return None if packed is None else unpack(packed, source)
    except PackingError:
        return None


def save_snapshot(file: ast.File, standard: str) -> None:
    """Keep the AST of a library text for the next process; not being able to is no problem."""
    source = file.span.source
    SNAPSHOTS.save(_name(source, standard), source.text, pack(file))


def _name(source: SourceFile, standard: str) -> str:
    return f"{Path(source.name).stem}-{standard}"
