"""The standard library and the preludes of dialects, as source texts.

Lines that belong to one version of the standard only carry a tag at their end: `#! since 2.2` or
`#! until 2.1`. The loader blanks out the lines of other versions, so that offsets stay.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from osc2tx.diagnostics import DiagnosticSink, InternalCompilerError, SourceFile
from osc2tx.stdlib.meanings import member_meanings
from osc2tx.stdlib.parsed import load_parsed
from osc2tx.syntax import ast, parse

__all__ = [
    "DOMAIN",
    "EXTENSIONS",
    "LIBRARY",
    "NEWEST",
    "TYPES",
    "library_file",
    "library_source",
    "member_meanings",
    "newer_members",
    "parse_library_file",
]

TYPES, DOMAIN, EXTENSIONS = "types.osc", "domain.osc", "extensions.osc"
LIBRARY = (TYPES, DOMAIN, EXTENSIONS)  # in the order of loading

NEWEST = "2.2"

_FOLDER = Path(__file__).parent
_TAGGED_LINE = re.compile(r"^(.*)#! (since|until) (\d+\.\d+)[ \t]*$", re.MULTILINE)


@cache
def library_source(name: str, standard: str) -> SourceFile:
    """Return a file of the library as one version of the standard has it."""
    text = (_FOLDER / name).read_text(encoding="utf-8")
    text = _TAGGED_LINE.sub(lambda line: _select(line, standard), text)
    return SourceFile(f"<library>/{name}", text)


@cache
def library_file(name: str, standard: str) -> ast.File:
    """Return the AST of a file of the library."""
    source = library_source(name, standard)
    return load_parsed(source, standard) or parse_library_file(source)


@cache
def newer_members(name: str, standard: str) -> frozenset[str]:
    """Return the members of a declaration that only the newest version of the standard has.

    Args:
        name: Of an enum, a primitive type, an action or a modifier of the library.
        standard: The other version.
    """
    return _members(name, NEWEST) - _members(name, standard)


def _members(name: str, standard: str) -> frozenset[str]:
    return frozenset(
        member
        for file in LIBRARY
        for statement in library_file(file, standard).statements
        for member in _members_of(name, statement)
    )


def _members_of(name: str, statement: ast.FileStatement) -> Iterator[str]:
    match statement:
        case ast.EnumDeclaration(name=enum) if enum.text == name:
            yield from (member.name.text for member in statement.members)
        case ast.PrimitiveExtension(primitive=primitive) if primitive == name:
            yield from (method.name.text for method in statement.members)
        case ast.ActionDeclaration() | ast.ModifierDeclaration():
            if statement.name.name.text != name:
                return
            for member in statement.members:
                if isinstance(member, ast.ParameterDeclaration):
                    yield from (parameter.text for parameter in member.names)


def parse_library_file(source: SourceFile) -> ast.File:
    """Parse a file of the library."""
    sink = DiagnosticSink()
    file = parse(source, sink)
    if sink.has_errors:
        first = sink.sorted()[0]
        raise InternalCompilerError(f"{source.name}: {first.primary}: {first.message}")
    return file


def _select(line: re.Match[str], standard: str) -> str:
    """Return a line with a tag, or blanks of its length if another version owns it."""
    bound, wanted = _version(line[3]), _version(standard)
    belongs = wanted >= bound if line[2] == "since" else wanted <= bound
    return line[0] if belongs else " " * len(line[0])


def _version(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in text.split("."))
