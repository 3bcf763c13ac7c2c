"""The messages of the token source; each marks the reported text as damaged."""

from __future__ import annotations

import re
from collections.abc import Collection

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.diagnostics.fixes import Help, insert, leave_out, write
from osc2tx.syntax import patterns
from osc2tx.syntax.tokens import TokenTable, column_after

# The end of a line, lines of blanks, and the indentation of what follows.
_NEXT_LINE = re.compile(r"[ \t\r]*\n(?:[ \t\r]*\n)*([ \t]*)\S")
_MAX_REPORTS = 100
_OPERATORS = {"&&": "and", "&": "and", "||": "or"}
_REPLACEMENTS = {
    "^": "there is no power; multiply: `a * a`",
    "`": "strings are enclosed in double or single quotes",
    ";": "a statement ends with its line; leave the semicolon out",
    "{": "blocks are made by `:` and indentation",
    "}": "blocks are made by `:` and indentation",
}


class LexicalErrors:
    """Reports lexical mistakes of one source, each once, not more than 100 of a kind."""

    def __init__(self, table: TokenTable, sink: DiagnosticSink, *, allow: Collection[str]) -> None:
        """Report into `sink`, except codes that are accepted."""
        self._table = table
        self._text = table.source.text
        self._sink = sink
        self._allow = allow
        self._reported: dict[str, int] = {}
        self.last_offset = 0

    def _report(self, code: str, start: int, end: int, message: str, help_: Help = None) -> None:
        self.last_offset = start
        count = self._reported[code] = self._reported.get(code, 0) + 1
        if count <= _MAX_REPORTS:
            self._sink.report(code, Span(self._table.source, start, end), message, help=help_)

    def unknown_character(self, start: int) -> int:
        """Report characters that start no token; return where to continue."""
        match = patterns.UNKNOWN_RUN.match(self._text, start)
        end = max(match.end() if match else start + 1, start + 1)
        found = self._text[start:end] if match is None or match[1] is None else match[1]
        shown = f"`{found}`" if found.isprintable() else f"U+{ord(found[0]):04X}"
        help_: Help = _REPLACEMENTS.get(found)
        span = Span(self._table.source, start, start + len(found))
        if found in _OPERATORS:
            operator = _OPERATORS[found]
            help_ = write(span, operator, f"the operator is written `{operator}`")
        elif found in "{}":
            help_ = self._without_brace(start, found)
        elif found == ";" and not self._rest_of_line(start + 1).strip():
            help_ = leave_out(span, _REPLACEMENTS[found])
            if self._opens_block(start):
                help_ = write(span, ":", "a block begins with `:`", is_safe=False)
        if found == "\\":
            help_ = "a backslash joins lines only as the last character of a line"
        elif found == "\0":
            help_ = "the file holds a NUL byte; is it a text file?"
        self._report("OSC102", start, end, f"unexpected character {shown}", help_)
        self._table.damaged.append(start)
        return end

    def _opens_block(self, start: int) -> bool:
        """Whether the next line with something on it is further in than that of an offset."""
        following = _NEXT_LINE.match(self._text, start + 1)
        line = self._text[self._table.line_start(start) : start]
        own = line[: len(line) - len(line.lstrip())]
        return following is not None and column_after(following[1]) > column_after(own)

    def _without_brace(self, start: int, brace: str) -> Help:
        """Return the fix that replaces a brace by the colon of a block, or removes its line."""
        line = self._table.line_start(start)
        rest = self._rest_of_line(start + 1)
        help_ = _REPLACEMENTS[brace]
        if rest.strip():
            return help_
        if brace == "{":
            first = len(self._text[:start].rstrip(" \t"))
            return write(Span(self._table.source, first, start + 1), ":", help_, is_safe=False)
        if self._text[line:start].strip():
            return help_
        end = min(start + 1 + len(rest) + 1, len(self._text))
        return leave_out(Span(self._table.source, line, end), help_, is_safe=False)

    def _rest_of_line(self, start: int) -> str:
        match = patterns.LINE_REST.match(self._text, start)
        return self._text[start:] if match is None else match[0]

    def unterminated_string(self, start: int) -> int:
        """Report a string without end.

        It is taken to end with its line, or where the line below has the quote that closes it.
        """
        quote = self._text[start]
        end = start + len(self._rest_of_line(start))
        delimiter = quote * 3 if self._text.startswith(quote * 3, start) else quote
        message = f"the string has no closing `{delimiter}`"
        several = "a string of several lines needs three quotes"
        open_end = Span(self._table.source, end, end)
        help_ = None if len(delimiter) == 3 else insert(open_end, quote, several, is_safe=False)
        self._report("OSC103", start, end, message, help_)
        self._table.damaged.append(start)
        return self._closed_below(end, quote) if help_ else end

    def _closed_below(self, end: int, quote: str) -> int:
        """Return where a string that continues in the next line is closed, else `end`."""
        below = patterns.NEXT_LINE.match(self._text, end)
        if below is None or below[1].count(quote) % 2 == 0:
            return end
        return below.start(1) + below[1].index(quote) + 1

    def foreign_comment(self, start: int) -> int:
        """Report `/* */` or `//`; return the offset behind it."""
        if self._text.startswith("//", start):
            end = start + len(self._rest_of_line(start))
            message = "a comment starts with `#`, not with `//`"
            before = self._text[self._text.rfind("\n", 0, start) + 1 : start].rstrip()
            after = self._text[start + 2 : end].lstrip()[:1]
            is_operator = before[-1:].isalnum() or before.endswith((")", "]", "_"))
            is_operator &= after.isdigit() or after == "("
            help_ = write(Span(self._table.source, start, start + 2), "#")
            if is_operator:
                divide = "to divide write `/`: the quotient of integers is an integer"
                help_ = write(
                    Span(self._table.source, start, start + 2), "/", divide, is_safe=False
                )
            self._report("OSC111", start, start + 2, message, help_)
            return end
        close = self._text.find("*/", start + 2)
        if close < 0:
            end = len(self._text)
            self._report("OSC111", start, start + 2, "the block comment has no end `*/`")
            return end
        if "OSC111" not in self._allow:
            message = "block comments are not part of OpenSCENARIO DSL"
            self._report("OSC111", start, start + 2, message, "begin each line with `#`")
        return close + 2

    def inconsistent_dedent(self, at: int, width: int, opened: list[int], taken: int) -> None:
        """Report a line that is indented like no block around it.

        ScenarioRunner takes such a line as one of the outer block, so a dialect may allow that.

        Args:
            at: Where the line begins.
            width: Its indentation.
            opened: The indentations of the blocks around it.
            taken: That of the block it is taken to belong to.
        """
        columns = [str(column + 1) for column in opened]
        listed = " and ".join([", ".join(columns[:-1]), columns[-1]] if columns[1:] else columns)
        relaxed = "OSC626" in self._allow and taken < width
        line_start = self._table.line_start(at)
        blanks = self._text[line_start:at]
        mixed = re.search(r" .*\t|\t.* ", blanks) or "\t" in blanks
        column = f"begin it in column {taken + 1}"
        indentation = Span(self._table.source, line_start, at)
        tabs = "tabs count up to the next multiple of 8; do not mix them with blanks"
        self._report(
            "OSC626" if relaxed else "OSC104",
            line_start,
            max(at, line_start + 1),
            f"the line starts in column {width + 1}, but the open blocks start in {listed}",
            tabs if mixed else write(indentation, " " * taken, column, is_safe=False),
        )

    def nesting_too_deep(self, at: int, limit: int) -> None:
        """Report blocks and brackets that nest beyond the limit."""
        message = f"blocks and brackets nest more than {limit} levels deep"
        help_ = "the whole declaration is skipped; split it"
        self._report("OSC105", at, min(at + 1, len(self._text)), message, help_)

    def line_too_long(self, start: int, end: int, limit: int) -> None:
        """Report a logical line with too many tokens."""
        message = f"this line has more than {limit:,} words and symbols"
        help_ = "the whole declaration is skipped; split it"
        self._report("OSC115", start, min(start + 1, end), message, help_)

    def unclosed_bracket(self, token: int) -> None:
        """Report a bracket that is still open where its statement must have ended."""
        table = self._table
        start = table.starts[token]
        bracket = table.text(token)
        close = {"(": ")", "[": "]"}[bracket]
        self._report("OSC106", start, start + 1, f"`{bracket}` is not closed", f"add a `{close}`")
        self._table.damaged.append(start)
