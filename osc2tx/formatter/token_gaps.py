"""The text between two tokens: comments and line ends."""

from __future__ import annotations

import re

from osc2tx_classes import dataclass

_ITEM = re.compile(
    r"(?P<comment>\#[^\r\n]*+|/\*.*?\*/)|(?P<join>\\)?(?P<end>\r\n|\r|\n)", re.DOTALL
)
_UNSPACED = ("#!", "#:", "##")  # comments that mean something to tools, or draw a line


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment as it will be written.

    Attributes:
        text: With its `#`; or a block comment, as one dialect has them.
        column: Where it stood, from 0; tabs go to multiples of 8.
        alone: Whether nothing preceded it on its line.
        blank_lines: Number of blank lines above it.
    """

    text: str
    column: int
    alone: bool
    blank_lines: int

    @property
    def is_block(self) -> bool:
        """Whether code can follow it on its line."""
        return self.text.startswith("/*")


@dataclass(frozen=True, slots=True)
class Gap:
    """What stands between two tokens.

    Attributes:
        comments: The comments, in order.
        blank_lines: Number of blank lines below the last comment, or in all if there is none.
        joined: Whether a backslash joins two lines here (§9.2.2.5).
    """

    comments: tuple[Comment, ...]
    blank_lines: int
    joined: bool


def read_gap(text: str, start: int, end: int) -> Gap:
    """Return what stands between two offsets of a text that hold no token."""
    comments: list[Comment] = []
    blanks, joined = 0, False
    line_start = max(text.rfind("\n", 0, start), text.rfind("\r", 0, start)) + 1
    is_empty = not text[line_start:start].strip("\ufeff")  # so far on this line
    for item in _ITEM.finditer(text, start, end):
        if item["end"] is not None:
            blanks += is_empty and item["join"] is None
            joined = joined or item["join"] is not None
            line_start, is_empty = item.end(), True
            continue
        column = len(text[line_start : item.start()].expandtabs())
        comments.append(Comment(_written(item["comment"]), column, is_empty, blanks))
        blanks, is_empty = 0, False
    return Gap(tuple(comments), blanks, joined)


def _written(comment: str) -> str:
    """A comment with one blank behind its `#` and none at its end (§9.2.2.4)."""
    comment = comment.rstrip()
    if not comment.startswith("#") or comment.startswith(_UNSPACED) or len(comment) == 1:
        return comment
    body = comment[1:]
    return f"# {body[1:]}" if body[0] in " \t" else f"# {body}"
