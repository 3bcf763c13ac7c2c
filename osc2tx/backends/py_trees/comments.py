"""Comments of the source around the form of a statement: above, behind and below it."""

from __future__ import annotations

from typing import TypedDict

from osc2tx import ir
from osc2tx.backends.py_trees.code import PyComment
from osc2tx.backends.py_trees.formatting import LINE_LENGTH, is_plain


def comments(lines: tuple[str, ...]) -> tuple[PyComment, ...]:
    """Return comment lines of the source as those right above something in the module."""
    return tuple(PyComment.of(line) for line in _without_end(lines))


def _without_end(lines: tuple[str, ...]) -> tuple[str, ...]:
    """Return comment lines without the empty one at their end."""
    return lines[:-1] if lines and not lines[-1] else lines


class Around(TypedDict):
    """The comments around something."""

    comments: tuple[PyComment, ...]
    trailing: PyComment | None
    below: tuple[PyComment, ...]


def around(lines: tuple[str, ...]) -> Around:
    """Return comment lines of a statement as those above, behind and below its code."""
    below = [line for line in lines if isinstance(line, ir.CommentBelow)]
    others = [line for line in lines if not isinstance(line, ir.CommentBelow)]
    trailing = None
    if others and isinstance(others[-1], ir.TrailingComment):
        trailing = PyComment.of(others.pop())
    return {
        "comments": tuple(map(PyComment.of, others)),
        "trailing": trailing,
        "below": tuple(map(PyComment.of, below)),
    }


class Beside(TypedDict):
    """The comments above and behind one line."""

    comments: tuple[PyComment, ...]
    trailing: PyComment | None


def beside(lines: tuple[str, ...], line: str) -> Beside:
    """Return comment lines of code on one line; all above it where they do not fit."""
    found = around(lines)
    trailing = found["trailing"]
    whole = f"{line}  {trailing}"
    is_short = len(whole) <= LINE_LENGTH and is_plain(whole)
    if trailing is None or found["below"] or not is_short:
        return {"comments": comments(lines), "trailing": None}
    return {"comments": found["comments"], "trailing": trailing}
