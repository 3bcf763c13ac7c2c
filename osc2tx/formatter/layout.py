"""One logical line on one or several physical lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from osc2tx.formatter.lines import LogicalLine, Piece
from osc2tx.syntax.tokens import ID, KEYWORDS, LITERALS, NAMESPACE_STAR, PUNCTUATION

LINE_LENGTH = 100
INDENT_WIDTH = 4

_OPENERS = frozenset(PUNCTUATION[symbol] for symbol in "([")
_CLOSERS = frozenset(PUNCTUATION[symbol] for symbol in ")]")
_COMMA = PUNCTUATION[","]
_BREAKABLE = frozenset({KEYWORDS["and"], KEYWORDS["or"], PUNCTUATION["=>"]})


def lay_out(line: LogicalLine) -> list[str]:
    """Return the physical lines of a logical line that has tokens, comments included.

    What fits stands on one line. What does not is broken inside of brackets, the last ones first:
    one argument a line, or one operand of `and`, `or`, `=>`. Outside of brackets only the author's
    own backslashes break a line that is too long.
    """
    width = INDENT_WIDTH * line.depth
    lines = _Layout(line.pieces).write_all(width)
    if len(lines) == 1 and len(lines[0]) > LINE_LENGTH:
        lines = _broken_by_backslashes(line.pieces, width)
    lines[-1] += "".join(f"  {comment.text}" for comment in line.trailing)
    return lines


class _Layout:
    """The lines written so far, and the one being written."""

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self._pieces = pieces
        self._blanks = blanks_before(pieces)
        self._closers = _match_brackets(pieces)
        self._lines: list[str] = []
        self._current = ""
        self._written = 0  # tokens whose comments are written

    def write_all(self, width: int) -> list[str]:
        self._current = " " * width
        self._write(0, len(self._pieces), width, after=0)
        return [*self._lines, self._current]

    def _write(self, first: int, last: int, width: int, *, after: int) -> None:
        """Write tokens; broken lines continue at a column, and `after` characters follow."""
        exploded = self._choose(first, last, width, after)
        index = first
        while index < last:
            self._write_token(index, width, spaced=index > first)
            if index in exploded:
                self._explode(index, width)
                index = self._closers[index]
            index += 1

    def _write_token(self, index: int, width: int, *, spaced: bool) -> None:
        comments = self._pieces[index].comments if index >= self._written else ()
        if all(comment.is_block for comment in comments):
            self._current += "".join(f" {comment.text}" for comment in comments)
        else:
            self._break(index, width)
            spaced = False
        self._current += (self._blanks[index] if spaced else "") + self._pieces[index].text

    def _explode(self, opener: int, width: int) -> None:
        """Write the content of brackets, each part on lines of its own, and the closing bracket."""
        inner, closer = width + INDENT_WIDTH, self._closers[opener]
        for first, last in self._parts(opener, closer):
            self._break(first, inner)
            comma = last < closer and self._pieces[last].kind == _COMMA
            self._write(first, last, inner, after=comma)
            if comma:
                self._write_token(last, inner, spaced=False)
        self._break(closer, width, comments_at=inner)
        self._current += self._pieces[closer].text

    def _break(self, index: int, width: int, *, comments_at: int | None = None) -> None:
        """End the line; comments before a token follow, then a line for it begins."""
        comments = self._pieces[index].comments
        trailing = 0
        while trailing < len(comments) and not comments[trailing].alone:
            self._current += f"  {comments[trailing].text}"
            trailing += 1
        self._lines.append(self._current)
        blanks = " " * (width if comments_at is None else comments_at)
        self._lines += [blanks + comment.text for comment in comments[trailing:]]
        self._current = " " * width
        self._written = index + 1

    # --- What to break --------------------------------------------------------------------------

    def _choose(self, first: int, last: int, width: int, after: int) -> set[int]:
        """Return the outermost opening brackets whose contents need lines of their own.

        The fewest from the right that do; brackets around comments always do.
        """
        groups = list(self._groups(first, last))
        chosen = {opener for opener in groups if self._has_comments(opener)}
        optional = [
            opener
            for opener in reversed(groups)
            if opener not in chosen and self._closers[opener] > opener + 2
        ]
        while optional and not self._fits(first, last, width, after, chosen):
            chosen.add(optional.pop(0))
        return chosen

    def _fits(self, first: int, last: int, width: int, after: int, exploded: set[int]) -> bool:
        """Whether the text outside of the exploded brackets fits on its lines."""
        column, index = len(self._current), first
        while index < last:
            column += len(self._pieces[index].text) + (
                len(self._blanks[index]) if index > first else 0
            )
            if column + (after if index == last - 1 else 0) > LINE_LENGTH:
                return False
            if index in exploded:
                index, column = self._closers[index] - 1, width
            index += 1
        return True

    def _groups(self, first: int, last: int) -> Iterator[int]:
        index = first
        while index < last:
            if index in self._closers:
                yield index
                index = self._closers[index]
            index += 1

    def _has_comments(self, opener: int) -> bool:
        inside = self._pieces[opener + 1 : self._closers[opener] + 1]
        return any(not each.is_block for piece in inside for each in piece.comments)

    def _parts(self, opener: int, closer: int) -> list[tuple[int, int]]:
        """Ranges of tokens between commas; without commas, between operators of logic."""
        return (
            self._split(opener + 1, closer, frozenset({_COMMA}), skip=1)
            or self._split(opener + 1, closer, _BREAKABLE, skip=0)
            or ([(opener + 1, closer)] if closer > opener + 1 else [])
        )

    def _split(
        self, first: int, last: int, separators: frozenset[int], *, skip: int
    ) -> list[tuple[int, int]]:
        """Split at separators outside of brackets; nothing if there is none."""
        parts: list[tuple[int, int]] = []
        start = index = first
        while index < last:
            if self._pieces[index].kind in separators:
                parts.append((start, index))
                start = index + skip
            index = self._closers.get(index, index) + 1
        return [*parts, (start, last)] if parts else []


def _match_brackets(pieces: Sequence[Piece]) -> dict[int, int]:
    """Index of the closing bracket by that of the opening one."""
    closers: dict[int, int] = {}
    opened: list[int] = []
    for index, piece in enumerate(pieces):
        if piece.kind in _OPENERS:
            opened.append(index)
        elif piece.kind in _CLOSERS and opened:
            closers[opened.pop()] = index
    return closers


def _broken_by_backslashes(pieces: Sequence[Piece], width: int) -> list[str]:
    lines = [" " * width]
    for index, (piece, blank) in enumerate(zip(pieces, blanks_before(pieces), strict=True)):
        if piece.joined and index:
            lines[-1] += " \\"
            lines.append(" " * (width + INDENT_WIDTH))
            blank = ""
        lines[-1] += blank + piece.text
    return lines


_CALLS = frozenset(
    KEYWORDS[word]
    for word in (
        "keep", "remove_default", "cover", "record", "sample", "serial", "parallel", "one_of"
    )
)  # fmt: skip
_CASTS = frozenset({KEYWORDS["as"], KEYWORDS["is"]})  # after a dot, they are called like methods
_OPENERS = frozenset(PUNCTUATION[symbol] for symbol in "([")
_CLOSERS = frozenset(PUNCTUATION[symbol] for symbol in ")]")
_TIGHT = frozenset(PUNCTUATION[symbol] for symbol in (".", "..", "!", "::"))
_SIGNS = frozenset(PUNCTUATION[symbol] for symbol in "+-")
_AT, _COLON, _COMMA, _DOT, _QUESTION = (PUNCTUATION[symbol] for symbol in "@:,.?")
_OPERAND_ENDS = _CLOSERS | LITERALS | {ID, NAMESPACE_STAR}


def blanks_before(pieces: Sequence[Piece]) -> list[str]:
    """Return what to write before each token when all stand on one line: a blank or nothing."""
    blanks: list[str] = []
    questions = [0]  # open conditional expressions in each bracket
    for index, piece in enumerate(pieces):
        blanks.append(" " if index and _is_apart(pieces, index, questions[-1]) else "")
        if piece.kind in _OPENERS:
            questions.append(0)
        elif piece.kind in _CLOSERS:
            questions = questions[:-1] or [0]
        elif piece.kind == _QUESTION:
            questions[-1] += 1
        elif piece.kind == _COLON and questions[-1]:
            questions[-1] -= 1
    return blanks


def _is_apart(pieces: Sequence[Piece], index: int, questions: int) -> bool:
    """Whether a blank separates a token from the one before it."""
    before, kind = pieces[index - 1].kind, pieces[index].kind
    if before in _TIGHT or before in _OPENERS or before == _AT:
        return False
    if kind in _TIGHT or kind in _CLOSERS or kind == _COMMA:
        return False
    if kind == _COLON:
        return bool(questions)  # that of `condition ? one : other`
    if kind in _OPENERS:
        return not (_is_called(pieces, index - 1) or _is_sign(pieces, index - 1))
    return not _is_sign(pieces, index - 1)


def _is_called(pieces: Sequence[Piece], index: int) -> bool:
    """Whether a bracket behind this token belongs to it: a call or an index."""
    kind = pieces[index].kind
    if kind in _CASTS:
        return index > 0 and pieces[index - 1].kind == _DOT
    return kind in _OPERAND_ENDS or kind in _CALLS


def _is_sign(pieces: Sequence[Piece], index: int) -> bool:
    """Whether a token is the sign of what follows."""
    if pieces[index].kind not in _SIGNS:
        return False
    return index == 0 or pieces[index - 1].kind not in _OPERAND_ENDS
