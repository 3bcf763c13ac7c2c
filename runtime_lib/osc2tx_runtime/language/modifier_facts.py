"""Registration data of a modifier: rules, slots, needs."""

from __future__ import annotations

from dataclasses import field

from osc2tx_classes import dataclass
from osc2tx_rules import ModifierRules
from osc2tx_runtime.world.features import Feature

__all__ = ["COURSE", "LANE", "SIDE", "ModifierFacts"]

COURSE = "course along the road"
LANE = "lane"
SIDE = "place across the lane"
"""Topics: an action takes one modifier of each."""


@dataclass(frozen=True, slots=True)
class ModifierFacts:
    """What a modifier is.

    Attributes:
        rules: What it does to other modifiers of the same action.
        slots: What it controls of the actor: LONGITUDINAL, LATERAL, both or nothing.
        places: Whether it says where the actor is.
        paces: Whether it says how fast the actor is, or where it is at each time.
        bounds: Whether an open-ended action is over when what it says is reached.
        placement: Whether an actor can start with it.
        orders: Parameters that only state an order, such as `faster_than`,
        amounts: whose amount stands in one of these, or stays open.
        needs: What a world must have to carry it out.
        undeclared: Why the library does not declare it, if it does not.
    """

    rules: ModifierRules = field(default_factory=ModifierRules)
    slots: tuple[str, ...] = ()
    places: bool = False
    paces: bool = False
    bounds: bool = False
    placement: bool = False
    orders: tuple[str, ...] = ()
    amounts: tuple[str, ...] = ()
    needs: tuple[Feature, ...] = ()
    undeclared: str = ""
