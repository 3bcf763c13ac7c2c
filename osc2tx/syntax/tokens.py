"""The tokens of one source text, as parallel lists, and the names of their types."""

from __future__ import annotations

from dataclasses import field
from typing import NamedTuple

from osc2tx.diagnostics import SourceFile, Span
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx_shared.classes import dataclass

EOF = -1
NEWLINE: int = Grammar.NEWLINE
INDENT: int = Grammar.INDENT
DEDENT: int = Grammar.DEDENT
ID: int = Grammar.ID
INTEGER: int = Grammar.INTEGER
FLOAT: int = Grammar.FLOAT
PHYSICAL: int = Grammar.PHYSICAL
STRING: int = Grammar.STRING
NAMESPACE_STAR: int = Grammar.NAMESPACE_STAR

_LITERALS: dict[str, int] = {
    literal.strip("'"): number
    for number, literal in enumerate(Grammar.literalNames)
    if literal != "<INVALID>"
}
KEYWORDS: dict[str, int] = {text: n for text, n in _LITERALS.items() if text.isidentifier()}
PUNCTUATION: dict[str, int] = {text: n for text, n in _LITERALS.items() if text not in KEYWORDS}
SPELLING: dict[int, str] = {number: text for text, number in _LITERALS.items()}
KEYWORD_TYPES = frozenset(KEYWORDS.values())
WORDS = KEYWORD_TYPES | {ID}
LITERALS = frozenset({INTEGER, FLOAT, PHYSICAL, STRING})


class Comment(NamedTuple):
    """A comment and its position among the tokens.

    Attributes:
        before: Index of the first token after it.
        line: Index of the first token of its logical line; `None` between lines.
        alone: Whether nothing precedes it on its physical line.
        column: Its column, from 0, when it is alone.
        blank_lines: Number of blank lines above it, when it is between lines.
        text: The text after `#`, without one leading and all trailing blanks.
    """

    before: int
    line: int | None
    alone: bool
    column: int
    blank_lines: int
    text: str


@dataclass(slots=True, eq=False)
class TokenTable:
    """All tokens of a source, the last of type `EOF`; comments and layout are separate.

    Attributes:
        source: The text.
        types: Type of each token.
        starts: Offset of its first character.
        ends: Offset behind its last character.
        comments: The comments, in order.
        widths: Column of the block that an INDENT token opens or a DEDENT token closes, by token
            index.
        blank_lines: Number of blank lines directly above a line of code, where there are any, by
            the index of its first token, layout included.
        damaged: Offsets of lexical mistakes, which are reported already.
    """

    source: SourceFile
    types: list[int] = field(default_factory=list)
    starts: list[int] = field(default_factory=list)
    ends: list[int] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    widths: dict[int, int] = field(default_factory=dict)
    blank_lines: dict[int, int] = field(default_factory=dict)
    damaged: list[int] = field(default_factory=list)

    def text(self, index: int) -> str:
        """Return the source text of a token."""
        return self.source.text[self.starts[index] : self.ends[index]]

    def span(self, first: int, last: int) -> Span:
        """Return the span from the token `first` up to the token `last`."""
        return Span(self.source, self.starts[first], self.ends[last])

    def line_start(self, offset: int) -> int:
        """Return the offset at which the physical line of `offset` begins."""
        return offset - self.source.position(offset)[1] + 1

    def indentation(self, offset: int) -> int:
        """Return the column of the text that begins at an offset, the first one on its line."""
        return column_after(self.source.text[self.line_start(offset) : offset])

    def below(self, offset: int) -> str:
        """Return the indentation of a line below the line of an offset, in its block."""
        line = self.source.text[self.line_start(offset) : offset]
        return " " * (column_after(line[: len(line) - len(line.lstrip())]) + 4)


def column_after(blanks: str) -> int:
    """Return the column after blanks: tabs go to multiples of 8, a form feed starts anew."""
    if blanks.isspace() and blanks.count(" ") == len(blanks):
        return len(blanks)
    column = 0
    for char in blanks:
        if char == "\t":
            column = (column // 8 + 1) * 8
        elif char == "\f":
            column = 0
        else:
            column += 1
    return column
