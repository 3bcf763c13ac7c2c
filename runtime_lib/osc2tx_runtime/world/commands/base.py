"""The base class of commands."""

from __future__ import annotations

from dataclasses import field

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """Base of all commands. Commands are compared by identity.

    Attributes:
        unphysical: Whether physics need not hold while it is effective.
    """

    unphysical: bool = field(default=False, kw_only=True)
