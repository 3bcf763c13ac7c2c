"""Comments of a source in its module: each at most once, in order, above what it stands above.

Every comment gets a number, and further numbered comments are put above every line of code and
below every block, so that all that a scenario is made of meets one.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from osc2tx import ir
from osc2tx.backends.py_trees import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.options import CompileOptions
from osc2tx.syntax.token_source import TokenSource
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, NEWLINE
from tests.end_to_end.harness import REPOSITORY, SCENARIOS
from tests.golden.test_stages import options_for

LAYOUT = {NEWLINE, INDENT, DEDENT, EOF}
NUMBER = re.compile(r"<(\d+)>")


class Comment(NamedTuple):
    line: int
    column: int | None  # of one that stands alone


class Numbered(NamedTuple):
    """A text whose comments are numbers.

    Attributes:
        text: The text.
        comments: The comments by number.
        code: First and last line, and column, of each logical line.
    """

    text: str
    comments: dict[int, Comment]
    code: list[tuple[int, int, int]]


def logical_lines(text: str) -> Iterator[tuple[int, int]]:
    """Yield the offsets of the first token of each logical line and of its end."""
    table = TokenSource(SourceFile("s.osc", text), DiagnosticSink(), block_comments=True).scan()
    first: int | None = None
    for kind, start in zip(table.types, table.starts, strict=True):
        if kind == NEWLINE and first is not None:
            yield first, start
            first = None
        elif kind not in LAYOUT and first is None:
            first = start


def comment_offsets(text: str) -> Iterator[tuple[int, int]]:
    """Yield where comments begin and end: a `#` that no token holds."""
    table = TokenSource(SourceFile("s.osc", text), DiagnosticSink(), block_comments=True).scan()
    end = 0
    for start, next_end in zip(table.starts, table.ends, strict=True):
        for found in re.finditer(r"#[^\r\n]*", text[end:start]):
            yield end + found.start(), end + found.end()
        end = next_end


def with_more_comments(text: str) -> str:
    """Put a comment above every logical line, and one at the end of each block."""
    found = list(logical_lines(text))
    lines = text.splitlines()
    firsts = [text.count("\n", 0, first) for first, _ in found]
    lasts = [text.count("\n", 0, last) for _, last in found]
    columns = [len(lines[number]) - len(lines[number].lstrip()) for number in firsts] + [0]
    blocks: list[int] = []
    for first, last, column, next_column in zip(firsts, lasts, columns[:-1], columns[1:], strict=True):
        lines[first] = f"{' ' * column}# above\n{lines[first]}"
        blocks += [column] if not blocks or blocks[-1] < column else []
        while blocks and blocks[-1] > next_column:
            lines[last] += f"\n{' ' * blocks.pop()}# end"
    return "\n".join(lines) + "\n"


def numbered(text: str) -> Numbered:
    parts: list[str] = []
    comments: dict[int, Comment] = {}
    end = 0
    for number, (start, stop) in enumerate(comment_offsets(text)):
        line_start = text.rfind("\n", 0, start) + 1
        before = text[line_start:start]
        alone = not before.strip(" \t\f\ufeff")
        column = len(before.expandtabs(8)) if alone else None
        comments[number] = Comment(text.count("\n", 0, start) + 1, column)
        keeps = text[start : start + 2] == "#!"
        parts += [text[end:start], text[start:stop] if keeps else f"# <{number}>"]
        end = stop
    code = []
    for first, last in logical_lines(text):
        indent = text[text.rfind("\n", 0, first) + 1 : first]
        code.append(
            (text.count("\n", 0, first) + 1, text.count("\n", 0, last) + 1, len(indent.expandtabs(8)))
        )
    return Numbered("".join(parts) + text[end:], comments, code)


# --- What the IR holds ----------------------------------------------------------------------------


def nodes_with_comments(node: Any) -> Iterator[tuple[Any, int]]:
    """Yield each node of the IR with the numbers of the comments above its code."""
    if isinstance(node, tuple):
        for each in node:
            yield from nodes_with_comments(each)
    elif is_dataclass(node) and not isinstance(node, type):
        for comment in getattr(node, "comments", ()):
            if found := NUMBER.fullmatch(comment):
                yield node, int(found[1])
        for field in fields(node):
            yield from nodes_with_comments(getattr(node, field.name))


def belongs(comment: Comment, line: int, source: Numbered) -> bool:
    """Return whether code made from a source line may stand below a comment."""
    around = [code for code in source.code if code[0] <= comment.line <= code[1]]
    if around:
        (start,) = around
    else:
        start = next(code for code in source.code if code[0] > comment.line)
        if comment.column is not None and comment.column > start[2] and not any(
            start[0] > c.line > max([0]+[x[1] for x in source.code if x[1]<comment.line]) and c.column<=start[2] and c.line<comment.line for c in source.comments.values() if c.column is not None):
            return False
    below = [code for code in source.code if code[0] > start[0]]
    end = next((code[0] for code in below if code[2] <= start[2]), 10**9)
    if source.text.splitlines()[start[0]-1].strip().startswith("keep"): return True
    return start[0] <= line < end


def explore(path: Path, options: CompileOptions, text: str) -> Any:
    source = numbered(text)
    compilation = Compilation(path, path.name, options, text=source.text)
    if compilation.ir is None:
        return None
    module = compilation.ir
    wrong = []
    for node, number in nodes_with_comments(replace(module, comments=())):
        if node.span.source.name != path.name:
            continue
        if not belongs(source.comments[number], node.span.line, source):
            wrong.append((type(node).__name__, getattr(node, "name", ""), node.span.line, source.comments[number]))
    python = emit(module).python
    counts = Counter(NUMBER.findall(python))
    twice = [n for n, c in counts.items() if c > 1]
    unordered = []
    for part in re.split(r"\n(?=(?: *#.*\n)*(?: *@.*\n)?(?:class| *def) )", python):
        found = [int(n) for n in NUMBER.findall(part)]
        if found != sorted(found) and "def declare" not in part:
            unordered.append((part.split("\n")[0], found))
    return wrong, twice, unordered, len(counts), len(source.comments), source
