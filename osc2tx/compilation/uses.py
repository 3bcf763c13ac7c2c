"""The parts of imported files that a source uses, as a digest.

A result holds as long as this digest is the same: an edit of a comment, or of a declaration that
nothing in the source leads to, changes none. Names lead: a declaration is used if a word of the
source, or of another declaration that is used, is a name that it provides. Texts decide, not the
model, so the digest of the present files is there without compiling any.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Collection, Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Compilation

FILES_KEPT = 256
_WORD = re.compile(r"[^\W\d]\w*")
_NAMING = frozenset({"scenario", "actor", "struct", "action", "modifier", "unit", "type", "global"})


class UsedFile(NamedTuple):
    """An imported file.

    Attributes:
        name: Its unique name, the same in every folder.
        text: Its text.
    """

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement at the level of the file.

    Attributes:
        keyword: Its first word, as `scenario` or `extend`.
        name: The declared or extended name, as written: `vehicle.swerve`; empty if nothing.
        provides: The names that lead to it; `None` if it always counts.
        declares: The name that it declares, unless it is an extension.
        words: The words in it.
        tokens: Its tokens as one text.
    """

    keyword: str
    name: str
    provides: frozenset[str] | None
    declares: str | None
    words: frozenset[str]
    tokens: str


def used_digest(text: str, files: Sequence[UsedFile], dialect: str) -> str:
    """Return the digest of all that a source uses.

    Args:
        text: The text of the source.
        files: The files that it imports, directly or through others.
        dialect: The dialect of the source.
    """
    split = [(file, split_statements(file.text, dialect)) for file in sorted(files)]
    by_name: dict[str, list[Statement]] = {}
    declared: dict[str, int] = {}
    reached: set[int] = set()
    pending = set(_WORD.findall(text))
    for _, statements in split:
        for each in statements:
            if each.provides is None:
                reached.add(id(each))
                pending |= each.words
            for name in each.provides or ():
                by_name.setdefault(name, []).append(each)
            if each.declares is not None:
                declared[each.declares] = declared.get(each.declares, 0) + 1
    seen: set[str] = set()
    while pending:
        word = pending.pop()
        seen.add(word)
        for each in by_name.pop(word, ()):
            if id(each) not in reached:
                reached.add(id(each))
                pending |= each.words - seen
    found = hashlib.sha256()
    twice = sorted(name for name, count in declared.items() if count > 1)
    for part in _parts(split, reached, twice):
        found.update(part.encode("utf-8", "surrogatepass") + b"\0")
    return found.hexdigest()[:32]


def _parts(
    split: Sequence[tuple[UsedFile, tuple[Statement, ...]]],
    reached: Collection[int],
    twice: Sequence[str],
) -> Iterator[str]:
    yield " ".join(twice)  # names that may collide, in any file
    for file, statements in split:
        yield file.name
        for each in statements:
            if id(each) in reached:
                yield each.tokens


@lru_cache(maxsize=FILES_KEPT)
def split_statements(text: str, dialect: str) -> tuple[Statement, ...]:
    """Split a file into its statements at the level of the file.

    Args:
        text: The text of the file.
        dialect: Its dialect.
    """
    from osc2tx.diagnostics import DiagnosticSink, SourceFile
    from osc2tx.semantics.dialects import DIALECTS
    from osc2tx.syntax.token_source import TokenSource
    from osc2tx.syntax.tokens import DEDENT, INDENT, NEWLINE

    allow = frozenset(DIALECTS[dialect].relaxed)
    table = TokenSource(SourceFile("", text), DiagnosticSink(), allow=allow).scan()
    found: list[Statement] = []
    depth, first, count = 0, 0, len(table.types) - 1  # without the end of the file
    for index in range(count):
        kind = table.types[index]
        depth += (kind == INDENT) - (kind == DEDENT)
        ends = depth == 0 and kind in (NEWLINE, DEDENT)
        if (ends and table.types[index + 1] != INDENT) or index == count - 1:
            tokens = [
                (
                    table.text(each)
                    if table.types[each] not in (NEWLINE, INDENT, DEDENT)
                    else f"\n{table.types[each]}"
                )
                for each in range(first, index + 1)
            ]
            found.append(_statement(tokens))
            first = index + 1
    return tuple(found)


def _statement(tokens: Sequence[str]) -> Statement:
    text = " ".join(tokens)
    words = frozenset(_WORD.findall(text))
    ends = (i for i, each in enumerate(tokens) if each == ":" or each.startswith("\n"))
    head = tokens[: next(ends, len(tokens))]
    keyword = head[0] if head else ""
    names = [each for each in head[1:] if _WORD.fullmatch(each)]
    name = _declared(head) if names else ""
    if not names or any("|" in each for each in head):
        return Statement(keyword, "", None, None, words, text)
    if keyword == "extend":
        return Statement(keyword, name, frozenset(names), None, words, text)
    if keyword == "enum":
        return Statement(keyword, name, words - {keyword}, names[0], words, text)
    if keyword not in _NAMING:
        return Statement(keyword, "", None, None, words, text)
    declared = name.rpartition(".")[2].rpartition("::")[2]
    provides = {declared}
    if "(" in head:  # a subtype by condition is one of its base
        provides |= set(names)
    return Statement(keyword, name, frozenset(provides), declared, words, text)


def _declared(head: Sequence[str]) -> str:
    """Return the name after the keyword: `vehicle.swerve` of `action vehicle.swerve`."""
    end = 2
    while end + 1 < len(head) and head[end] in (".", "::"):
        end += 2
    return "".join(head[1:end])


def whole_files(compilation: Compilation) -> Iterator[Path]:
    """Yield the files of which a result contains more than their declarations.

    Reports point to them, or the module has copies, with their places in its map. The file itself
    is among them, which the others may import.
    """
    yield real_path(compilation.path)
    for report in compilation.reports:
        for span in (report.primary, *(label.span for label in report.labels)):
            if span is not None and span.source.path is not None:
                yield real_path(span.source.path)
    if compilation.ir is not None and compilation.has_module:
        from osc2tx.backends.py_trees.own_names import declarations, key_of

        copies = compilation.sharing.copies
        for part in declarations(compilation.ir):
            if key_of(part) in copies and part.span.source.path is not None:
                yield real_path(part.span.source.path)
