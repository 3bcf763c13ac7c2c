"""Checks of commands when they are given, before a world computes with them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import fields

from osc2tx_runtime.world.commands import Command, ReplayTrajectory
from osc2tx_runtime.world.commands import (
    lateral as lateral_commands,
)
from osc2tx_runtime.world.commands import (
    longitudinal as longitudinal_commands,
)
from osc2tx_runtime.world.protocol import LATERAL, LONGITUDINAL

from .values import problem_of

COMMANDS = {
    slot: tuple(kind for kind in vars(module).values() if isinstance(kind, type))
    for slot, module in ((LONGITUDINAL, longitudinal_commands), (LATERAL, lateral_commands))
}


def command_problem(command: object, slot: str, actors: Collection[str]) -> str:
    """Return why a slot cannot execute a command; empty if it can.

    Args:
        command: The given value.
        slot: The slot.
        actors: Ids of the placed actors.
    """
    kind = type(command)
    if not isinstance(command, Command) or kind is Command:
        return f"a {kind.__name__} is not a command"
    if kind not in COMMANDS[slot] and kind is not ReplayTrajectory:
        return f"{kind.__name__} is not a command of the {slot} slot"
    problem = problem_of(command, kind)
    if problem:
        return f"{kind.__name__}: {problem}"
    missing = [name for name in _references(command) if name not in actors]
    return f"{kind.__name__}: there is no actor {missing[0]!r}" if missing else ""


def _references(command: Command) -> Iterator[str]:
    """Yield the actors that a command refers to, also in its inner commands."""
    for each in fields(command):
        value = getattr(command, each.name)
        if isinstance(value, Command):
            yield from _references(value)
        elif each.name == "reference" and value is not None:
            yield value
