"""The base class of commands."""

from __future__ import annotations

from dataclasses import field

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """Base of all commands. Two commands are the same only if they are one object.

    Attributes:
        unphysical: Physics need not hold while it is at work.
    """

    unphysical: bool = field(default=False, kw_only=True)
