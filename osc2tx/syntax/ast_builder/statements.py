"""Blocks, comments and contexts of statements."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Collection
from typing import Any, ClassVar, NamedTuple, TypedDict

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr.OpenSCENARIO2 import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Tree
from osc2tx.syntax.ast_builder.expressions import ExpressionBuilder
from osc2tx.syntax.ast_builder.statement_contexts import ALLOWED, Place, help_for
from osc2tx.syntax.comments import CommentTable
from osc2tx.syntax.tokens import Comment, TokenTable

Handler = Callable[[Any, Tree, "Head", Place], ast.Statement | None]

_COLON = t.PUNCTUATION[":"]


class HeadFields(TypedDict):
    """What every statement gets, ready to be passed to a node."""

    span: Span
    comments: tuple[str, ...]
    trailing_comment: str | None


class Head(NamedTuple):
    """Extent and comments of a statement.

    Attributes:
        span: The whole statement.
        comments: Those above it.
        trailing: The comment at the end of its first line.
        inside: Those between the members of an enumeration, not given to anything yet.
    """

    span: Span
    comments: tuple[str, ...] = ()
    trailing: str | None = None
    inside: tuple[Comment, ...] = ()

    def fields(self) -> HeadFields:
        """Return them as keyword arguments."""
        return {
            "span": self.span,
            "comments": self.comments,
            "trailing_comment": self.trailing,
        }


class StatementBuilder(ExpressionBuilder):
    """Walks the blocks of a file and hands each statement to the method that builds it."""

    _handlers: ClassVar[dict[type, Handler]] = {}

    def __init__(self, table: TokenTable, sink: DiagnosticSink, allow: Collection[str]) -> None:
        """Build from `table`; the codes in `allow` are not reported."""
        super().__init__(table, sink, allow)
        self._comments = CommentTable(table)

    def _statement(self, tree: Tree, place: Place) -> ast.Statement | None:
        """Build the statement in a context `statement`; `None` when it cannot be used."""
        if tree.exception is not None:
            return None
        inner = tree.children[0]
        return self._build(inner, self._head(inner), place)

    def _build(self, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
        kind = tree.__class__
        fits = kind not in ALLOWED or place in ALLOWED[kind]
        if not fits and place is not Place.NOWHERE:
            self._report_misplaced(tree, place)
        node = self._handlers[kind](self, tree, head, place)
        return node if fits else None

    def _report_misplaced(self, tree: Tree, place: Place) -> None:
        first = tree.start
        message = f"`{self._text(first)}` does not belong {place.value}"
        self._report("OSC108", self._span(first, first), message, help_for(tree.__class__, place))

    def _head(self, tree: Tree) -> Head:
        """Return extent and comments of the statement that a tree holds."""
        start = tree.start
        comments = self._comments.above(start)
        inside = self._comments.inside(start)
        if not inside:
            return Head(self._tree_span(tree), comments)
        first = inside[0]
        is_trailing = not first.alone and first.before <= self._first_member(tree)
        trailing = first.text if is_trailing else None
        others = tuple(inside[is_trailing:])
        if others and self._enum_members_of(tree) is None:
            comments += tuple(comment.text for comment in inside)
            trailing, others = None, ()
        return Head(self._tree_span(tree), comments, trailing, others)

    def _enum_members_of(self, tree: Tree) -> Tree | None:
        for child in tree.children:
            if child.__class__ is Grammar.EnumMembersContext:
                return child
        return None

    def _first_member(self, tree: Tree) -> int:
        """Index of the first token of an enumeration's first member; the end of others."""
        members = self._enum_members_of(tree)
        return int(members.start + 1 if members is not None else tree.stop)

    # --- Blocks ---------------------------------------------------------------------------------

    def _block(self, block: Tree | None, place: Place) -> tuple[Any, ...]:
        """Build the statements of a block."""
        if block is None:
            return ()
        nodes = []
        for child in block.children:
            if child.__class__ is Grammar.StatementContext:
                node = self._statement(child, place)
                if node is not None:
                    nodes.append(node)
            elif child.__class__ is Grammar.BlockContext:  # its header was not readable
                self._block(child, Place.NOWHERE)
        return tuple(nodes)

    def _block_end(self, block: Tree | None) -> tuple[str, ...]:
        """Return the comments at the end of a block."""
        return () if block is None else self._comments.at_end_of_block(block.stop)

    def _block_of(self, tree: Tree) -> Tree | None:
        """Return the block that is a direct child."""
        for child in tree.children:
            if child.__class__ is Grammar.BlockContext:
                return child
        return None

    def _refuse_block(self, tree: Tree) -> None:
        """Report a block under a statement that has none; look for mistakes in it all the same."""
        block = self._block_of(tree)
        if block is not None:
            self._report_indentation(block)
            self._block(block, Place.NOWHERE)

    def _has_lost_header(self, block: Tree) -> bool:
        """Whether the line above a block consists of unknown characters, reported already."""
        above = self._ends[block.start - 1] if block.start > 0 else 0
        place = bisect_left(self._damaged, above)
        return place < len(self._damaged) and self._damaged[place] < self._starts[block.start]

    def _report_indentation(self, block: Tree) -> None:
        if self._has_lost_header(block):
            return
        first = block.start + 1
        if self._types[first] == t.KEYWORDS["with"]:
            return  # it begins no statement: that is reported already
        span = self._span(first, first)
        message = "the line is indented, but no block is open here"
        help_ = "begin it in column 1"
        if block.start > 0:
            column = self._table.source.position(self._line_start_above(block))[1]
            help_ = f"the line above it begins in column {column}"
        self._report("OSC100", span, message, help_)

    def _line_start_above(self, block: Tree) -> int:
        index: int = block.start - 1
        while index > 0 and self._types[index - 1] not in (t.NEWLINE, t.INDENT, t.DEDENT):
            index -= 1
        return self._starts[max(index, 0)]

    def _body(self, tree: Tree, place: Place, what: str) -> tuple[Any, ...]:
        """Build the block after a header `…:`; the colon and the block need each other."""
        block = self._check_body(tree, what)
        return self._block(block, place)

    def _check_body(self, tree: Tree, what: str, *, optional: bool = True) -> Tree | None:
        """Report a missing colon or block; return the block."""
        block = self._block_of(tree)
        colon = self._tokens(tree, _COLON)
        newline = self._tokens(tree, t.NEWLINE)[0]
        if block is not None and not colon:
            end = Span(self._source, self._ends[newline - 1], self._ends[newline - 1])
            self._report("OSC100", end, f"missing `:` at the end of {what}", "add a `:`")
        elif block is None and colon:
            help_ = "indent its lines, or leave the `:` out" if optional else "indent its lines"
            self._report("OSC112", self._span(colon[0], colon[0]), f"{what} has no lines", help_)
        elif block is None and not optional:
            end = Span(self._source, self._ends[newline - 1], self._ends[newline - 1])
            self._report("OSC100", end, f"missing `:` and indented lines after {what}")
        return block
