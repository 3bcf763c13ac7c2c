"""One logical line on one or several physical lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from osc2tx.formatter.lines import LogicalLine, Piece
from osc2tx.formatter.spacing import CLOSERS, OPENERS, SIGNS, blanks_before, is_sign
from osc2tx.syntax.tokens import KEYWORDS, PUNCTUATION

LINE_LENGTH = 100
INDENT_WIDTH = 4

BEHIND = 2
"""Closing brackets that are behind those of a call in others."""
_COMMA, _LIST = PUNCTUATION[","], PUNCTUATION["["]
_LOGIC = frozenset({KEYWORDS["and"], KEYWORDS["or"], PUNCTUATION["=>"]})
_COMPARISONS = frozenset(PUNCTUATION[sign] for sign in ("==", "!=", "<", "<=", ">", ">="))


def lay_out(line: LogicalLine) -> list[str]:
    """Return the physical lines of a logical line that has tokens, comments included.

    What fits stands on one line. What does not is broken inside of brackets, the last ones first.
    Their content goes on a line of its own; if it does not fit there, one argument a line, or one
    operand. Of brackets around a call or a list with nothing behind it, the inner ones are broken.
    So is a list that is the first argument, if the others fit behind it.
    Outside of brackets only the author's own backslashes break a line that is too long.
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
        self._openers = {closer: opener for opener, closer in self._closers.items()}
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
        """Write the content of brackets on lines of its own, and the closing bracket."""
        inner, closer = width + INDENT_WIDTH, self._closers[opener]
        parts = self._parts(opener + 1, closer, inner)
        if len(parts) > 1 and (leading := self._leading_list(parts, closer, width)) is not None:
            self._write_around(opener + 1, leading, closer, width)
            return
        if not parts and (last := self._last_group(opener + 1, closer)) is not None:
            for index in range(opener + 1, last + 1):
                self._write_token(index, width, spaced=index > opener + 1)
            self._explode(last, width)
            self._write_token(closer, width, spaced=False)
            return
        for first, last in parts or self._operands(opener + 1, closer, inner):
            self._break(first, inner)
            comma = last < closer and self._pieces[last].kind == _COMMA
            self._write(first, last, inner, after=comma)
            if comma:
                self._write_token(last, inner, spaced=False)
        self._break(closer, width, comments_at=inner)
        self._current += self._pieces[closer].text

    def _write_around(self, first: int, opener: int, closer: int, width: int) -> None:
        """Write the content of brackets, with one pair in it broken, and the closing one."""
        for index in range(first, opener + 1):
            self._write_token(index, width, spaced=index > first)
        self._explode(opener, width)
        for index in range(self._closers[opener] + 1, closer + 1):
            self._write_token(index, width, spaced=index < closer)

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
        needed: list[int] = []
        while optional and not self._fits(first, last, width, after, chosen.union(needed)):
            needed.append(optional.pop(0))
        for opener in needed[:-1]:
            others = chosen.union(needed) - {opener}
            if self._fits(first, last, width, after, others):
                needed.remove(opener)
        return chosen.union(needed)

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
        return self._are_commented(opener + 1, self._closers[opener] + 1)

    def _are_commented(self, first: int, last: int) -> bool:
        """Whether comments that end their lines stand before some tokens."""
        pieces = self._pieces[first:last]
        return any(not each.is_block for piece in pieces for each in piece.comments)

    def _is_short(self, first: int, last: int, column: int) -> bool:
        """Whether tokens fit on a line, from a column on."""
        width = sum(
            len(self._blanks[at] * (at > first) + self._pieces[at].text)
            for at in range(first, last)
        )
        return column + width <= LINE_LENGTH and not self._are_commented(first, last)

    def _parts(self, first: int, closer: int, column: int) -> list[tuple[int, int]]:
        """Return what of the content of brackets stands on a line each; nothing if there is none.

        All of it if that fits, else what is between commas, else between operators of logic.
        """
        if self._is_short(first, closer, column) and not self._are_commented(closer, closer + 1):
            return [(first, closer)]
        return self._split(first, closer, frozenset({_COMMA}), skip=1) or self._split(
            first, closer, _LOGIC, skip=0
        )

    def _last_group(self, first: int, closer: int) -> int | None:
        """Return the opening bracket of what ends the content of brackets, to break it instead.

        `None`: nothing does, or comments are in the way.
        """
        last = self._openers.get(closer - 1)
        if last is None or last < first or self._are_commented(closer, closer + 1):
            return None
        return last if self._is_short(first, last + 1, len(self._current)) else None

    def _leading_list(
        self, parts: Sequence[tuple[int, int]], closer: int, width: int
    ) -> int | None:
        """Return the opening bracket of a list that is the first argument, to break it instead.

        `None`: it is none, or the others do not fit behind it.
        """
        first, last = parts[0]
        opener = self._openers.get(last - 1)
        if opener is None or self._pieces[opener].kind != _LIST:
            return None
        is_begun = self._is_short(first, opener + 1, len(self._current))
        is_ended = self._is_short(last - 1, min(len(self._pieces), closer + 1 + BEHIND), width)
        return opener if is_begun and is_ended else None

    def _operands(self, first: int, closer: int, column: int) -> list[tuple[int, int]]:
        """Return the operands of a comparison, else of a sum, if each fits on a line; else all."""
        for signs in (_COMPARISONS, SIGNS):
            found = self._split(first, closer, signs, skip=0)
            if found and all(self._is_short(*each, column) for each in found):
                return found
        return [(first, closer)] if closer > first else []

    def _split(
        self, first: int, last: int, separators: frozenset[int], *, skip: int
    ) -> list[tuple[int, int]]:
        """Split at separators outside of brackets; nothing if there is none."""
        parts: list[tuple[int, int]] = []
        start = index = first
        while index < last:
            if self._pieces[index].kind in separators and not is_sign(self._pieces, index):
                parts.append((start, index))
                start = index + skip
            index = self._closers.get(index, index) + 1
        return [*parts, (start, last)] if parts else []


def _match_brackets(pieces: Sequence[Piece]) -> dict[int, int]:
    """Index of the closing bracket by that of the opening one."""
    closers: dict[int, int] = {}
    opened: list[int] = []
    for index, piece in enumerate(pieces):
        if piece.kind in OPENERS:
            opened.append(index)
        elif piece.kind in CLOSERS and opened:
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
