"""The generated parser made fast, and its error strategy.

`FastParser` replaces the hot methods of the ANTLR runtime by the least that an LL(1) parser with a
tree needs: contexts hold token indexes in place of token objects. `StatementRecovery` keeps every
mistake inside its statement: the exception rises to the nearest rule `statement`, the rest of the
line is skipped, the block below it is parsed as usual, and parsing goes on with the next statement.
"""

from __future__ import annotations

from typing import Any

from antlr4.error.Errors import RecognitionException

from osc2tx.diagnostics import DiagnosticSink
from osc2tx.syntax._antlr.OpenSCENARIO2 import OpenSCENARIO2 as Grammar
from osc2tx.syntax.syntax_errors import SyntaxErrors
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, KEYWORDS, NEWLINE, TokenTable


class TokenStream:
    """A cursor over a token table; the parser only ever looks one token ahead."""

    def __init__(self, table: TokenTable) -> None:
        """Start at the first token."""
        self.table = table
        self.types = table.types
        self.index = 0

    def LA(self, distance: int) -> int:
        """Return the type of the current token; `distance` is always 1."""
        return self.types[self.index]


Tree = Any  # a context of the generated parser; its children are contexts and token indexes

_WITH = KEYWORDS["with"]


class Mismatch(RecognitionException):  # type: ignore[misc]
    """The current token does not fit."""


class _FastParser:
    """Hot methods of `antlr4.Parser` without listeners, token objects and indirections."""

    state = -1
    _ctx: Any
    _input: TokenStream

    def enterRule(self, context: Tree, state: int, rule: int) -> None:
        self.state = state
        context.start = self._input.index
        context.children = []
        parent = self._ctx
        if parent is not None:
            parent.children.append(context)
        self._ctx = context

    def enterOuterAlt(self, context: Tree, alternative: int) -> None:
        pass

    def exitRule(self) -> None:
        context = self._ctx
        context.stop = self._input.index - 1
        self.state = context.invokingState
        self._ctx = context.parentCtx
        context.parentCtx = None  # a tree without cycles goes as soon as nobody needs it

    def match(self, expected: int) -> int:
        stream = self._input
        index = stream.index
        if stream.types[index] != expected:
            raise Mismatch(recognizer=self, input=stream, ctx=self._ctx)
        self._ctx.children.append(index)
        if expected != EOF:
            stream.index = index + 1
        return index

    def consume(self) -> int:
        stream = self._input
        index = stream.index
        self._ctx.children.append(index)
        stream.index = index + 1
        return index

    def getCurrentToken(self) -> int:
        return self._input.index

    def getInputStream(self) -> TokenStream:
        return self._input


class _Parser(_FastParser, Grammar):  # type: ignore[misc, unused-ignore]
    """The generated parser with its fast base first."""


class StatementRecovery:
    """The error strategy: one report per mistake, no repair, recovery to the end of a statement."""

    _starts: frozenset[int] = frozenset()
    _block_call = -1

    def __init__(self, stream: TokenStream, errors: SyntaxErrors) -> None:
        """Report to `errors`."""
        self._stream = stream
        self._errors = errors
        self._recovering = False
        if not StatementRecovery._starts:
            state = Grammar.atn.ruleToStartState[Grammar.RULE_statement]
            StatementRecovery._starts = frozenset(Grammar.atn.nextTokens(state))
            StatementRecovery._block_call = _state_that_calls(Grammar.RULE_block)

    def sync(self, parser: Any) -> None:
        """Before each statement of a block: pass over lines that begin no statement.

        A block stands among the statements when the line above it lost all its tokens to a lexical
        mistake; it is read like any other, so that its DEDENT ends nothing else.
        """
        context = parser._ctx.__class__
        if context is not Grammar.BlockContext and context is not Grammar.SourceFileContext:
            return
        stream = self._stream
        while (kind := stream.types[stream.index]) not in self._starts:
            if kind in (DEDENT, EOF) or (kind == INDENT and not parser._ctx.children):
                return
            if kind == INDENT:
                self._parse_block(parser)
                continue
            self._errors.report(parser, stream.index)
            self._skip_statement(parser)

    def reportMatch(self, parser: Any) -> None:
        """Nothing to do: there is no repair that a match would end."""

    def recoverInline(self, parser: Any) -> None:
        """Give up at once; no token is dropped or invented."""
        raise Mismatch(recognizer=parser, input=self._stream, ctx=parser._ctx)

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
        parser.state = self._block_call
        parser.block()


def _state_that_calls(rule: int) -> int:
    """Number of a state that the parser may be in when it calls a rule."""
    for state in Grammar.atn.states:
        for transition in state.transitions if state is not None else ():
            if getattr(transition, "ruleIndex", None) == rule:
                return int(state.stateNumber)
    raise AssertionError("no rule calls this one")


def parse_tokens(table: TokenTable, sink: DiagnosticSink) -> Tree:
    """Return the tree of the rule `sourceFile`; statements with mistakes are marked in it."""
    stream = TokenStream(table)
    parser = _Parser(None)
    parser._input = stream
    parser._errHandler = StatementRecovery(stream, SyntaxErrors(table, sink))
    return parser.sourceFile()
