"""Decides which words are keywords; every word of the language is one only in its place.

The scanner gives each word that *could* be a keyword the type of that keyword. `decide_keywords`
visits those from left to right and turns each back into an identifier unless the decided tokens
before it and the next one or two after it make it a keyword. Where a word cannot be a name either,
it stays a keyword, because the parser then has the better message.
"""

from __future__ import annotations

from osc2tx.syntax.tokens import (
    DEDENT,
    EOF,
    ID,
    INDENT,
    KEYWORDS,
    LITERALS,
    NEWLINE,
    PUNCTUATION,
    WORDS,
)

_AS, _IS, _NOT, _OF, _WITH = (KEYWORDS[word] for word in ("as", "is", "not", "of", "with"))
_DO, _ON, _WAIT, _UNTIL = (KEYWORDS[word] for word in ("do", "on", "wait", "until"))
_DEF, _EMIT, _KEEP, _ONLY, _VAR = (KEYWORDS[w] for w in ("def", "emit", "keep", "only", "var"))
_LIST, _RANGE, _NAMESPACE, _USE = (KEYWORDS[w] for w in ("list", "range", "namespace", "use"))
_ARROW, _ASSIGN, _AT, _COLON, _COMMA, _DOT = (
    PUNCTUATION[s] for s in ("->", "=", "@", ":", ",", ".")
)
_LBRACKET, _RBRACKET, _LPAREN, _RPAREN, _MINUS = (PUNCTUATION[s] for s in "[]()-")


def _types(words: str) -> frozenset[int]:
    return frozenset(KEYWORDS[word] for word in words.split())


_HEADS = _types(
    "import namespace use export type unit enum struct actor scenario action modifier extend "
    "global event var def"
)
_CONSTRAINTS = _types("keep remove_default cover record")
_DIRECTIVES = _types("do on wait call until emit")
_COMPOSITIONS = _types("serial parallel one_of")
_INFIX = _types("is as if and or in inherits of")
_DO_MEMBER_WORDS = _COMPOSITIONS | _types("wait call emit keep until")
_STRENGTHS = _types("default hard")
_BODIES = _types("expression undefined external")
_NAMING = _types("event var def emit struct actor scenario action modifier enum unit type extend")

_LINE_STARTS = frozenset({NEWLINE, INDENT, DEDENT, EOF})
_OPERAND_ENDS = LITERALS | {ID, _RPAREN, _RBRACKET}
_OPERAND_STARTS = (WORDS - _types("is as if and or in inherits of with")) | LITERALS
_OPERAND_STARTS_OR_OPENERS = _OPERAND_STARTS | {_LPAREN, _LBRACKET, _MINUS}
_AFTER_A_NAME = frozenset({_COLON, _COMMA, _DOT, _ASSIGN})
_NO_PLACE_FOR_A_NAME = (
    frozenset(PUNCTUATION.values()) - {_RPAREN, _RBRACKET, _DOT, _COLON, _COMMA}
) | {_NOT}


def decide_keywords(types: list[int], candidates: list[tuple[int, int]]) -> None:
    """Settle the types of the words that could be keywords.

    Args:
        types: Token types; those of the candidates are changed in place.
        candidates: Index of each such word and of the first token of its logical line.
    """
    for index, line in candidates:
        if not _is_keyword(types, index, line):
            types[index] = ID


def _is_keyword(types: list[int], index: int, line: int) -> bool:
    kind, before, after = types[index], types[index - 1], types[index + 1]
    if before == _DOT:
        return kind in (_AS, _IS) and after == _LPAREN
    if kind in _INFIX:
        return _is_infix_keyword(types, index)
    if index == line:
        return _is_statement_keyword(types, index)
    if kind in _DO_MEMBER_WORDS and _follows_do_or_label(types, index, line):
        return _is_do_member_keyword(types, index)
    if kind == _WITH:
        return before in _OPERAND_ENDS
    if kind == _NOT:
        return before not in _OPERAND_ENDS and after in _OPERAND_STARTS_OR_OPENERS
    if kind in _STRENGTHS:
        opens_keep = before == _LPAREN and types[index - 2] == _KEEP
        return opens_keep and after in (_OPERAND_STARTS | {_LPAREN, _MINUS})
    if kind in (_LIST, _RANGE):
        return after == _OF and before in (_COLON, _OF, _ARROW, _LPAREN)
    return _is_clause_keyword(types, index, line)


def _is_clause_keyword(types: list[int], index: int, line: int) -> bool:
    """Words that are keywords in one kind of statement only."""
    kind, before, head = types[index], types[index - 1], types[line]
    if kind == _USE:
        return head == _NAMESPACE and before == ID
    if kind == KEYWORDS["sample"]:
        return head == _VAR and before == _ASSIGN and types[index + 1] == _LPAREN
    if kind == _ONLY:
        return head == _DEF and before == _IS
    return kind in _BODIES and head == _DEF and before in (_IS, _ONLY)


def _is_infix_keyword(types: list[int], index: int) -> bool:
    kind, before, after = types[index], types[index - 1], types[index + 1]
    if before in _OPERAND_ENDS:
        return True
    if kind == _OF:
        return before in (_LIST, _RANGE)
    if before in _LINE_STARTS or before in _NAMING:
        return False
    return before in _NO_PLACE_FOR_A_NAME and (after == ID or after in LITERALS)


def _is_statement_keyword(types: list[int], index: int) -> bool:
    """At the start of a line."""
    kind, after, second = types[index], types[index + 1], types[index + 2]
    if kind in _COMPOSITIONS:
        return _is_do_member_keyword(types, index)
    if kind == _NOT:
        return after in _OPERAND_STARTS
    if kind == _WITH:
        return after == NEWLINE or (after == _COLON and second == NEWLINE)
    if kind == _DO and after == _COLON:
        return second == NEWLINE
    if kind in (_ON, _WAIT, _UNTIL) and after == _COLON:
        return second == _AT
    if kind in _HEADS or kind == _EMIT:
        return after not in _AFTER_A_NAME and after not in (_LPAREN, _LBRACKET)
    return (kind in _CONSTRAINTS or kind in _DIRECTIVES) and after not in _AFTER_A_NAME


def _is_do_member_keyword(types: list[int], index: int) -> bool:
    """After `do` or a label, and for compositions at the start of a line."""
    after = types[index + 1]
    if types[index] not in _COMPOSITIONS:
        return after not in _AFTER_A_NAME and after != NEWLINE
    if after == _COLON:
        return types[index + 2] == NEWLINE
    return after not in _AFTER_A_NAME


def _follows_do_or_label(types: list[int], index: int, line: int) -> bool:
    before = types[index - 1]
    if before == _DO:
        return True
    if before != _COLON:
        return False
    label = index - 2
    if types[label] == _WITH:
        return True
    return types[label] == ID and (label == line or types[label - 1] == _DO)
