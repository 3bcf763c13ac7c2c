"""The lexer: a regular expression for tokens, indentation for blocks (§7.2.1)."""

from __future__ import annotations

from collections.abc import Collection

from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.syntax import patterns
from osc2tx.syntax.keywords import decide_keywords
from osc2tx.syntax.lexical_errors import LexicalErrors
from osc2tx.syntax.patterns import identifier_end
from osc2tx.syntax.tokens import (
    DEDENT,
    EOF,
    FLOAT,
    ID,
    INDENT,
    INTEGER,
    KEYWORDS,
    NAMESPACE_STAR,
    NEWLINE,
    PHYSICAL,
    PUNCTUATION,
    STRING,
    Comment,
    TokenTable,
    column_after,
)

MAX_NESTING = 200
MAX_LINE_TOKENS = 200_000  # of one logical line: a tree for more would take gigabytes

_PLAIN_TYPES = {
    patterns.NAME: ID,
    patterns.STAR: NAMESPACE_STAR,
    patterns.PHYSICAL: PHYSICAL,
    patterns.HEXADECIMAL: INTEGER,
    patterns.FLOAT: FLOAT,
    patterns.INTEGER: INTEGER,
    patterns.STRING: STRING,
}
_NESTING = frozenset("()[]?,")


class _TooMuch(Exception):
    """Unwinds to the file-level statement that nests too deeply or has too long a line."""


class TokenSource:
    """Scans one source text into a `TokenTable`; never fails."""

    def __init__(
        self, source: SourceFile, sink: DiagnosticSink, *, allow: Collection[str] = frozenset()
    ) -> None:
        """Prepare; `allow` has the codes of deviations that are fine: see `parse`."""
        self.table = TokenTable(source)
        self._text = source.text
        self._errors = LexicalErrors(self.table, sink, allow=allow)
        self._candidates: list[tuple[int, int]] = []
        self._indents = [0]
        self._mistaken: dict[int, int] = {}  # columns of wrong dedents, and of the block meant
        self._brackets: list[int] = []  # token indexes of those still open
        self._questions = [0]  # open `?` per bracket level
        self._line: int | None = None  # index of the first token of the current logical line
        self._indent_of_line = 0
        self._blank_lines = 0  # in a row, above where we are
        self._strict_layout = False  # an unclosed bracket was found: close at the next statement
        self._statement_start = (0, 0)  # number of tokens and comments before the statement

    def scan(self) -> TokenTable:
        """Return the tokens of the whole text."""
        pos = 1 if self._text.startswith("\ufeff") else 0
        while pos < len(self._text):
            try:
                pos = self._scan_lines(pos)
            except _TooMuch:
                pos = self._drop_statement()
        self._end_line(len(self._text), len(self._text))
        self._set_indentation(0, len(self._text))
        self._append(EOF, len(self._text), len(self._text))
        decide_keywords(self.table.types, self._candidates)
        return self.table

    # --- Lines ----------------------------------------------------------------------------------

    def _scan_lines(self, pos: int) -> int:
        """Scan from the start of a logical line; return early to have another part rescanned."""
        size = len(self._text)
        while pos < size:
            if self._line is None:
                pos = self._scan_line_head(pos)
            if self._line is None:
                continue
            pos = self._scan_tokens(pos)
            if pos >= size and self._brackets:
                pos = self._recover_from_open_bracket()
        return pos

    def _scan_line_head(self, pos: int) -> int:
        """Skip lines without tokens; open or close blocks before the first token of a line."""
        match = patterns.LINE_HEAD.match(self._text, pos)
        assert match is not None
        if match[3] is not None:
            if match[2] is not None:
                self._add_comment(match.start(2), match.end(2), alone=True)
            elif self.table.line_start(pos) == pos:
                self._blank_lines += 1
            return match.end() if match[3] else len(self._text)
        end = match.end(1)
        if self._text.startswith(("/*", "//"), end):
            return self._skip_foreign_comment(end)
        self._begin_line(column_after(match[1]), end)
        return end

    def _begin_line(self, width: int, at: int) -> None:
        if self._blank_lines:
            self.table.blank_lines[len(self.table.types)] = self._blank_lines
            self._blank_lines = 0
        self._set_indentation(width, at)
        if width == 0:
            self._statement_start = (len(self.table.types), len(self.table.comments))
        self._line = len(self.table.types)
        self._indent_of_line = width

    def _set_indentation(self, width: int, at: int) -> None:
        indents = self._indents
        if width > indents[-1]:
            indents.append(width)
            self._check_nesting(at)
            self.table.widths[len(self.table.types)] = width
            self._append(INDENT, at, at)
            return
        if width not in indents:
            width = self._nearest_block(width, at)
        while width < indents[-1]:
            self.table.widths[len(self.table.types)] = indents.pop()
            self._append(DEDENT, at, at)

    def _nearest_block(self, width: int, at: int) -> int:
        """Take a line between two open blocks as one of the nearer block; report it once."""
        nearest = self._mistaken.get(width)
        if nearest is None or nearest not in self._indents:
            nearest = min(self._indents, key=lambda column: (abs(column - width), -column))
            self._errors.inconsistent_dedent(at, width, self._indents, nearest)
            self._mistaken[width] = nearest
        return nearest

    def _end_line(self, start: int, end: int) -> None:
        if self._line is not None:
            if self._line < len(self.table.types):
                self._append(NEWLINE, start, end)
            self._line = None
            self._brackets.clear()
            self._questions = [0]

    # --- Tokens ---------------------------------------------------------------------------------

    def _scan_tokens(self, pos: int) -> int:
        """Scan up to the end of the logical line; the hot loop."""
        text, table, candidates = self._text, self.table, self._candidates
        types, starts, ends = table.types, table.starts, table.ends
        match_token = patterns.TOKEN.match
        word_type, punctuation, line = KEYWORDS.get, PUNCTUATION, self._line
        assert line is not None
        while match := match_token(text, pos):
            kind = match.lastindex
            assert kind is not None
            start, end = match.span(kind)
            pos = end
            if kind == patterns.WORD:
                word = match[kind]
                if not word.isascii() or (end < len(text) and text[end] > "\x7f"):
                    pos = end = identifier_end(text, start)
                    if end == start:
                        pos = self._errors.unknown_character(start)
                        continue
                type_ = word_type(word, ID)
                if type_ != ID:
                    candidates.append((len(types), line))
                types.append(type_)
            elif kind == patterns.PUNCTUATION:
                symbol = match[kind]
                if symbol in _NESTING:
                    self._nest(symbol, start)
                types.append(punctuation[symbol])
            elif kind in _PLAIN_TYPES:
                types.append(_PLAIN_TYPES[kind])
            elif kind == patterns.NEWLINE:
                if not self._brackets or self._closes_brackets(end):
                    self._check_length(line, start)
                    self._end_line(start, end)
                    return end
                continue
            else:
                pos = self._scan_rare(kind, start, end)
                continue
            starts.append(start)
            ends.append(end)
        self._check_length(line, len(text))
        return len(text)

    def _scan_rare(self, kind: int, start: int, end: int) -> int:
        """Comments, joined lines and mistakes; return where to continue."""
        if kind == patterns.COMMENT:
            self._add_comment(start, end, alone=self._is_first_on_line(start))
        elif kind == patterns.FOREIGN_COMMENT:
            return self._skip_foreign_comment(start)
        elif kind == patterns.QUOTE:
            end = self._errors.unterminated_string(start)
            self._append(STRING, start, end)
            self._brackets.clear()
            self._questions = [0]
        elif kind == patterns.UNKNOWN:
            return self._errors.unknown_character(start)
        return end

    def _append(self, type_: int, start: int, end: int) -> None:
        self.table.types.append(type_)
        self.table.starts.append(start)
        self.table.ends.append(end)

    # --- Comments -------------------------------------------------------------------------------

    def _is_first_on_line(self, start: int) -> bool:
        return not self._text[self.table.line_start(start) : start].strip()

    def _add_comment(self, start: int, end: int, *, alone: bool) -> None:
        column = column_after(self._text[self.table.line_start(start) : start]) if alone else 0
        body = self._text[start + 1 : end].rstrip()
        body = body[1:] if body.startswith((" ", "\t")) else body
        place = len(self.table.types)
        blank_lines, self._blank_lines = self._blank_lines, 0
        comment = Comment(place, self._line, alone, column, blank_lines, body)
        self.table.comments.append(comment)

    def _skip_foreign_comment(self, start: int) -> int:
        end = self._errors.foreign_comment(start)
        if self._line is None:
            rest = patterns.LINE_HEAD.match(self._text, end)
            if rest is not None and rest[3] is None:
                blanks = self._text[self.table.line_start(start) : start]
                self._begin_line(column_after(blanks) if not blanks.strip() else 0, rest.end(1))
                return rest.end(1)
        return end

    # --- Nesting --------------------------------------------------------------------------------

    def _nest(self, symbol: str, at: int) -> None:
        questions, brackets = self._questions, self._brackets
        if symbol == "?":
            questions[-1] += 1
            self._check_nesting(at)
        elif symbol == ",":
            questions[-1] = 0
        elif symbol in "([":
            brackets.append(len(self.table.types))
            questions.append(0)
            self._check_nesting(at)
        elif brackets:
            self._close_bracket("(" if symbol == ")" else "[")

    def _close_bracket(self, opener: str) -> None:
        """Close the innermost bracket; if only an outer one fits, close up to that one."""
        brackets = self._brackets
        kept = len(brackets) - 1
        while kept >= 0 and self._text[self.table.starts[brackets[kept]]] != opener:
            kept -= 1
        kept = kept if kept >= 0 else len(brackets) - 1
        del brackets[kept:], self._questions[kept + 1 :]

    def _check_nesting(self, at: int) -> None:
        depth = len(self._indents) - 1 + len(self._brackets)
        if depth + sum(self._questions) > MAX_NESTING:
            self._errors.nesting_too_deep(at, MAX_NESTING)
            raise _TooMuch

    def _check_length(self, line: int, at: int) -> None:
        if len(self.table.types) - line > MAX_LINE_TOKENS:
            self._errors.line_too_long(self.table.starts[line], at, MAX_LINE_TOKENS)
            raise _TooMuch

    def _drop_statement(self) -> int:
        """Drop the file-level statement that is too long; return where the next one begins."""
        tokens, comments = self._statement_start
        table = self.table
        for column in (table.types, table.starts, table.ends):
            del column[tokens:]
        del table.comments[comments:]
        while self._candidates and self._candidates[-1][0] >= tokens:
            self._candidates.pop()
        self._line, self._indents, self._brackets, self._questions = None, [0], [], [0]
        found = patterns.UNINDENTED_LINE.search(self._text, self._errors.last_offset)
        return found.end() if found else len(self._text)

    def _closes_brackets(self, line_start: int) -> bool:
        """Whether the next line ends a statement with an open bracket."""
        if not self._strict_layout:
            return False
        head = patterns.LINE_HEAD.match(self._text, line_start)
        if head is None or head[3] is not None or column_after(head[1]) > self._indent_of_line:
            return False
        if self._text[head.end(1) : head.end(1) + 1] in (")", "]"):
            return False
        self._errors.unclosed_bracket(self._brackets[-1])
        return True

    def _recover_from_open_bracket(self) -> int:
        """At the end of the text: report the bracket, or scan its line again more strictly."""
        if self._strict_layout:
            self._errors.unclosed_bracket(self._brackets[-1])
            return len(self._text)
        self._strict_layout = True
        line = self._line
        assert line is not None
        pos = self.table.starts[line]
        for column in (self.table.types, self.table.starts, self.table.ends):
            del column[line:]
        while self._candidates and self._candidates[-1][0] >= line:
            self._candidates.pop()
        while self.table.comments and self.table.comments[-1].line == line:
            self.table.comments.pop()
        self._brackets, self._questions = [], [0]
        return pos
