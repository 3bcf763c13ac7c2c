"""What a type inherits from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

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


def lineages(own: Iterable[UserType]) -> dict[str, tuple[str, ...]]:
    """Return the lineages of types that are declared bases first: each made from those before."""
    found: dict[str, tuple[str, ...]] = {}
    for each in own:
        found[each.name] = (each.name, *merged([found.get(b, (b,)) for b in each.bases]))
    return found


def merged(several: Sequence[tuple[str, ...]]) -> tuple[str, ...]:
    """Return several lineages as one: what they share comes behind what only some of them have."""
    if len(several) == 1:
        return several[0]
    backwards = (name for each in reversed(several) for name in reversed(each))
    return tuple(reversed(dict.fromkeys(backwards)))
