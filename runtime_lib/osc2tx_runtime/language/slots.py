"""Slots of actors with their owners and commands; effects of one instant.

Slots are checked when the instant is settled: a hand-over from one action to the next is silent,
whatever the order of the visit, and two parallel actions on one slot are reported. Effects are
applied within the instant, all requested ones together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, Protocol

from py_trees.behaviour import Behaviour

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.commands import Command
from osc2tx_runtime.world.protocol import World

SlotKey = tuple[str, str]  # (actor id, slot)


class Owner(Protocol):
    """The owner of a slot: an action, a node of the tree."""

    name: str
    source: str
    parent: Behaviour | None


class Slots:
    """Owners of the slots, and their commands."""

    def __init__(self) -> None:
        self._owners: dict[SlotKey, dict[Owner, Command | None]] = {}
        self._touched: dict[SlotKey, None] = {}
        self._sent: dict[SlotKey, Command | None] = {}
        self._left: dict[SlotKey, Command | None] = {}
        self._passed: dict[SlotKey, list[Owner]] = {}

    @property
    def is_touched(self) -> bool:
        """Whether they changed at this instant."""
        return bool(self._touched or self._passed)

    def leave(self, key: SlotKey, command: Command | None) -> None:
        """Set the command of a slot without owner; None holds the present motion."""
        if command is not self._left.get(key):
            self._left[key] = command
            self._touched[key] = None

    def claim(self, key: SlotKey, owner: Owner) -> None:
        """Make `owner` an owner of the slot; a repeated claim has no effect."""
        self._owners.setdefault(key, {}).setdefault(owner, None)
        self._touched[key] = None

    def release(self, key: SlotKey, owner: Owner) -> None:
        """Release the slot; no effect if `owner` does not own it."""
        owners = self._owners.get(key, {})
        if owner in owners:
            del owners[owner]
            self._touched[key] = None

    def pass_through(self, key: SlotKey, owner: Owner) -> None:
        """Note an owner that held the slot for no time, and changed a state that it controls.

        Earlier commands are void, and a simultaneous owner of the slot is in conflict.
        """
        self._passed.setdefault(key, []).append(owner)

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

    def passed(self) -> Iterator[tuple[SlotKey, Owner, Owner]]:
        """Yield slots that an owner held for no time while another holds them, with both."""
        for key in sorted(self._passed):
            for owner in self._passed[key]:
                for live in self._owners.get(key, ()):
                    yield key, owner, live

    def send(self, world: World) -> None:
        """Send the changed commands to the world; a slot without owner gets its default."""
        for key in sorted(self._touched):
            owners = self._owners.get(key, {})
            command = next(iter(owners.values()), self._left.get(key))
            if command is not self._sent.get(key) or key in self._passed:
                self._sent[key] = command
                world.command(*key, command)
        self._touched.clear()
        self._passed.clear()


class Effect(NamedTuple):
    """A change of state that an action requests."""

    owner: Owner
    value: Any
    apply: Callable[[], None]


class Effects:
    """Changes of state of the present instant, by quantity."""

    def __init__(self) -> None:
        self._wanted: dict[tuple[str, ...], dict[Owner, Effect]] = {}
        self._done: dict[tuple[str, ...], list[Effect]] = {}

    def begin_step(self) -> None:
        """Clear the effects of the instant before."""
        self._done.clear()

    def add(self, key: tuple[str, ...], effect: Effect) -> None:
        """Add an effect, unless its owner has already applied it at this instant.

        A later one of the same owner replaces it.
        """
        done = self._done.get(key)
        if done and done[-1].owner is effect.owner and done[-1].value == effect.value:
            return
        self._wanted.setdefault(key, {})[effect.owner] = effect

    def withdraw(self, owner: Owner) -> None:
        """Remove the requests of an owner."""
        for effects in self._wanted.values():
            effects.pop(owner, None)

    def is_pending(self, owner: Owner | None = None) -> bool:
        """Whether a request, or one of an owner, is not applied yet."""
        if not self._wanted:
            return False
        wanted = self._wanted.values()
        return any(wanted) if owner is None else any(owner in each for each in wanted)

    def contested(self) -> Iterator[tuple[tuple[str, ...], Effect, Effect]]:
        """Yield the quantities for which two actions request different values."""
        for key in sorted(self._wanted):
            effects = [*self._done.get(key, ()), *self._wanted[key].values()]
            for index, one in enumerate(effects):
                for other in effects[index + 1 :]:
                    if one.owner is not other.owner and one.value != other.value:
                        yield key, one, other

    def apply(self) -> None:
        """Apply the requests, by name of the quantity."""
        wanted, self._wanted = self._wanted, {}
        for key in sorted(wanted):
            if effects := list(wanted[key].values()):
                _carry_out(effects[-1])
                self._done.setdefault(key, []).extend(effects)

    def clear(self) -> None:
        """Forget all."""
        self._wanted.clear()
        self._done.clear()


def _carry_out(effect: Effect) -> None:
    try:
        effect.apply()
    except ScenarioError as error:
        error.source = error.source or effect.owner.source or None
        raise
