"""The actions and modifiers of the library."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, Literal

from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules import ModifierRules, Rule, Sort


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionEntry:
    """An action. Parameters have their names in the DSL.

    Attributes:
        section: Of OpenSCENARIO DSL 2.2; empty if the standard does not have it.
        arguments: Parameters that the runtime takes.
        required: Those it cannot do without.
        modifiers: Modifiers that it honours.
        moves: Whether it moves as its modifiers say, so that they must go together.
        physical: Whether it cannot let the actor jump.
        slots: What it controls of the actor itself: `longitudinal`, `lateral`.
        ends: At its `goal`, `at_once` with a goal that takes no time, in the `instant` it starts,
            or `open`: only with its surroundings.
        places: Whether its arguments say where the actor is.
        paces: Whether it sets or holds the speed of the actor.
        needs: What a world must have to carry it out.
        rules: Which arguments go together.
        without_xml: Why OpenSCENARIO XML has no form of it; empty if it has.
    """

    section: str
    arguments: frozenset[str]
    required: frozenset[str]
    modifiers: frozenset[str]
    moves: bool
    physical: bool
    slots: tuple[str, ...]
    ends: Literal["goal", "open", "instant", "at_once"]
    places: bool
    paces: bool
    needs: tuple[str, ...]
    rules: tuple[Rule, ...]
    without_xml: str

    @property
    def is_momentary(self) -> bool:
        """Whether it takes no time."""
        return self.ends in ("instant", "at_once")


@dataclass(frozen=True, slots=True, kw_only=True)
class ModifierEntry:
    """A modifier. Parameters have their names in the DSL.

    Attributes:
        owner: The actor of which it is a member (`map`, `vehicle`); empty for those of actions.
        section: Of OpenSCENARIO DSL 2.2; empty if the standard does not have it.
        parameters: Those that the runtime takes.
        required: Those it cannot do without.
        shape: Base of the shapes that it takes; `None` if it takes none.
        rules: Which arguments go together.
        combining: What it does to other modifiers of the same action.
        slots: What it controls of the actor: `longitudinal`, `lateral`.
        places: Whether it says where the actor is.
        paces: Whether it says how fast the actor is, or where it is at each time.
        bounds: Whether an open-ended action is over when what it says is reached.
        placement: Whether an actor, or the map, can start with it.
        orders: Parameters that only state an order, such as `faster_than`,
        amounts: whose amount stands in one of these, or stays open.
        needs: What a world must have to carry it out.
        without_xml: Why OpenSCENARIO XML has no form of it; empty if it has.
    """

    owner: str
    section: str
    parameters: frozenset[str]
    required: frozenset[str]
    shape: str | None
    rules: tuple[Rule, ...]
    combining: ModifierRules
    slots: tuple[str, ...]
    places: bool
    paces: bool
    bounds: bool
    placement: bool
    orders: frozenset[str]
    amounts: frozenset[str]
    needs: tuple[str, ...]
    without_xml: str


@dataclass(frozen=True, slots=True)
class Catalogue:
    """What the library has and the runtime carries out.

    Attributes:
        actions: By actor and name, `vehicle.drive`.
        modifiers: By name; those of different actors have different names.
        abstract: Actions that are only there to be inherited from.
        lowered: Actions that the lowering turns into the initial placement.
    """

    actions: Mapping[str, ActionEntry]
    modifiers: Mapping[str, ModifierEntry]
    abstract: frozenset[str]
    lowered: frozenset[str]


@cache
def catalogue() -> Catalogue:
    """Return the catalogue."""
    table = json.loads(Path(__file__).with_name("library.json").read_text(encoding="utf-8"))
    return Catalogue(
        {name: _action(entry) for name, entry in table["actions"].items()},
        {name: _modifier(entry) for name, entry in table["modifiers"].items()},
        frozenset(table["abstract"]),
        frozenset(table["lowered"]),
    )


def _action(entry: Mapping[str, Any]) -> ActionEntry:
    sets = {name: frozenset(entry[name]) for name in ("arguments", "required", "modifiers")}
    tuples = {name: tuple(entry[name]) for name in ("slots", "needs")}
    return ActionEntry(**{**entry, **sets, **tuples, "rules": _rules(entry["rules"])})


def _modifier(entry: Mapping[str, Any]) -> ModifierEntry:
    sets = {
        name: frozenset(entry[name]) for name in ("parameters", "required", "orders", "amounts")
    }
    tuples = {name: tuple(entry[name]) for name in ("slots", "needs")}
    combining = entry["combining"]
    rules = ModifierRules(
        **{
            **{name: _frozen(value) for name, value in combining.items()},
            "sorts": tuple(Sort(**_frozen_values(sort)) for sort in combining["sorts"]),
            "while_moving": _rules(combining["while_moving"]),
        }
    )
    return ModifierEntry(
        **{**entry, **sets, **tuples, "rules": _rules(entry["rules"]), "combining": rules}
    )


def _rules(written: list[dict[str, Any]]) -> tuple[Rule, ...]:
    return tuple(Rule(**_frozen_values(rule)) for rule in written)


def _frozen_values(written: Mapping[str, Any]) -> dict[str, Any]:
    return {name: _frozen(value) for name, value in written.items()}


def _frozen(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value
