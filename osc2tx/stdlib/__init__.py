"""The standard library and the preludes of dialects, as source texts.

Lines that belong to one version of the standard only carry a tag at their end: `#! since 2.2` or
`#! until 2.1`. The loader blanks out the lines of other versions, so that offsets stay.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

from osc2tx.diagnostics import DiagnosticSink, InternalCompilerError, SourceFile
from osc2tx.syntax import ast, parse

__all__ = ["DOMAIN", "TYPES", "library_file", "library_source"]

TYPES, DOMAIN = "types.osc", "domain.osc"

_TAG = re.compile(r"#! (since|until) (\d+\.\d+)\s*$")


@cache
def library_source(name: str, standard: str) -> SourceFile:
    """Return a file of the library as one version of the standard has it."""
    text = files(__name__).joinpath(name).read_text(encoding="utf-8")
    lines = [_select(line, standard) for line in text.splitlines(keepends=True)]
    return SourceFile(f"<library>/{name}", "".join(lines))


@cache
def library_file(name: str, standard: str) -> ast.File:
    """Return a parsed file of the library; parsed once per process."""
    sink = DiagnosticSink()
    file = parse(library_source(name, standard), sink)
    if sink.has_errors:
        first = sink.sorted()[0]
        raise InternalCompilerError(f"library {name}: {first.primary}: {first.message}")
    return file


def _select(line: str, standard: str) -> str:
    """Return a line, or blanks of its length if another version owns it."""
    tag = _TAG.search(line)
    if tag is None:
        return line
    bound = _version(tag.group(2))
    wanted = _version(standard)
    belongs = wanted >= bound if tag.group(1) == "since" else wanted <= bound
    return line if belongs else re.sub(r"[^\r\n]", " ", line)


def _version(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in text.split("."))
