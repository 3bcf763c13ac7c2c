"""Actors that a constraint equates with another actor (§7.3.11): two names of one."""

from __future__ import annotations

from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.propagation import TypeConstraints
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.scope import is_subtype
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class SameActor:
    """The identity of an actor.

    Attributes:
        other: The equal actor.
        name: Its name in the constraint.
        constraint: The constraint that equates them.
    """

    other: sym.FieldSymbol
    name: ast.NameExpression
    constraint: Constraint


def same_actors(found: TypeConstraints) -> dict[sym.FieldSymbol, SameActor]:
    """Return the actors of a scenario that are others: declared above them, or more special."""
    same: dict[sym.FieldSymbol, SameActor] = {}
    for constraint in found.in_force.constraints:
        node = constraint.node
        if not isinstance(node, ast.KeepConstraint) or constraint.is_default:
            continue
        if constraint.place.prefix:
            continue  # it constrains a part of an object or of an invoked scenario
        match node.expression:
            case ast.Binary(operator=ast.BinaryOperator.EQUAL, left=left, right=right):
                for one, other in ((left, right), (right, left)):
                    symbol, target = _actor(constraint, one), _actor(constraint, other)
                    if symbol is None or target is None or symbol in same:
                        continue
                    if isinstance(other, ast.NameExpression) and _may_be(target, symbol):
                        same[symbol] = SameActor(target, other, constraint)
            case _:
                continue
    return same


def _actor(constraint: Constraint, expression: ast.Expression) -> sym.FieldSymbol | None:
    """Return the actor of the scenario that an expression names."""
    match constraint.place.locate(expression):
        case (sym.FieldSymbol(type=types.ActorType()) as found,):
            return found
        case _:
            return None


def _may_be(target: sym.FieldSymbol, symbol: sym.FieldSymbol) -> bool:
    """Whether an actor has the type of another one, and is declared above it or is more derived."""
    one, other = target.type, symbol.type
    if not isinstance(one, types.ActorType) or not isinstance(other, types.ActorType):
        return False
    is_above = target.span.source == symbol.span.source and target.span.start < symbol.span.start
    comes_first = is_above or one.symbol is not other.symbol
    return comes_first and target.owner is not None and is_subtype(one.symbol, other.symbol)
