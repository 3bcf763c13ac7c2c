"""Blanks between the tokens of a line."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.formatter.lines import Piece
from osc2tx.syntax.tokens import ID, KEYWORDS, LITERALS, NAMESPACE_STAR, PUNCTUATION

_CALLS = frozenset(
    KEYWORDS[word]
    for word in (
        "keep", "remove_default", "cover", "record", "sample", "serial", "parallel", "one_of"
    )
)  # fmt: skip
_CASTS = frozenset({KEYWORDS["as"], KEYWORDS["is"]})  # after a dot, they are called like methods
OPENERS = frozenset(PUNCTUATION[symbol] for symbol in "([")
CLOSERS = frozenset(PUNCTUATION[symbol] for symbol in ")]")
_TIGHT = frozenset(PUNCTUATION[symbol] for symbol in (".", "..", "!", "::"))
SIGNS = frozenset(PUNCTUATION[symbol] for symbol in "+-")
_AT, _COLON, _COMMA, _DOT, _QUESTION = (PUNCTUATION[symbol] for symbol in "@:,.?")
_OPERAND_ENDS = CLOSERS | LITERALS | {ID, NAMESPACE_STAR}


def blanks_before(pieces: Sequence[Piece]) -> list[str]:
    """Return what to write before each token when all stand on one line: a blank or nothing."""
    blanks: list[str] = []
    questions = [0]  # open conditional expressions in each bracket
    for index, piece in enumerate(pieces):
        blanks.append(" " if index and _is_apart(pieces, index, questions[-1]) else "")
        if piece.kind in OPENERS:
            questions.append(0)
        elif piece.kind in CLOSERS:
            questions = questions[:-1] or [0]
        elif piece.kind == _QUESTION:
            questions[-1] += 1
        elif piece.kind == _COLON and questions[-1]:
            questions[-1] -= 1
    return blanks


def _is_apart(pieces: Sequence[Piece], index: int, questions: int) -> bool:
    """Whether a blank separates a token from the one before it."""
    before, kind = pieces[index - 1].kind, pieces[index].kind
    if before in _TIGHT or before in OPENERS or before == _AT:
        return False
    if kind in _TIGHT or kind in CLOSERS or kind == _COMMA:
        return False
    if kind == _COLON:
        return bool(questions)  # that of `condition ? one : other`
    if kind in OPENERS:
        return not (_is_called(pieces, index - 1) or is_sign(pieces, index - 1))
    return not is_sign(pieces, index - 1)


def _is_called(pieces: Sequence[Piece], index: int) -> bool:
    """Whether a bracket behind this token belongs to it: a call or an index."""
    kind = pieces[index].kind
    if kind in _CASTS:
        return index > 0 and pieces[index - 1].kind == _DOT
    return kind in _OPERAND_ENDS or kind in _CALLS


def is_sign(pieces: Sequence[Piece], index: int) -> bool:
    """Whether a token is the sign of what follows."""
    if pieces[index].kind not in SIGNS:
        return False
    return index == 0 or pieces[index - 1].kind not in _OPERAND_ENDS
