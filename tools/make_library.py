"""Writes the ASTs of the library, which `osc2tx/stdlib/parsed.py` reads: `osc2tx/stdlib/asts/`.

A test compares.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from osc2tx.options import STANDARDS
from osc2tx.semantics import DIALECTS
from osc2tx.stdlib import LIBRARY, library_source, parse_library_file
from osc2tx.stdlib.parsed import checksum, parsed_path
from osc2tx.syntax.packed_ast import pack

PRELUDES = tuple(each.prelude for each in DIALECTS.values() if each.prelude is not None)


def render() -> dict[Path, str]:
    """Return the files with their texts: a line for each column of an AST."""
    found = {}
    for name in (*LIBRARY, *PRELUDES):
        for standard in STANDARDS:
            source = library_source(name, standard)
            groups = [
                f"[{json.dumps(kind)},{count},[\n{_joined(map(_line, columns))}\n]]"
                for kind, count, columns in pack(parse_library_file(source))
            ]
            path = parsed_path(source, standard)
            found[path] = f"[{checksum(source)},[\n{_joined(groups)}\n]]\n"
    return found


def _line(column: object) -> str:
    return json.dumps(column, separators=(",", ":"))


def _joined(lines: Iterable[str]) -> str:
    return ",\n".join(lines)


if __name__ == "__main__":
    for path, text in render().items():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
