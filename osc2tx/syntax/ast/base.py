"""Base classes of AST nodes."""

from __future__ import annotations

from dataclasses import field
from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Node:
    """A node of the syntax tree; compared by identity, so it can key side tables."""

    span: Span


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Statement(Node):
    """A node with lines of its own, which can therefore have comments.

    Attributes:
        comments: Its comment lines, without `#` and surrounding blanks; an empty one where blank
            lines divide them.
        trailing_comment: The comment at the end of its first line.
        comments_below: Comment lines that touch it from below, and not the next statement.
    """

    comments: tuple[str, ...] = field(default=(), repr=False)
    trailing_comment: str | None = field(default=None, repr=False)
    comments_below: tuple[str, ...] = field(default=(), repr=False)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Name(Node):
    """A possibly qualified identifier (§7.2.1.5.1), `ns::text` or plain `text`.

    Attributes:
        text: The identifier without bars and prefix.
        namespace: The prefix; `null` and the empty prefix of `::x` are both `"null"`.
    """

    text: str
    namespace: str | None = None

    def __str__(self) -> str:
        """The name as one would write it."""
        return self.text if self.namespace is None else f"{self.namespace}::{self.text}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BehaviorName(Node):
    """The name of a behavior, with the type of the actor it belongs to: `vehicle.drive`."""

    actor: Name | None
    name: Name

    def __str__(self) -> str:
        """The name as one would write it."""
        return str(self.name) if self.actor is None else f"{self.actor}.{self.name}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NamedType(Node):
    """A type by name: primitive, physical, enum, struct, actor or behavior (`vehicle.drive`)."""

    name: BehaviorName


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RangeType(Node):
    """`range of T`, numeric `T` (2.2)."""

    element: NamedType


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ListType(Node):
    """`list of T`."""

    element: NamedType | RangeType


TypeName: TypeAlias = NamedType | RangeType | ListType
