"""The runtime of the generated parser: the part of the ANTLR runtime that an LL(1) parser needs.

`make parser` makes `_antlr` import this module in place of `antlr4`, whose names it therefore has,
and removes the calls that have no effect without listeners, token objects and prediction. Contexts
hold token indexes instead of tokens. antlr4 itself is loaded only for a message that lists the
expected tokens.
"""

from __future__ import annotations

from typing import Any

EOF = -1
"""The one type of token that the grammar does not name."""


class RecognitionException(Exception):
    """The current token does not fit."""


class NoViableAltException(RecognitionException):
    """No alternative of a rule begins with the current token."""


class TokenStream:
    """A cursor over the types of tokens; the parser only ever looks one token ahead."""

    def __init__(self, types: list[int]) -> None:
        """Start at the first token."""
        self.types = types
        self.index = 0


class ParserRuleContext:
    """A node of the parser's tree.

    Attributes:
        parentCtx: The node above it, as long as its rule is read.
        invokingState: State of the parser in which its rule was called.
        children: Contexts and token indexes.
        start: Index of its first token.
        stop: Index of its last token.
        exception: The syntax error in it.
    """

    __slots__ = ("children", "exception", "invokingState", "parentCtx", "start", "stop")
    children: list[Any]
    start: int
    stop: int

    def __init__(self, parent: ParserRuleContext | None, invoking_state: int) -> None:
        """Begin the node; `Parser.enterRule` sets its position."""
        self.parentCtx = parent
        self.invokingState = invoking_state
        self.exception: RecognitionException | None = None


class Parser:
    """The methods that the rules of the generated parser call."""

    _errHandler: Any

    def __init__(self, stream: TokenStream) -> None:
        """Read a stream from its first token."""
        self._input = stream
        self._ctx: ParserRuleContext | None = None
        self.state = -1

    def enterRule(self, context: ParserRuleContext, state: int, rule: int) -> None:
        """Add a context below the current one, and make it the current one."""
        self.state = state
        context.start = self._input.index
        context.children = []
        parent = self._ctx
        if parent is not None:
            parent.children.append(context)
        self._ctx = context

    def recover(self, context: ParserRuleContext, error: RecognitionException) -> None:
        """Report a mismatch in a rule, and continue behind it or in the calling rule."""
        context.exception = error
        self._errHandler.reportError(self, error)
        self._errHandler.recover(self, error)

    def exitRule(self) -> None:
        """Make the context above the current one."""
        context = self._ctx
        assert context is not None, "a rule is being read"
        context.stop = self._input.index - 1
        self.state = context.invokingState
        self._ctx = context.parentCtx
        context.parentCtx = None  # a tree without cycles is freed on its last use

    def match(self, expected: int) -> None:
        """Read a token of a type."""
        stream = self._input
        index = stream.index
        if stream.types[index] != expected:
            raise RecognitionException
        context = self._ctx
        assert context is not None, "a rule is being read"
        context.children.append(index)
        if expected != EOF:
            stream.index = index + 1

    def consume(self) -> None:
        """Read the current token, whose type was looked at before."""
        stream = self._input
        index = stream.index
        context = self._ctx
        assert context is not None, "a rule is being read"
        context.children.append(index)
        stream.index = index + 1


class Network:
    """The transition network of the grammar; nothing but messages needs it."""

    def __init__(self, serialized: list[int]) -> None:
        """Take it as the generated parser has it."""
        self._serialized = serialized
        self._network: Any = None

    @property
    def _read(self) -> Any:
        if self._network is None:
            from antlr4.atn.ATNDeserializer import ATNDeserializer as Reader

            self._network = Reader().deserialize(self._serialized)
        return self._network

    def types_in(self, state: int, context: ParserRuleContext) -> frozenset[int]:
        """Return the types of tokens that fit a state, in a context whose rule is being read."""
        return frozenset(self._read.nextTokens(self._read.states[state], context))

    def state_that_calls(self, rule: int) -> int:
        """Return the number of a state that the parser may be in when it calls a rule."""
        return next(
            int(state.stateNumber)
            for state in self._read.states
            if state is not None
            and any(getattr(each, "ruleIndex", None) == rule for each in state.transitions)
        )
