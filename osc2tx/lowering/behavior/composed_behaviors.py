"""Behaviors with a `do` of their own: scenarios and composed actions (§7.3.8.3)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias, TypeGuard

from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

Composed: TypeAlias = sym.ScenarioSymbol | sym.ActionSymbol


def is_composed(symbol: sym.Symbol | None) -> TypeGuard[Composed]:
    """Whether a module has a class for a behavior, instead of leaving it to the runtime.

    An action without a `do` has one too if another with a `do` inherits its members.
    """
    if isinstance(symbol, sym.ActionSymbol):
        return symbol.origin == "user" and (
            has_behavior(symbol)
            or any(each.base is symbol and is_composed(each) for each in symbol.derived)
        )
    return isinstance(symbol, sym.ScenarioSymbol)


def has_behavior(behavior: Composed) -> bool:
    """Whether a behavior or one of its bases has a `do`."""
    statements = (s for each in lineage_of(behavior) for s in each.statements)
    return any(isinstance(statement, ast.DoDirective) for statement in statements)


def scenario_key(behavior: Composed) -> str:
    """Return the key of the scenario in the IR that a behavior becomes."""
    span = behavior.node.name.span
    return f"{span.source.name}:{span.start}"


def actor_type_of(behavior: sym.BehaviorSymbol) -> sym.ActorSymbol | None:
    """Return the type whose objects perform a behavior.

    Dialect `carla` has a type that only names the subject of scenarios and has no objects: its
    scenarios have no actor.
    """
    actor = behavior.actor
    return None if actor is None or is_placeholder(actor) else actor


def is_placeholder(type_: sym.Symbol | None) -> bool:
    """Whether a type has no objects: `dut` of dialect `carla`."""
    return isinstance(type_, sym.ActorSymbol) and (type_.origin, type_.name) == ("prelude", "dut")


def lineage_of(behavior: Composed) -> Iterator[Composed]:
    """Yield a behavior and its bases, up to the library."""
    current: Composed | None = behavior
    while current is not None:
        yield current
        current = current.base
