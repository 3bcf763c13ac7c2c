"""Declarations together with their support in the runtime and in XML."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from osc2tx.catalogue import ActionEntry, ModifierEntry, catalogue
from osc2tx.reference.declarations import Declaration, Member, declarations
from osc2tx_shared.classes import dataclass

TABLE = Path(__file__).with_name("shown.json")


@dataclass(frozen=True, slots=True)
class Shown:
    """Facts shown about an action or modifier; empty where there are none.

    Attributes:
        carla: Its support in CARLA.
        xml: The first version of OpenSCENARIO XML with it, or the reason why there is none.
        file: A scenario that uses it.
        example: Lines of that.
        xml_example: The same in the newest OpenSCENARIO XML.
    """

    carla: str = ""
    xml: str = ""
    file: str = ""
    example: str = ""
    xml_example: str = ""


NOTHING = Shown()


def shown(key: str) -> Shown:
    """Return the facts about an entry: `action vehicle.drive`."""
    return _table().get(key, NOTHING)


@cache
def _table() -> dict[str, Shown]:
    rows = json.loads(TABLE.read_text(encoding="utf-8"))
    return {key: Shown(**row) for key, row in rows.items()}


_ENDS = {
    "goal": "It ends when its goal is reached.",
    "at_once": "It reaches its goal instantly.",
    "instant": "It takes no time.",
    "open": "It is open-ended: `duration`, `until` or a surrounding composition ends it.",
}


@dataclass(frozen=True, slots=True)
class Entry:
    """A page of the reference.

    Attributes:
        declaration: The declaration in the library.
        facts: Its effects in the runtime, one sentence each.
        modifiers: Modifiers that an action accepts.
        actions: Actions of an actor and of its bases, `vehicle.drive`; none to inherit from.
        inherited: Members that an actor or a struct has from its bases.
        users: Declarations that use it as a type, or inherit from it.
    """

    declaration: Declaration
    facts: tuple[str, ...]
    modifiers: tuple[str, ...]
    users: tuple[str, ...]
    actions: tuple[str, ...] = ()
    inherited: tuple[Member, ...] = ()

    @property
    def key(self) -> str:
        """The name of the entry in queries: `action vehicle.drive`."""
        return f"{self.declaration.kind} {self.declaration.name}"

    @property
    def shown(self) -> Shown:
        """An example, with its support in CARLA and OpenSCENARIO XML."""
        return shown(self.key)

    @property
    def own_name(self) -> str:
        """The name without the actor."""
        return self.declaration.name.rpartition(".")[2]


@cache
def entries() -> tuple[Entry, ...]:
    """Return all entries, in the order of the library."""
    users = _users()
    return tuple(_entry(each, users.get(each.name, ())) for each in declarations())


def find(name: str) -> list[Entry]:
    """Return the entries of a name: `drive`, `vehicle.drive` or `action vehicle.drive`.

    Names repeat across kinds (`speed` is a type and a modifier), so there may be several.
    """
    exact = [each for each in entries() if name in (each.key, each.declaration.name)]
    last = [each for each in entries() if each.own_name == name]
    return exact + [each for each in last if each not in exact]


def _entry(declaration: Declaration, users: tuple[str, ...]) -> Entry:
    known = catalogue()
    if declaration.kind == "action" and declaration.name in known.actions:
        action = known.actions[declaration.name]
        return Entry(declaration, _action_facts(action), tuple(sorted(action.modifiers)), users)
    own = declaration.name.rpartition(".")[2]
    if declaration.kind == "modifier" and own in known.modifiers:
        modifier = known.modifiers[own]
        return Entry(declaration, _modifier_facts(modifier), (), users)
    if declaration.name in known.abstract:
        return Entry(declaration, ("It is a base for others.",), (), users)
    bases = _bases(declaration)
    owners = {declaration.name, *(base.name for base in bases)}
    actions = tuple(
        each.name
        for each in declarations()
        if each.kind == "action" and each.name not in known.abstract
        if each.name.rpartition(".")[0] in owners
    )
    inherited = tuple(member for base in bases for member in base.members)
    return Entry(declaration, (), (), users, actions, inherited)


def _bases(declaration: Declaration) -> list[Declaration]:
    """Return the supertypes of an actor or a struct, the nearest first."""
    by_name = {(each.kind, each.name): each for each in declarations()}
    bases: list[Declaration] = []
    while declaration.kind in ("actor", "struct") and declaration.base:
        declaration = by_name[declaration.kind, declaration.base]
        bases.append(declaration)
    return bases


def _action_facts(action: ActionEntry) -> tuple[str, ...]:
    facts = [_ENDS[action.ends]]
    if action.slots:
        facts.append(f"It controls the actor's {' and '.join(action.slots)} movement.")
    if action.physical:
        facts.append("It moves within physics: the actor does not jump.")
    return (*facts, *_shared_facts(action))


def _modifier_facts(modifier: ModifierEntry) -> tuple[str, ...]:
    facts = []
    if modifier.placement:
        facts.append("It can state the start of a scenario.")
    if modifier.bounds:
        facts.append("An open-ended action ends when the state of this modifier is reached.")
    return (*facts, *_shared_facts(modifier))


def _shared_facts(entry: ActionEntry | ModifierEntry) -> tuple[str, ...]:
    facts = []
    if entry.required:
        facts.append(f"It requires {_listed(entry.required)}.")
    if entry.needs:
        facts.append(f"The world must support {_listed(entry.needs)}.")
    return tuple(facts)


def _listed(names: tuple[str, ...] | frozenset[str]) -> str:
    return ", ".join(f"`{name}`" for name in sorted(names))


def _users() -> dict[str, tuple[str, ...]]:
    found: dict[str, dict[str, None]] = {}
    for each in declarations():
        types = [member.type for member in each.members]
        types += [item for member in each.members for item in member.parameters]
        names = {word for text in types for word in text.replace(":", " ").split()}
        for name in sorted(names | {each.base}):
            found.setdefault(name, {})[f"{each.kind} {each.name}"] = None
    return {name: tuple(users) for name, users in found.items()}
