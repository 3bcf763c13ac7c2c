"""Who controls what: claims on the slots of actors, and changes of state at one instant.

Both are judged when the instant is settled, so a hand-over from one action to the next is silent
in whatever order the tree visits them, and two parallel actions on one slot are reported.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError, SlotConflict
from osc2tx_runtime.language.tree.base import place_key

if TYPE_CHECKING:
    from osc2tx_runtime.language.action import Action
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.world.commands import Command
    from osc2tx_runtime.world.protocol import World

__all__ = ["Effects", "Slots"]

SlotKey = tuple[str, str]  # (actor id, slot)


class Slots:
    """Owners of the slots, and the commands they want carried out."""

    def __init__(self) -> None:
        self._owners: dict[SlotKey, dict[Action, Command | None]] = {}
        self._touched: dict[SlotKey, None] = {}
        self._sent: dict[SlotKey, Command | None] = {}
        self._left: dict[SlotKey, Command | None] = {}

    def leave(self, key: SlotKey, command: Command | None) -> None:
        """Let a slot pursue a command while it has no owner; None holds what is."""
        if command is not self._left.get(key):
            self._left[key] = command
            self._touched[key] = None

    def claim(self, key: SlotKey, owner: Action) -> None:
        """Make `owner` an owner of the slot; claiming twice is claiming once."""
        self._owners.setdefault(key, {}).setdefault(owner, None)
        self._touched[key] = None

    def release(self, key: SlotKey, owner: Action) -> None:
        """Give the slot up; nothing happens if `owner` does not own it."""
        owners = self._owners.get(key, {})
        if owner in owners:
            del owners[owner]
            self._touched[key] = None

    def command(self, key: SlotKey, owner: Action, command: Command) -> None:
        """Keep the command of an owner until the instant is settled."""
        owners = self._owners.get(key, {})
        if owner not in owners:
            raise ScenarioError(
                f"{owner.name} commands the {key[1]} slot of {key[0]} without owning it",
                owner.source,
            )
        owners[owner] = command
        self._touched[key] = None

    def owners(self, key: SlotKey) -> tuple[Action, ...]:
        """Return the live owners of a slot."""
        return tuple(self._owners.get(key, ()))

    def live(self) -> tuple[SlotKey, ...]:
        """Return the slots that have an owner."""
        return tuple(sorted(key for key, owners in self._owners.items() if owners))

    def check(self) -> None:
        """Raise SlotConflict for the first slot (by name) with two live owners."""
        for key in sorted(self._touched):
            owners = self._owners.get(key, {})
            if len(owners) > 1:
                raise conflict(f"the {key[1]} slot of {key[0]}", list(owners))

    def send(self, world: World) -> None:
        """Hand the commands that changed to the world; an unowned slot gets what it is left to."""
        for key in sorted(self._touched):
            owners = self._owners.get(key, {})
            command = next(iter(owners.values()), self._left.get(key))
            if command is not self._sent.get(key):
                self._sent[key] = command
                world.command(*key, command)
        self._touched.clear()


@dataclass(frozen=True, slots=True)
class Effect:
    """A change of state one action asks for."""

    owner: Action
    value: object
    apply: Callable[[], None]


class Effects:
    """Changes of state of the present instant, by what they change."""

    def __init__(self) -> None:
        self._wanted: dict[tuple[str, ...], dict[Action, Effect]] = {}

    def add(self, key: tuple[str, ...], effect: Effect) -> None:
        """Remember an effect; a later one of the same owner takes its place."""
        effects = self._wanted.setdefault(key, {})
        effects.pop(effect.owner, None)  # so that the latest stands last
        effects[effect.owner] = effect

    def check(self) -> None:
        """Raise SlotConflict if two actions that are not in sequence want different values."""
        for key in sorted(self._wanted):
            # By place, so that the report is the same whatever the order of the visit.
            effects = sorted(
                self._wanted[key].values(),
                key=lambda effect: place_key(effect.owner),
            )
            for index, one in enumerate(effects):
                for other in effects[index + 1 :]:
                    if one.value != other.value and not in_sequence(one.owner, other.owner):
                        raise conflict(" ".join(key), [one.owner, other.owner])

    def apply(self) -> None:
        """Carry the effects out, by name of what they change; the last of a sequence counts."""
        wanted, self._wanted = self._wanted, {}
        for key in sorted(wanted):
            list(wanted[key].values())[-1].apply()

    def clear(self) -> None:
        """Forget all."""
        self._wanted.clear()


def conflict(what: str, owners: list[Action]) -> SlotConflict:
    """Return the error that names two owners and their places, in the order of the source."""
    first, second = sorted(owners, key=place_key)[:2]
    return SlotConflict(
        f"{first.name} ({first.source}) and {second.name} ({second.source}) control {what}"
        f" at the same time; {remedy(first, second)}",
        second.source or None,
    )


def remedy(one: Behaviour, other: Behaviour) -> str:
    """Return what may help where two nodes must not run at the same time."""
    from osc2tx_runtime.language.tree.compositions import OneOf

    if isinstance(nearest_above(one, other), OneOf):
        return "all members of a race run: let `--one-of first` or `seeded` choose one of them"
    return "let them run one after the other"


def in_sequence(one: Behaviour, other: Behaviour) -> bool:
    """Return whether a serial composition orders the two nodes."""
    from osc2tx_runtime.language.tree.compositions import Serial

    return isinstance(nearest_above(one, other), Serial)


def nearest_above(one: Behaviour, other: Behaviour) -> Behaviour | None:
    """Return the innermost node that two nodes are both in."""
    above = []
    node: Behaviour | None = one
    while node is not None:
        above.append(node)
        node = node.parent
    node = other
    while node is not None and node not in above:
        node = node.parent
    return node
