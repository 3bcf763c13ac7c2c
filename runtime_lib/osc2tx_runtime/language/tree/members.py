"""What compositions ask their members; other py_trees behaviours are members too."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from osc2tx_runtime.errors import OwnCode, name_of
from osc2tx_runtime.language.tree.base import (
    FAILURE,
    INVALID,
    Behaviour,
    Node,
    Status,
    checked,
)
from osc2tx_shared.rules.endings import Ending

Member: TypeAlias = tuple[Behaviour, Callable[[], Status]]
"""A member with the call that ticks it."""


def pulse_of(child: Behaviour) -> Callable[[], Status]:
    """Return the call that ticks a member: `Node` or another py_trees behaviour."""
    if isinstance(child, Node):
        return child.pulse

    def tick_foreign() -> Status:
        with OwnCode(f"{child.name}: {name_of(type(child))} raised"):
            child.tick_once()
        return FAILURE if child.status is INVALID else checked(child, child.status)

    return tick_foreign


def ended_late(child: Behaviour) -> float:
    """Return the lateness (s) of the end of a member; other py_trees behaviours end at a step."""
    return child.ended_late if isinstance(child, Node) else 0.0


def is_open(child: Behaviour) -> bool:
    """Return whether a member is open-ended; other py_trees behaviours are not."""
    return isinstance(child, Node) and child.open_ended


def ending_of(child: Behaviour) -> Ending:
    """Return how a member ends; one that only accompanies the others has no time of its own."""
    if is_instant(child) or is_service(child):
        return "instant"
    return "open" if is_open(child) else "bounded"


def goes_on(child: Behaviour) -> bool:
    """Return whether only the surroundings of a running member end it from here on."""
    return isinstance(child, Node) and child.goes_on()


def open_since(child: Behaviour) -> tuple[int, float]:
    """Return since when only the surroundings of a running member end it: step, lateness (s)."""
    return child.open_since() if isinstance(child, Node) else (0, 0.0)


def least_length(child: Behaviour) -> int | None:
    """Return the steps that an open-ended member needs; None if only the run shows them."""
    return child.least_length() if isinstance(child, Node) else None


def is_instant(child: Behaviour) -> bool:
    """Return whether a member takes no time."""
    return isinstance(child, Node) and child.takes_no_time


def is_service(child: Behaviour) -> bool:
    """Return whether a member only accompanies the others."""
    return isinstance(child, Node) and child.service


def length_of(child: Behaviour) -> int | None:
    """Return the number of steps of a member, if known; unknown for other py_trees behaviours."""
    return child.length() if isinstance(child, Node) else None
