"""The generated parser and its error strategy.

`StatementRecovery` keeps every mistake inside its statement: the exception rises to the nearest
rule `statement`, the rest of the line is skipped, the block below it is parsed as usual, and
parsing continues with the next statement.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from osc2tx.diagnostics import DiagnosticSink
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.parser_runtime import RecognitionException, TokenStream
from osc2tx.syntax.syntax_errors import SyntaxErrors
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, KEYWORDS, NEWLINE, TokenTable

Tree = Any  # a context of the generated parser; its children are contexts and token indexes

_WITH = KEYWORDS["with"]


class StatementRecovery:
    """The error strategy: one report per mistake, no repair, recovery to the end of a statement."""

    def __init__(self, stream: TokenStream, errors: SyntaxErrors) -> None:
        """Report to `errors`."""
        self._stream = stream
        self._errors = errors
        self._recovering = False
        self._starts = statement_starts()

    def sync(self, parser: Any) -> None:
        """Before each statement of a block: skip lines that begin no statement.

        A block is among the statements when a lexical error removed all tokens of the line above
        it; it is read like any other, so that its DEDENT ends nothing else.
        """
        stream = self._stream
        while (kind := stream.types[stream.index]) not in self._starts:
            if kind in (DEDENT, EOF) or (kind == INDENT and not parser._ctx.children):
                return
            if kind == INDENT:
                self._parse_block(parser)
                continue
            self._errors.report(parser, stream.index)
            self._skip_statement(parser)

    def recoverInline(self, parser: Any) -> None:
        """Abort immediately; no token is removed or inserted."""
        raise RecognitionException

    def reportError(self, parser: Any, error: RecognitionException) -> None:
        """Report where the exception arose, not again in the rules it passes through."""
        if not self._recovering:
            self._recovering = True
            self._errors.report(parser, self._stream.index)

    def recover(self, parser: Any, error: RecognitionException) -> None:
        """Let the exception rise to the statement; there, skip the rest of it."""
        context = parser._ctx
        if context.__class__ is not Grammar.StatementContext:
            raise error
        self._recovering = False
        before = self._stream.types[self._stream.index - 1]
        if self._stream.index == context.start or before not in (NEWLINE, DEDENT):
            self._skip_statement(parser)

    def _skip_statement(self, parser: Any) -> None:
        """Go past the line end; parse the blocks of the statement for the mistakes in them."""
        stream = self._stream
        types = stream.types
        while True:
            while types[stream.index] not in (NEWLINE, EOF):
                stream.index += 1
            if types[stream.index] == EOF:
                return
            stream.index += 1
            if types[stream.index] == INDENT:
                self._parse_block(parser)
            if types[stream.index] != _WITH:
                return

    def _parse_block(self, parser: Any) -> None:
        """Parse a block where the grammar has none, for the mistakes in it."""
        parser.state = _block_call()
        parser.block()


class _RuleEntered(Exception):
    """The rule `statement` has chosen an alternative."""


class _Probe(Grammar.OpenSCENARIO2):
    """The parser up to the choice between the alternatives of `statement`."""

    def enterRule(self, context: Tree, state: int, rule: int) -> None:
        if rule != Grammar.RULE_statement:
            raise _RuleEntered
        super().enterRule(context, state, rule)


class _GivesUp:
    """An error strategy for one token."""

    def reportError(self, parser: Any, error: RecognitionException) -> None:
        """Go no further."""
        raise error


@cache
def statement_starts() -> frozenset[int]:
    """Return the types of tokens that begin a statement; the parser itself is asked."""
    found = []
    for kind in range(1, len(Grammar.literalNames)):
        probe = _Probe(TokenStream([kind]))
        probe._errHandler = _GivesUp()
        try:
            probe.statement()
        except _RuleEntered:
            found.append(kind)
        except RecognitionException:
            continue
    return frozenset(found)


@cache
def _block_call() -> int:
    return Grammar.atn.state_that_calls(Grammar.RULE_block)


def parse_tokens(table: TokenTable, sink: DiagnosticSink) -> Tree:
    """Return the tree of the rule `sourceFile`; statements with mistakes are marked in it."""
    stream = TokenStream(table.types)
    parser = Grammar.OpenSCENARIO2(stream)
    parser._errHandler = StatementRecovery(stream, SyntaxErrors(table, sink))
    return parser.sourceFile()
