"""Slots of actors with their owners and commands; effects of one instant.

Both are judged when the instant is settled, so a hand-over from one action to the next is silent
in whatever order the tree visits them, and two parallel actions on one slot are reported.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Protocol

from py_trees.behaviour import Behaviour

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.commands import Command
from osc2tx_runtime.world.protocol import World

__all__ = ["Effect", "Effects", "Owner", "Slots"]

SlotKey = tuple[str, str]  # (actor id, slot)


class Owner(Protocol):
    """What controls a slot: an action, a node of the tree."""

    name: str
    source: str
    parent: Behaviour | None


class Slots:
    """Owners of the slots, and the commands they want carried out."""

    def __init__(self) -> None:
        self._owners: dict[SlotKey, dict[Owner, Command | None]] = {}
        self._touched: dict[SlotKey, None] = {}
        self._sent: dict[SlotKey, Command | None] = {}
        self._left: dict[SlotKey, Command | None] = {}

    def leave(self, key: SlotKey, command: Command | None) -> None:
        """Let a slot pursue a command while it has no owner; None holds what is."""
        if command is not self._left.get(key):
            self._left[key] = command
            self._touched[key] = None

    def claim(self, key: SlotKey, owner: Owner) -> None:
        """Make `owner` an owner of the slot; claiming twice is claiming once."""
        self._owners.setdefault(key, {}).setdefault(owner, None)
        self._touched[key] = None

    def release(self, key: SlotKey, owner: Owner) -> None:
        """Give the slot up; nothing happens if `owner` does not own it."""
        owners = self._owners.get(key, {})
        if owner in owners:
            del owners[owner]
            self._touched[key] = None

    def command(self, key: SlotKey, owner: Owner, command: Command) -> None:
        """Keep the command of an owner until the instant is settled."""
        owners = self._owners.get(key, {})
        if owner not in owners:
            raise ScenarioError(
                f"{owner.name} commands the {key[1]} slot of {key[0]} without owning it",
                owner.source,
            )
        owners[owner] = command
        self._touched[key] = None

    def owners(self, key: SlotKey) -> tuple[Owner, ...]:
        """Return the live owners of a slot."""
        return tuple(self._owners.get(key, ()))

    def live(self) -> tuple[SlotKey, ...]:
        """Return the slots that have an owner."""
        return tuple(sorted(key for key, owners in self._owners.items() if owners))

    def contested(self) -> Iterator[tuple[SlotKey, list[Owner]]]:
        """Yield the slots with several live owners, by name."""
        for key in sorted(self._touched):
            owners = list(self._owners.get(key, ()))
            if len(owners) > 1:
                yield key, owners

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

    owner: Owner
    value: object
    apply: Callable[[], None]


class Effects:
    """Changes of state of the present instant, by what they change."""

    def __init__(self) -> None:
        self._wanted: dict[tuple[str, ...], dict[Owner, Effect]] = {}

    def add(self, key: tuple[str, ...], effect: Effect) -> None:
        """Remember an effect; a later one of the same owner takes its place."""
        effects = self._wanted.setdefault(key, {})
        effects.pop(effect.owner, None)  # so that the latest stands last
        effects[effect.owner] = effect

    def contested(self) -> Iterator[tuple[tuple[str, ...], list[Effect]]]:
        """Yield what several actions want to change, by its name."""
        for key in sorted(self._wanted):
            effects = list(self._wanted[key].values())
            if len(effects) > 1:
                yield key, effects

    def apply(self) -> None:
        """Carry the effects out, by name of what they change; the last of a sequence counts."""
        wanted, self._wanted = self._wanted, {}
        for key in sorted(wanted):
            list(wanted[key].values())[-1].apply()

    def clear(self) -> None:
        """Forget all."""
        self._wanted.clear()
