"""What a type inherits from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx.ir.user_types import UserType


def lineage(type_: str, own: Mapping[str, UserType]) -> tuple[str, ...]:
    """Return a type and its bases, up to the first ones of the library, most derived first.

    Args:
        type_: Name of the type.
        own: The types that the scenario's files declare.
    """
    if type_ not in own:
        return (type_,)
    return (type_, *merged([lineage(base, own) for base in own[type_].bases]))


def merged(lineages: Sequence[tuple[str, ...]]) -> tuple[str, ...]:
    """Return several lineages as one: what they share comes behind what only some of them have."""
    backwards = (name for each in reversed(lineages) for name in reversed(each))
    return tuple(reversed(dict.fromkeys(backwards)))
