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
        required: The required ones.
        modifiers: Modifiers that it supports.
        modifiers_with: Those that it supports with a value of a parameter, by that parameter;
            `""`: without a value.
        moves: Whether it moves as its modifiers state, so that they must go together.
        physical: Whether it cannot let the actor jump.
        slots: The slots of the actor that it controls: `longitudinal`, `lateral`.
        ends: At its `goal`, `at_once` with a goal that takes no time, in the `instant` it starts,
            or `open`: only with its surroundings.
        places: Whether its arguments state where the actor is.
        paces: Whether it sets or holds the speed of the actor.
        needs: Capabilities of the world that it requires.
        rules: Rules for combinations of arguments.
        without_xml: Why OpenSCENARIO XML has no form of it; empty if it has one.
    """

    section: str
    arguments: frozenset[str]
    required: frozenset[str]
    modifiers: frozenset[str]
    modifiers_with: Mapping[str, Mapping[str, frozenset[str]]]
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
        owner: The actor of which it is a member (`map`, `vehicle`); empty for members of actions.
        section: Of OpenSCENARIO DSL 2.2; empty if the standard does not have it.
        parameters: The parameters that the runtime takes.
        required: The required ones.
        shape: Base of the shapes that it takes; `None` if it takes none.
        rules: Rules for combinations of arguments.
        combining: Its effect on other modifiers of the same action.
        slots: The slots of the actor that it controls: `longitudinal`, `lateral`.
        places: Whether it states where the actor is.
        paces: Whether it states the speed of the actor, or its position at each time.
        bounds: Whether an open-ended action ends when the state of the modifier is reached.
        placement: Whether an actor, or the map, can start with it.
        orders: Parameters that only state an order, such as `faster_than`,
        amounts: whose amount is given by one of these, or stays open.
        needs: Capabilities of the world that it requires.
        without_xml: Why OpenSCENARIO XML has no form of it; empty if it has one.
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
    """The items of the library, and the classes of the runtime for them.

    Attributes:
        actions: By actor and name, `vehicle.drive`.
        modifiers: By name; those of different actors have different names.
        abstract: Actions that exist only to be inherited from.
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
    narrowed = {
        parameter: {value: frozenset(names) for value, names in values.items()}
        for parameter, values in entry["modifiers_with"].items()
    }
    rules = _rules(entry["rules"])
    return ActionEntry(**{**entry, **sets, **tuples, "modifiers_with": narrowed, "rules": rules})


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


@dataclass(frozen=True, slots=True)
class ObjectTables:
    """The runtime's items besides actions and modifiers, by the names of the language.

    Attributes:
        methods: `physical_object.object_distance` to its parameters.
        fields: Members one can read, `movable_object.speed`.
        objects: Type of actor or struct to the arguments of its constructor.
        needed: Type of actor or struct to the required arguments of its constructor.
        unknown: Members of actors that only the scenario can state.
        reserved: What actors of the runtime have besides actions.
        declared: Structs that are objects like actors, not values, to their members.
        lane_bound: Types of actors that follow lanes.
        enums: Names of the types of the library's enums.
        units: Names of the library's units.
    """

    methods: Mapping[str, frozenset[str]]
    fields: frozenset[str]
    objects: Mapping[str, frozenset[str]]
    needed: Mapping[str, frozenset[str]]
    unknown: frozenset[str]
    reserved: frozenset[str]
    declared: Mapping[str, frozenset[str]]
    lane_bound: frozenset[str]
    enums: frozenset[str]
    units: frozenset[str]


@cache
def object_tables() -> ObjectTables:
    """Return the tables."""
    table = json.loads(Path(__file__).with_name("objects.json").read_text(encoding="utf-8"))

    def sets(name: str) -> dict[str, frozenset[str]]:
        return {key: frozenset(values) for key, values in table[name].items()}

    return ObjectTables(
        methods=sets("methods"),
        fields=frozenset(table["fields"]),
        objects=sets("objects"),
        needed=sets("needed"),
        unknown=frozenset(table["unknown"]),
        reserved=frozenset(table["reserved"]),
        declared=sets("declared"),
        lane_bound=frozenset(table["lane_bound"]),
        enums=frozenset(table["enums"]),
        units=frozenset(table["units"]),
    )
