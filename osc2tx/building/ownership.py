"""Which files of an output folder osc2tx made, and from which source.

Each output names its source: a module in its docstring, OpenSCENARIO XML in its header, a report in
a key. So no list of outputs lies in version control, where two branches would both change it, and
an output that came with a merge is known as well as one of this machine. The records of the last
build identify outputs that were edited beyond recognition.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from osc2tx.support.paths import MODULE, SOURCE_MAP, XML, is_output

_IN_MODULE: Final = re.compile(
    rb"^Made by osc2tx from (.+): edit the scenario, not this module\.$", re.MULTILINE
)
_IN_XML: Final = re.compile(
    rb'<FileHeader [^>]*author="osc2tx"[^>]*>(?:<Properties>)?'
    rb'(?:<Property name="source" value="([^"]*)"/>)?'
)
_HEADER_SIZE = 4096  # bytes in which the header of a document ends
_CONFLICT: Final = (b"<<<<<<< ", b"=======", b">>>>>>> ")


def stated_source(path: str, data: bytes) -> str | None:
    """Return the source that an output states.

    Args:
        path: Where the file is, relative to the output folder.
        data: Its content.

    Returns:
        The name of the source; `None` if osc2tx did not make the file.
    """
    if path.endswith(MODULE):
        return _text(_IN_MODULE.search(data), path)
    if path.endswith(XML):
        return _text(_IN_XML.search(data[:_HEADER_SIZE]), path)
    return None if path.endswith(SOURCE_MAP) else _in_json(data)


def _text(found: re.Match[bytes] | None, path: str) -> str | None:
    if found is None:
        return None
    if found[1] is None:  # old versions of XML have no element for it
        folder, slash, name = path.rpartition("/")
        return f"{folder}{slash}{name.partition('.')[0]}.osc"
    from xml.sax.saxutils import unescape  # loads a client for the web with it

    return unescape(found[1].decode("utf-8", "replace"), {"&quot;": '"'})


def _in_json(data: bytes) -> str | None:
    try:
        document = json.loads(data)
        source = document["source"]
        is_ours = isinstance(source, str) and isinstance(document["format"], int)
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
    return source if is_ours else None


def is_in_conflict(data: bytes) -> bool:
    """Return whether a text has markers of an unresolved merge."""
    lines = data.splitlines()
    return all(any(line.startswith(mark) for line in lines) for mark in _CONFLICT)


def outputs_below(folder: Path, inner: str = "") -> Iterator[str]:
    """Yield the files of an output folder that can be outputs, as paths relative to it.

    Links and folders that start with a dot are left out.

    Args:
        folder: The output folder.
        inner: A folder in it, if only that one is wanted.
    """
    pending = [inner]
    while pending:
        current = pending.pop()
        try:
            with os.scandir(folder / current) as entries:
                found = sorted(entries, key=lambda entry: entry.name)
        except OSError:
            continue
        for entry in found:
            path = f"{current}/{entry.name}".lstrip("/")
            if entry.is_dir(follow_symlinks=False):
                if not entry.name.startswith((".", "__")):
                    pending.append(path)
            elif is_output(entry.name) and entry.is_file(follow_symlinks=False):
                yield path


def beside(source: str, name: str) -> str:
    """Return the path of an output of a source, from its name."""
    folder, slash, _ = source.rpartition("/")
    return f"{folder}{slash}{name}"
