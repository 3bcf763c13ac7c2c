"""Snapshots of parsed library texts in the user's cache folder.

A snapshot is data, not code: whoever could write one for us could at most make the library wrong,
and even that takes write access to a folder of the user's own (`user_cache`). What is damaged, or
was made from other texts, by another osc2tx or by another Python, is not used either. In all these
cases the text is parsed as if there were no snapshot, and a new one is written if that is possible.
"""

from __future__ import annotations

import marshal
import os
import sys
import time
from pathlib import Path
from typing import Any
from zlib import crc32

from osc2tx.diagnostics import SourceFile
from osc2tx.support.user_cache import cache_folder, read_own, write_own
from osc2tx.syntax import ast
from osc2tx.syntax.packed_ast import PackingError, pack, unpack
from osc2tx.version import __version__

__all__ = ["cache_folder", "load_snapshot", "save_snapshot"]

MAGIC = b"osc2tx-ast-1\n"
_CHECKSUM = 4  # bytes of the checksum behind the magic word

# What the AST of a text depends on besides the text.
_CODE = Path(__file__).resolve().parent.parent
_CODE_FOLDERS = ("syntax", "syntax/ast", "syntax/ast_builder", "syntax/_antlr")
_STARTED = time.time_ns()

Stamp = tuple[object, ...]


def load_snapshot(source: SourceFile, standard: str) -> ast.File | None:
    """Return the AST of a library text, if there is a snapshot that can be trusted."""
    folder, stamp = cache_folder(), _code_stamp()
    if folder is None or stamp is None:
        return None
    data = read_own(folder / _file_name(source, standard))
    if data is None or not data.startswith(MAGIC):
        return None
    start = len(MAGIC) + _CHECKSUM
    if data[len(MAGIC) : start] != _checksum(data[start:]):
        return None
    try:
        found_stamp, text, packed = marshal.loads(data[start:])
        if found_stamp != stamp or text != source.text:
            return None
        return unpack(packed, source)
    except (EOFError, ValueError, TypeError, PackingError):
        return None


def save_snapshot(file: ast.File, standard: str) -> None:
    """Keep the AST of a library text for the next process; not being able to is no problem."""
    folder, stamp = cache_folder(), _code_stamp()
    if folder is None or stamp is None:
        return
    source = file.span.source
    contents: Any = (stamp, source.text, pack(file))
    content = marshal.dumps(contents)
    write_own(folder / _file_name(source, standard), MAGIC + _checksum(content) + content)


def _file_name(source: SourceFile, standard: str) -> str:
    """Return the name of a snapshot; installations of osc2tx do not overwrite those of others."""
    place = crc32(str(_CODE).encode("utf-8", "surrogateescape"))
    name = Path(source.name).stem
    return f"{name}-{standard}-{sys.implementation.cache_tag}-{place:08x}.snapshot"


def _checksum(content: bytes) -> bytes:
    """Against damage only; against malice stands that nobody else may write to the folder."""
    return crc32(content).to_bytes(_CHECKSUM, "big")


def _code_stamp() -> Stamp | None:
    """Return what identifies the code that makes an AST: version, Python, its files.

    `None` if that cannot be told: the files are not there, or changed after this process began.
    """
    files: list[tuple[str, int, int]] = []
    try:
        for folder in _CODE_FOLDERS:
            with os.scandir(_CODE / folder) as entries:
                for entry in entries:
                    if entry.name.endswith(".py"):
                        status = entry.stat()
                        files.append((entry.name, status.st_size, status.st_mtime_ns))
    except OSError:
        return None
    if not files or max(changed for _, _, changed in files) > _STARTED:
        return None
    return (__version__, sys.version_info[:3], *sorted(files))
