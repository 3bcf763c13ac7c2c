"""The constraints on one parameter, as a value or domain."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx import ir
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Instance: TypeAlias = ast.Invocation | ast.Composition


@dataclass(frozen=True, slots=True)
class Setting:
    """The settings of one parameter.

    Attributes:
        value: Its value (`is_fixed`) or default.
        domain: Its domain.
        is_fixed: Nothing can change the value.
        comments: Comment lines of the constraints behind it.
        constraints: The constraints behind them.
    """

    value: ir.Expression | None
    domain: ir.Domain | None
    is_fixed: bool
    comments: tuple[str, ...]
    constraints: tuple[Constraint, ...]

    @property
    def is_empty(self) -> bool:
        """Whether nothing is known."""
        return self.value is None and self.domain is None


def is_known_here(constraint: Constraint, key: Key) -> bool:
    """Whether a constraint can be written here: that of an invocation only if it is alone.

    A constraint of an invoked scenario sets a passed object; its other names are known only inside.
    A constraint that relates a field to an invocation belongs to the invocation, which is below all
    fields.
    """
    prefix = constraint.place.prefix
    is_inside = bool(prefix) and isinstance(prefix[0], Instance)
    is_of_member = any(isinstance(first, ast.Node) for first, *_ in constraint.operations.keys)
    is_alone = constraint.operations.keys == {key}
    return isinstance(key[0], ast.Node) or is_alone or not (is_inside or is_of_member)


def is_last(key: Key, others: list[Key]) -> bool:
    """Whether a parameter is below others in the same text; those of a tree are below fields."""
    return all(_is_above(first, key[0]) for first, *_ in others)


def is_last_of_object(key: Key, others: list[Key]) -> bool:
    """Whether a member is declared below other members of the same object."""
    return all(other[:-1] == key[:-1] and _is_above(other[-1], key[-1]) for other in others)


def _is_above(upper: sym.Symbol | ast.Node, lower: sym.Symbol | ast.Node) -> bool:
    if isinstance(lower, ast.Node) and isinstance(upper, sym.FieldSymbol):
        return True
    return (
        isinstance(upper, sym.FieldSymbol)
        and isinstance(lower, sym.FieldSymbol)
        and upper.span.source == lower.span.source
        and upper.span.start < lower.span.start
    )
