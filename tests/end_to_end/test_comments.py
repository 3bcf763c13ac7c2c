"""Comments of a source in its module: each at most once, in order, above what it stands above.

Every comment gets a number. Further ones are put above every logical line and at the end of every
block, so that all that a scenario is made of meets one.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from osc2tx import ir
from osc2tx.compilation.driver import Compilation
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.options import CompileOptions
from osc2tx.syntax.token_source import TokenSource
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, NEWLINE, TokenTable
from tests.end_to_end.harness import SCENARIOS
from tests.golden.test_stages import HERE as GOLDEN
from tests.golden.test_stages import options_for

OURS = [
    pytest.param(path, id=path.stem, marks=() if path.parent == SCENARIOS else pytest.mark.slow)
    for path in sorted(SCENARIOS.rglob("*.osc"))
]
CASES = [path for stage in ("ir", "py_trees") for path in sorted((GOLDEN / stage).rglob("*.osc"))]
RULES = ("keep", "remove_default", "extend", "override")
WITHOUT_CODE = ("type", "extend", "action")
SORTED = ("def declare(", "# keep(", "# Units that")
NUMBER = re.compile(r"<(\d+)>")


class Line(NamedTuple):
    """A logical line: numbers of its first and last line from 1, and its column."""

    first: int
    last: int
    column: int


class Comment(NamedTuple):
    line: int
    column: int | None  # of one that stands alone


class Source:
    """A text and where its lines and comments are, found from its tokens alone."""

    def __init__(self, text: str) -> None:
        self.text = text
        source = SourceFile("s.osc", text)
        self.rows = re.split(r"\r\n|\r|\n", text)
        self._table = TokenSource(source, DiagnosticSink(), allow=("OSC111",)).scan()

    @cached_property
    def lines(self) -> list[Line]:
        return list(logical_lines(self._table))

    @cached_property
    def comment_offsets(self) -> list[tuple[int, int]]:
        """Where comments begin and end: at each `#` that no token holds."""
        ends = [0, *self._table.ends]
        return [
            (end + found.start(), end + found.end())
            for end, start in zip(ends, self._table.starts, strict=False)
            for found in re.finditer(r"#[^\r\n]*", self.text[end:start])
        ]

    @cached_property
    def comments(self) -> list[Comment]:
        return [self._comment(start) for start, _ in self.comment_offsets]

    def _comment(self, start: int) -> Comment:
        before = self.text[self.text.rfind("\n", 0, start) + 1 : start]
        alone = not before.strip(" \t\f\ufeff")
        return Comment(self._table.source.position(start)[0], column(before) if alone else None)

    def numbered(self) -> str:
        """Return the text with a number as each comment; those for tools stay."""
        parts, end = [], 0
        for number, (start, stop) in enumerate(self.comment_offsets):
            comment = self.text[start:stop]
            parts += [
                self.text[end:start],
                comment if comment.startswith("#!") else f"# <{number}>",
            ]
            end = stop
        return "".join([*parts, self.text[end:]])

    def with_more_comments(self) -> str:
        """Return the text with a comment above every logical line and at the end of each block."""
        text = list(self.rows)
        blocks = [0]
        for line, below in zip(self.lines, [*self.lines[1:], Line(0, 0, 0)], strict=True):
            text[line.first - 1] = f"{' ' * line.column}# above\n{text[line.first - 1]}"
            blocks += [line.column] if blocks[-1] < line.column else []
            while blocks[-1] > below.column:
                text[line.last - 1] += f"\n{' ' * blocks.pop()}# end"
        return "\n".join(text) + "\n"

    def statement(self, comment: Comment) -> Line | None:
        """Return the logical line that a comment stands in or above; `None` at the end of a block.

        A comment that is deeper than what follows stands above nothing, unless one stands between
        it and the line before that is not.
        """
        for line in self.lines:
            if line.first <= comment.line <= line.last:
                return line
        below = next((line for line in self.lines if line.first > comment.line), None)
        before = max((line.last for line in self.lines if line.last < comment.line), default=0)
        if below is None or not before or comment.column is None:
            return below
        columns = [c.column for c in self.comments if before < c.line <= comment.line]
        return below if any(each <= below.column for each in columns if each is not None) else None

    def is_rule(self, number: int) -> bool:
        """Whether a comment is of a constraint, extension or override: with what that is about."""
        comment = self.comments[number]
        above = [line for line in self.lines if line.first <= comment.line]
        near = (self.statement(comment), above[-1] if above else None)
        return any(x and self.rows[x.first - 1].strip().startswith(RULES) for x in near)

    def block(self, line: Line) -> range:
        """Return the lines of a statement, its block included."""
        below = (each.first for each in self.lines if each.first > line.first)
        outside = (first for first in below if self.column_at(first) <= line.column)
        return range(line.first, next(outside, len(self.rows) + 1))

    def column_at(self, number: int) -> int:
        return next(line.column for line in self.lines if line.first == number)

    def header(self, number: int) -> str:
        """Return the line of the file-level statement that a line belongs to."""
        tops = [line for line in self.lines if not line.column]
        return next((self.rows[t.first - 1] for t in tops if number in self.block(t)), "")


def column(before: str) -> int:
    return len(before.lstrip("\ufeff").expandtabs(8))


def logical_lines(table: TokenTable) -> Iterator[Line]:
    source, first = table.source, None
    for kind, start in zip(table.types, table.starts, strict=True):
        if kind == NEWLINE and first is not None:
            number = source.position(first)[0]
            before = source.text[source.text.rfind("\n", 0, first) + 1 : first]
            yield Line(number, source.position(start)[0], column(before))
            first = None
        elif kind not in (NEWLINE, INDENT, DEDENT, EOF) and first is None:
            first = start


# --- What came of them ----------------------------------------------------------------------------


def commented(node: Any, name: str) -> Iterator[tuple[Any, str, int]]:
    """Yield each node of the IR below one with each of its comments and the number of that."""
    if isinstance(node, tuple):
        for each in node:
            yield from commented(each, name)
    elif is_dataclass(node) and not isinstance(node, type):
        for comment in getattr(node, name, ()):
            if found := NUMBER.fullmatch(comment):
                yield node, comment, int(found[1])
        for field in fields(node):
            yield from commented(getattr(node, field.name), name)


def assert_above(module: ir.Module, source: Source) -> None:
    """What stands below a comment is made from the statement that it stands above."""
    for node, written, number in commented(module.scenarios + module.types, "comments"):
        comment = source.comments[number]
        if isinstance(written, ir.CommentBelow):
            assert node.span.line < comment.line
            continue
        statement = source.statement(comment)
        header = next(x for x in source.lines if x.first <= node.span.line <= x.last)
        if comment.line in source.block(header):
            continue  # of a part of it that is nothing of its own
        assert statement is not None, (node, comment)
        said = source.rows[statement.first - 1].strip()
        if said.startswith(("keep", "extend")) or isinstance(node, ir.Placement):
            continue  # said in the declaration of a field, in the one placement of an actor
        if source.header(node.span.line).startswith("modifier"):
            continue  # said where the modifier is applied
        assert node.span.line in source.block(statement), (node, comment)


def assert_below(module: ir.Module, source: Source) -> None:
    """What stands at the end of a block is deeper than its header, or below the whole block."""
    for node, _, number in commented(module.scenarios, "end_comments"):
        comment = source.comments[number]
        header = next(x for x in source.lines if x.first <= node.span.line <= x.last)
        assert comment.column is not None
        assert header.first < comment.line
        if header.column < comment.column:
            assert comment.line < source.block(header).stop
        else:
            inside = [line.first for line in source.lines if line.first in source.block(header)]
            assert not [x for x in source.lines if max(inside) < x.first < comment.line]


def assert_once_and_in_order(python: str, source: Source) -> None:
    """In each class once; in each function in order.

    Declarations are sorted by use, units by name, and constraints of a type stand below its fields.
    """
    for class_ in re.split(r"\n(?=(?:@.*\n)?class )", python):
        counts = Counter(map(int, NUMBER.findall(class_)))
        repeated = {number for number, count in counts.items() if count > 1}
        lines = [source.comments[number].line for number in repeated]
        assert not [n for n in lines if not source.header(n).startswith("modifier")]
        for function in re.split(r"\n(?=(?: *#.*\n)*(?: *@.*\n)*(?:class| *def) )", class_):
            found = [int(n) for n in NUMBER.findall(function) if not source.is_rule(int(n))]
            applied = any(source.header(source.comments[n].line).startswith("modif") for n in found)
            gathered = any(each in function for each in SORTED)
            if not gathered and not applied:
                assert found == sorted(found), function


def assert_comments_fit(path: Path, options: CompileOptions, source: Source) -> set[int]:
    """Return the numbers of the comments in the module; none if there is no module."""
    compilation = Compilation(path, path.name, options, text=source.numbered())
    if compilation.ir is None or compilation.module is None:
        return set()
    assert_above(compilation.ir, source)
    assert_below(compilation.ir, source)
    python = compilation.module.python
    assert_once_and_in_order(python, source)
    return {int(number) for number in NUMBER.findall(python)}


@pytest.mark.parametrize("path", OURS)
def test_ours(path: Path) -> None:
    options = ConfigFiles().for_source(path).options_for(path, GivenOptions())
    source = Source(path.read_text(encoding="utf-8"))
    there = assert_comments_fit(path, options, source)
    for number in set(range(len(source.comments))) - there:
        assert (line := source.statement(source.comments[number])) is not None
        assert source.rows[line.first - 1].startswith(WITHOUT_CODE)
    more = Source(source.with_more_comments())
    assert len(assert_comments_fit(path, options, more)) > len(there) + len(source.lines) / 2


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.parent.name)
def test_constructs(path: Path) -> None:
    source = Source(path.read_text(encoding="utf-8"))
    options = options_for(path.parent)
    assert_comments_fit(path, options, source)
    assert assert_comments_fit(path, options, Source(source.with_more_comments()))


@pytest.mark.slow
def test_corpus(test_data: Path) -> None:
    modules = 0
    for path in sorted((test_data / "corpus").rglob("*.osc"))[::5]:
        source = Source(path.read_bytes().decode("utf-8-sig", errors="replace"))
        options = CompileOptions(dialect="carla")
        assert_comments_fit(path, options, source)
        modules += bool(assert_comments_fit(path, options, Source(source.with_more_comments())))
    assert modules > 10
