"""Blocks, comments and contexts of statements."""

from __future__ import annotations

from bisect import bisect_left
from typing import Any, NamedTuple, TypedDict

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Help, insert, leave_out
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Builder, Tree
from osc2tx.syntax.ast_builder.statement_contexts import ALLOWED, Place, help_for
from osc2tx.syntax.tokens import Comment

_COLON = t.PUNCTUATION[":"]


class HeadFields(TypedDict):
    """The common arguments of nodes of statements."""

    span: Span
    comments: tuple[str, ...]
    trailing_comment: str | None
    comments_below: tuple[str, ...]


class Head(NamedTuple):
    """Extent and comments of a statement.

    Attributes:
        span: The whole statement.
        comments: Those above it.
        trailing: The comment at the end of its first line.
        inside: Those between the members of an enumeration, not given to anything yet.
        below: Those below it.
    """

    span: Span
    comments: tuple[str, ...] = ()
    trailing: str | None = None
    inside: tuple[Comment, ...] = ()
    below: tuple[str, ...] = ()

    def fields(self) -> HeadFields:
        """Return them as keyword arguments."""
        return {
            "span": self.span,
            "comments": self.comments,
            "trailing_comment": self.trailing,
            "comments_below": self.below,
        }


def build_statement(b: Builder, tree: Tree, place: Place) -> ast.Statement | None:
    """Build the statement in a context `statement`; `None` when it cannot be used."""
    if tree.exception is not None:
        return None
    inner = tree.children[0]
    return build_in_place(b, inner, _head(b, inner), place)


def build_in_place(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement | None:
    """Build a statement by its kind; report one that does not belong there."""
    kind = tree.__class__
    fits = kind not in ALLOWED or place in ALLOWED[kind]
    if not fits and place is not Place.NOWHERE:
        _report_misplaced(b, tree, place)
    node: ast.Statement | None = b.builders[kind](b, tree, head, place)
    return node if fits else None


def _report_misplaced(b: Builder, tree: Tree, place: Place) -> None:
    first = tree.start
    message = f"`{b.text_of(first)}` does not belong {place.value}"
    b.report("OSC108", b.span(first, first), message, help_for(tree.__class__, place))


def _head(b: Builder, tree: Tree) -> Head:
    """Return extent and comments of the statement that a tree holds."""
    start = tree.start
    comments, below = b.comments.above(start), b.comments.below(tree.stop + 1)
    inside = b.comments.inside(start)
    if not inside:
        return Head(b.tree_span(tree), comments, below=below)
    first = inside[0]
    is_trailing = not first.alone and first.before <= _first_member(b, tree)
    trailing = first.text if is_trailing else None
    others = tuple(inside[is_trailing:])
    if others and enum_members_of(b, tree) is None:
        comments += tuple(comment.text for comment in inside)
        trailing, others = None, ()
    return Head(b.tree_span(tree), comments, trailing, others, below)


def enum_members_of(b: Builder, tree: Tree) -> Tree | None:
    """Return the list of members in a declaration or extension of an enumeration."""
    for child in tree.children:
        if child.__class__ is Grammar.EnumMembersContext:
            return child
    return None


def _first_member(b: Builder, tree: Tree) -> int:
    """Index of the first token of an enumeration's first member; the end of others."""
    members = enum_members_of(b, tree)
    return int(members.start + 1 if members is not None else tree.stop)


# --- Blocks ---------------------------------------------------------------------------------


def build_block(b: Builder, block: Tree | None, place: Place) -> tuple[Any, ...]:
    """Build the statements of a block."""
    if block is None:
        return ()
    b.comments.pass_end_comments_on(block.stop)
    nodes = []
    for child in block.children:
        if child.__class__ is Grammar.StatementContext:
            node = build_statement(b, child, place)
            if node is not None:
                nodes.append(node)
        elif child.__class__ is Grammar.BlockContext:  # its header was not readable
            build_block(b, child, Place.NOWHERE)
    return tuple(nodes)


def comments_at_end(b: Builder, block: Tree | None) -> tuple[str, ...]:
    """Take the comments at the end of a block; before it is built, else its last member does."""
    return () if block is None else b.comments.at_end_of_block(block.stop)


def block_of(b: Builder, tree: Tree) -> Tree | None:
    """Return the block that is a direct child."""
    for child in tree.children:
        if child.__class__ is Grammar.BlockContext:
            return child
    return None


def refuse_block(b: Builder, tree: Tree) -> None:
    """Report a block below a statement without one; its contents are checked as well."""
    block = block_of(b, tree)
    if block is not None:
        report_indentation(b, block)
        build_block(b, block, Place.NOWHERE)


def has_lost_header(b: Builder, block: Tree) -> bool:
    """Whether the line above a block consists of unknown characters, reported already."""
    above = b.ends[block.start - 1] if block.start > 0 else 0
    place = bisect_left(b.damaged, above)
    return place < len(b.damaged) and b.damaged[place] < b.starts[block.start]


def report_indentation(b: Builder, block: Tree) -> None:
    """Report an indented block below a line that opens none."""
    if has_lost_header(b, block):
        return
    first = block.start + 1
    if b.types[first] == t.KEYWORDS["with"]:
        return  # it begins no statement: that is reported already
    span = b.span(first, first)
    message = "the line is indented, but no block is open here"
    help_ = "begin it in column 1"
    if block.start > 0:
        column = b.table.source.position(_line_start_above(b, block))[1]
        help_ = f"the line above it begins in column {column}"
    b.report("OSC100", span, message, help_)


def _line_start_above(b: Builder, block: Tree) -> int:
    index: int = block.start - 1
    while index > 0 and b.types[index - 1] not in (t.NEWLINE, t.INDENT, t.DEDENT):
        index -= 1
    return b.starts[max(index, 0)]


def _same_column(header: Span) -> str | None:
    """Return the help for a header whose lines are indented by other characters than it is."""
    source, number = header.source, header.line
    if number == len(source.line_starts):
        return None
    above, below = source.line_text(number), source.line_text(number + 1)
    if "\t" not in above[: -len(above.lstrip())] + below[: -len(below.lstrip())]:
        return None
    return (
        f"a tab reaches to the next multiple of 8 columns, so that line {number + 1} is not"
        f" indented more than line {number}: indent by blanks alone"
    )


def build_body(b: Builder, tree: Tree, place: Place, what: str) -> tuple[Any, ...]:
    """Build the block after a header `…:`; the colon and the block need each other."""
    block = check_body(b, tree, what)
    return build_block(b, block, place)


def check_body(b: Builder, tree: Tree, what: str, *, optional: bool = True) -> Tree | None:
    """Report a missing colon or block; return the block."""
    block = block_of(b, tree)
    colon = b.tokens(tree, _COLON)
    newline = b.tokens(tree, t.NEWLINE)[0]
    help_: Help
    if block is not None and not colon:
        end = Span(b.source, b.ends[newline - 1], b.ends[newline - 1])
        help_ = insert(end, ":", "add a `:`")
        b.report("OSC100", end, f"missing `:` at the end of {what}", help_)
    elif block is None and colon:
        span = b.span(colon[0], colon[0])
        without = leave_out(span, "indent its lines, or leave the `:` out", is_safe=False)
        help_ = _same_column(span) or (without if optional else "indent its lines")
        b.report("OSC112", span, f"{what} has no lines", help_)
    elif block is None and not optional:
        end = Span(b.source, b.ends[newline - 1], b.ends[newline - 1])
        b.report("OSC100", end, f"missing `:` and indented lines after {what}")
    return block
