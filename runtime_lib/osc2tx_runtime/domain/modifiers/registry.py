"""The registry of modifiers: DSL name to class, with the facts stated at registration."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from osc2tx_runtime.language.actions.modifier import ModifierFacts
from osc2tx_runtime.world.protocol import Feature
from osc2tx_shared.rules import ModifierRules, Rule, Sort

from .base import Modifier, MovementModifier

MODIFIERS: dict[str, type[Modifier]] = {}
"""Modifiers that have an effect, by their name in the DSL."""

ModifierT = TypeVar("ModifierT", bound=type[Modifier])


def modifier(
    name: str,
    *,
    slots: Sequence[str] = (),
    topics: Sequence[str] = (),
    excludes: Sequence[str] = (),
    sorts: Sequence[Sort] = (),
    no_start: str = "",
    lanes_only: bool = False,
    while_moving: Sequence[Rule] = (),
    places: bool = False,
    paces: bool = False,
    bounds: bool = False,
    placement: bool = False,
    orders: Sequence[str] = (),
    amounts: Sequence[str] = (),
    needs: Sequence[Feature] = (),
    undeclared: str = "",
) -> Callable[[ModifierT], ModifierT]:
    """Register the decorated class as the modifier `name`.

    Parameters are those of `ModifierFacts` and of `ModifierRules`; `rules` of the arguments and
    `shaped_by` are attributes of the class.

    Raises:
        ValueError: There already is a modifier of that name.
    """

    def register(kind: ModifierT) -> ModifierT:
        if name in MODIFIERS:
            raise ValueError(f"modifier {name} is {MODIFIERS[name].__qualname__} already")
        MODIFIERS[name] = kind
        kind.name = name
        kind.facts = ModifierFacts(
            ModifierRules(
                topics=tuple(topics),
                excludes=tuple(excludes),
                sorts=tuple(sorts),
                starts=placement and not no_start and issubclass(kind, MovementModifier),
                no_start=no_start,
                lanes_only=lanes_only,
                while_moving=tuple(while_moving),
            ),
            slots=tuple(slots),
            places=places,
            paces=paces,
            bounds=bounds,
            placement=placement,
            orders=tuple(orders),
            amounts=tuple(amounts),
            needs=tuple(needs),
            undeclared=undeclared,
        )
        return kind

    return register
