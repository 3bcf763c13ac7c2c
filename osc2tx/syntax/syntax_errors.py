"""Messages for syntax errors."""

from __future__ import annotations

from bisect import bisect_right
from typing import Any

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.common_mistakes import remedy
from osc2tx.syntax.mistake_places import Advice
from osc2tx.syntax.tokens import TokenTable

_MAX_REPORTS = 100
_MAX_EXPECTED = 4

_OPERATORS = frozenset(
    t.PUNCTUATION[text] for text in ("=>", "==", "!=", "<", "<=", ">", ">=", *"+*/%!.?[")
) | frozenset(t.KEYWORDS[word] for word in ("or", "and", "in"))
_OPERAND_STARTS = t.LITERALS | {t.ID}
_KINDS = {
    t.NEWLINE: "the end of the line",
    t.ID: "a name",
    t.STRING: "a string",
    t.EOF: "the end of the file",
    t.INDENT: "an indented block",
}


class SyntaxErrors:
    """Reports syntax errors of one source; quiet where the token source has spoken already."""

    def __init__(self, table: TokenTable, sink: DiagnosticSink) -> None:
        """Report into `sink`."""
        self._table = table
        self._sink = sink
        self._damaged = sorted(table.damaged)
        self._count = 0

    def report(self, parser: Any, index: int) -> None:
        """Report that the token at `index` does not fit the state of the parser."""
        if self._is_damaged(index):
            return
        self._count += 1
        if self._count > _MAX_REPORTS:
            if self._count == _MAX_REPORTS + 1:
                message = f"more than {_MAX_REPORTS} syntax errors; the others are not shown"
                self._sink.report("OSC100", self._span(index), message)
            return
        advice = remedy(self._table, index) or Advice(self._describe(parser, index))
        span = self._span(index if advice.token is None else advice.token)
        self._sink.report("OSC100", span, advice.message, help=advice.help)

    def _is_damaged(self, index: int) -> bool:
        """Whether a lexical mistake before the token, in the same logical line, was reported."""
        table = self._table
        first = index
        while first > 0 and table.types[first - 1] not in (t.NEWLINE, t.INDENT, t.DEDENT):
            first -= 1
        place = bisect_right(self._damaged, table.ends[index])
        return place > 0 and self._damaged[place - 1] >= table.line_start(table.starts[first])

    def _span(self, index: int) -> Span:
        table = self._table
        if table.types[index] in (t.NEWLINE, t.EOF, t.DEDENT) and index > 0:
            end = table.ends[index - 1]
            return Span(table.source, end, end)
        return table.span(index, index)

    def _describe(self, parser: Any, index: int) -> str:
        found = describe_token(self._table, index)
        context = parser._ctx
        if isinstance(context, (Grammar.BlockContext, Grammar.SourceFileContext)):
            return f"expected a statement, found {found}"
        expected = self._expected(parser, context)
        if expected:
            return f"expected {expected}, found {found}"
        if self._table.types[index] == t.NEWLINE:
            return f"the line ends too early, after {describe_token(self._table, index - 1)}"
        return f"{found} does not fit here"

    def _expected(self, parser: Any, context: Any) -> str:
        types: frozenset[int] = Grammar.atn.types_in(parser.state, context)
        in_type = isinstance(context, (Grammar.TypeNameContext, Grammar.BehaviorNameContext))
        if in_type and t.ID in types:
            typed = isinstance(context, Grammar.TypeNameContext) or isinstance(
                context.parentCtx, Grammar.TypeNameContext
            )
            return "a type name" if typed else "a name"
        words = []
        if t.INTEGER in types:
            words.append("an expression")
            types -= _OPERAND_STARTS | {t.PUNCTUATION[s] for s in ["(", "[", "+", "-"]}
            types -= {t.KEYWORDS["not"]}
        elif types >= _OPERATORS:
            types -= _OPERATORS | {t.PUNCTUATION["-"], t.PUNCTUATION["("]}
        words += [_name(kind) for kind in sorted(types) if kind not in (t.INDENT, t.DEDENT)]
        if not words or len(words) > _MAX_EXPECTED:
            return ""
        return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


def _name(kind: int) -> str:
    return _KINDS.get(kind) or f"`{t.SPELLING.get(kind, '?')}`"


def describe_token(table: TokenTable, index: int) -> str:
    """Describe a token in terms of the language."""
    kind = table.types[index]
    if kind in t.KEYWORD_TYPES:
        return f"the reserved word `{table.text(index)}`"
    if kind == t.NEWLINE:
        return "the end of the line"
    if kind == t.EOF:
        return "the end of the file"
    if kind == t.INDENT:
        return "an indented line"
    if kind == t.DEDENT:
        return "the end of the block"
    return f"`{shortened(table.text(index))}`"


def shortened(text: str) -> str:
    """Return a text for a message: one line, not more than 40 characters."""
    line, *more = text.split("\n", 1)
    return line if len(line) <= 40 and not more else f"{line[:37]}..."
