"""The effective constraints after overriding (§7.3.11).

A later equality or range with the parameter alone on its left side replaces earlier defaults of
that parameter; `remove_default` drops all earlier defaults that mention it. All other later
constraints apply in addition.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from osc2tx.analysis.constraints.constraint import Constraint, Entry, Removal
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class EffectiveConstraints:
    """Constraints after overriding.

    Attributes:
        constraints: The effective ones, in the order of the text.
        replaced: The replaced defaults, with their replacements; `None` for `remove_default`.
    """

    constraints: tuple[Constraint, ...]
    replaced: Mapping[Constraint, Constraint | None]


def apply_overrides(entries: Iterable[Entry]) -> EffectiveConstraints:
    """Drop the defaults that something later replaces."""
    active: dict[Constraint, None] = {}
    replaced: dict[Constraint, Constraint | None] = {}
    defaults: dict[Key, list[Constraint]] = {}  # by every parameter that they mention
    for entry in entries:
        by = None if isinstance(entry, Removal) else entry
        if entry.subject is not None:
            left = []
            for default in defaults.get(entry.subject, ()):
                if default in replaced:
                    continue
                if by is None or default.subject in (None, entry.subject):
                    replaced[default] = by
                    del active[default]
                else:
                    left.append(default)
            defaults[entry.subject] = left
        if isinstance(entry, Constraint):
            active[entry] = None
            if entry.is_default:
                for key in entry.operations.keys:
                    defaults.setdefault(key, []).append(entry)
    return EffectiveConstraints(tuple(active), replaced)
