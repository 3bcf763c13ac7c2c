"""The ASTs of the library, which are part of osc2tx: parsing it takes longer than a small check.

`tools/make_library.py` writes them, a file of JSON for each file of the library and each version of
the standard. Those of a text that has changed since are not used.
"""

from __future__ import annotations

import json
from pathlib import Path
from zlib import crc32

from osc2tx.diagnostics import SourceFile
from osc2tx.syntax import ast
from osc2tx.syntax.packed_ast import unpack

_FOLDER = Path(__file__).parent / "asts"


def load_parsed(source: SourceFile, standard: str) -> ast.File | None:
    """Return the AST of a text of the library; `None` if there is none of this text."""
    try:
        content = parsed_path(source, standard).read_bytes()
    except FileNotFoundError:
        return None
    parsed, packed = json.loads(content)
    return unpack(packed, source) if parsed == checksum(source) else None


def parsed_path(source: SourceFile, standard: str) -> Path:
    """Return where the AST of a text of the library is."""
    return _FOLDER / f"{Path(source.name).stem}-{standard}.json"


def checksum(source: SourceFile) -> int:
    """Return what tells a text of the library from an earlier one."""
    return crc32(source.text.encode())
