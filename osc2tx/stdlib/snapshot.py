"""Snapshots of parsed library texts in the user's cache folder.

A snapshot is data, not code: whoever could write one for us could at most make the library wrong,
and even that takes write access to a folder of the user's own: a folder or a file that belongs to
somebody else, or that others may write to, is not read. What is damaged, or was made from other
texts, by another osc2tx or by another Python, is not used either. In all these cases the text is
parsed as if there were no snapshot, and a new one is written if that is possible.

`OSC2TX_NO_CACHE=1` neither reads nor writes any.
"""

from __future__ import annotations

import marshal
import os
import stat
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from zlib import crc32

from osc2tx import __version__
from osc2tx.diagnostics import SourceFile
from osc2tx.syntax import ast
from osc2tx.syntax.packed import PackingError, pack, unpack

__all__ = ["cache_folder", "load_snapshot", "save_snapshot"]

MAGIC = b"osc2tx-ast-1\n"
_CHECKSUM = 4  # bytes of the checksum behind the magic word

# What the AST of a text depends on besides the text.
_CODE = Path(__file__).resolve().parent.parent
_CODE_FOLDERS = ("syntax", "syntax/ast", "syntax/ast_builder", "syntax/_antlr")
_STARTED = time.time_ns()

# No link is followed, and a pipe in place of the file does not block.
_READ_FLAGS = os.O_RDONLY
for _flag in ("O_NOFOLLOW", "O_NONBLOCK", "O_BINARY"):
    _READ_FLAGS |= getattr(os, _flag, 0)

Stamp = tuple[object, ...]


def cache_folder() -> Path | None:
    """Return the folder of osc2tx in the user's cache, as the platform has it.

    `platformdirs` would say the same, and takes longer to import than a snapshot to load.
    """
    if os.environ.get("OSC2TX_NO_CACHE"):
        return None
    home = os.path.expanduser("~")
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA", "")
    elif sys.platform == "darwin":
        base = os.path.join(home, "Library", "Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME", "")
        base = base if os.path.isabs(base) else os.path.join(home, ".cache")
    return Path(base, "osc2tx") if os.path.isabs(base) else None


def load_snapshot(source: SourceFile, standard: str) -> ast.File | None:
    """Return the AST of a library text, if there is a snapshot that can be trusted."""
    folder, stamp = cache_folder(), _code_stamp()
    if folder is None or stamp is None:
        return None
    try:
        if not _is_ours(os.lstat(folder), stat.S_ISDIR):
            return None
        data = _read(folder / _file_name(source, standard))
    except OSError:
        return None
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
    from tempfile import mkstemp  # rarely needed

    source = file.span.source
    contents: Any = (stamp, source.text, pack(file))
    content = marshal.dumps(contents)
    data = MAGIC + _checksum(content) + content
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _is_ours(os.lstat(folder), stat.S_ISDIR):
            return
        target = folder / _file_name(source, standard)
        descriptor, temporary = mkstemp(dir=folder, prefix=f".{target.name}.")
    except OSError:
        return
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(data)
        os.replace(temporary, target)
    except OSError:
        Path(temporary).unlink(missing_ok=True)


def _file_name(source: SourceFile, standard: str) -> str:
    """Return the name of a snapshot; installations of osc2tx do not overwrite those of others."""
    place = crc32(str(_CODE).encode("utf-8", "surrogateescape"))
    name = Path(source.name).stem
    return f"{name}-{standard}-{sys.implementation.cache_tag}-{place:08x}.snapshot"


def _checksum(content: bytes) -> bytes:
    """Against damage only; against malice stands that nobody else may write to the folder."""
    return crc32(content).to_bytes(_CHECKSUM, "big")


def _read(path: Path) -> bytes | None:
    """Return the bytes of a file if it is a plain file of the user's own."""
    descriptor = os.open(path, _READ_FLAGS)
    with os.fdopen(descriptor, "rb") as stream:
        return stream.read() if _is_ours(os.fstat(descriptor), stat.S_ISREG) else None


def _is_ours(status: os.stat_result, is_kind: Callable[[int], bool]) -> bool:
    """Whether a file or folder is of a kind, belongs to the user, and nobody else may write it."""
    if not is_kind(status.st_mode):
        return False
    if sys.platform == "win32":
        return True  # the profile of a user is closed to others
    return status.st_uid == os.geteuid() and not status.st_mode & 0o022


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
