"""The names of a program for completion."""

from __future__ import annotations

import re
from collections.abc import Sequence

from osc2tx.semantics import SemanticModel
from osc2tx.semantics.conversions import symbol_of
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import ListType, MethodSymbol, Symbol, TypeSymbol


class Program:
    """The names of a program at an offset.

    Attributes:
        model: The program; `None` if there is none.
        symbols: Its declarations.
        offset: The offset of the cursor.
        it: The meaning of `it` in the block of the cursor, unless it is the enclosing type.
    """

    def __init__(self, model: SemanticModel | None, offset: int) -> None:
        self.model = model
        self.symbols: Sequence[Symbol] = () if model is None else model.symbols
        self.offset = offset
        self.it: TypeSymbol | None = None

    def owner(self, declared_at: int) -> TypeSymbol | None:
        """Return the type whose declaration begins in the line of an offset."""
        if self.model is None:
            return None
        root = self.model.root.span.source
        here = [
            symbol
            for symbol in self.symbols
            if isinstance(symbol, TypeSymbol)
            and symbol.span.source.name == root.name
            and symbol.span.start >= declared_at
        ]
        return min(here, key=lambda symbol: symbol.span.start, default=None)

    def of(self, kinds: type | tuple[type, ...]) -> list[Symbol]:
        """Return the declarations of some kinds."""
        return [symbol for symbol in self.symbols if isinstance(symbol, kinds)]

    def type_of(self, path: str, owner: TypeSymbol | None) -> TypeSymbol | None:
        """Return the type of the object that a dotted name reaches."""
        current = owner
        for step in filter(None, re.split(r"[.]|\[\d+\]", path)):
            if step == "it":
                current = self.it or current
            if current is None or step == "it":
                continue
            member = next(
                (type_.members[step] for type_ in supertypes(current) if step in type_.members),
                None,
            )
            type_ = getattr(member, "type", None)
            if isinstance(type_, ListType):
                type_ = type_.element
            current = None if type_ is None else symbol_of(type_)
        return current if path else None

    def value_of(self, path: str, owner: TypeSymbol | None) -> str:
        """Return the type of the value that a dotted name reads or computes."""
        receiver, _, name = path.rpartition(".")
        reached = self.type_of(receiver, owner) if receiver else owner
        types = () if reached is None else supertypes(reached)
        member = next((type_.members[name] for type_ in types if name in type_.members), None)
        return str(
            member.result if isinstance(member, MethodSymbol) else getattr(member, "type", "")
        )
