"""The lengths of members, as far as the text states them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from osc2tx.lowering.behavior.invoked_times import MOST_CHOICES
from osc2tx.lowering.behavior.time_expressions import Terms
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Known:
    """A member whose length the text states."""

    terms: Terms


class Filling:
    """A member that takes as long as it is given: open-ended, or an action of free length."""


@dataclass(frozen=True, slots=True)
class Stretchable:
    """A composition with open-ended members, which take any time beyond that of the others."""

    terms: Terms


@dataclass(frozen=True, slots=True)
class Either:
    """A member that has one of several lengths: of the alternatives of a `one_of`."""

    options: tuple[Terms, ...]


Length: TypeAlias = Known | Stretchable | Either | Filling | None
"""Facts about the length of a member; `None` if only the run decides."""

INSTANT = Known(())
OPEN, FREE = Filling(), Filling()
LEAST = Filling()
"""The length of a member that continues for at least some time."""


def choice(options: Sequence[Terms]) -> Length:
    """Return the length of a member that has one of several lengths."""
    if not options or len(options) > MOST_CHOICES:
        return None
    return Known(options[0]) if len(options) == 1 else Either(tuple(options))


def alternatives(lengths: Sequence[Length]) -> Length:
    """Return the length of a `one_of`, given those of its members."""
    found: list[Terms] = []
    if OPEN in lengths and all(each is OPEN or isinstance(each, Known) for each in lengths):
        return Stretchable(())
    for length in lengths:
        if not isinstance(length, Known | Either):
            return None
        found += (length.terms,) if isinstance(length, Known) else length.options
    return choice(found)
