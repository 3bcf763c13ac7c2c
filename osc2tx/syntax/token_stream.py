"""The token table as the stream that the generated parser expects."""

from __future__ import annotations

from osc2tx.syntax.tokens import TokenTable


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
