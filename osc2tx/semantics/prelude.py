"""Preludes of dialects, which may change declarations of the library."""

from __future__ import annotations

from osc2tx.semantics.collect import Collector
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.resolve import resolve_declarations
from osc2tx.semantics.symbols import FieldSymbol, ModifierSymbol
from osc2tx.syntax import ast


def collect_prelude(r: Resolution, collector: Collector, file: ast.File) -> None:
    """Collect a prelude on top of the library, and resolve both.

    A modifier declared again replaces that of the library; only its new parameters count as
    declared by the prelude. An extension may declare a field again.
    """
    library = {name: list(group) for name, group in r.scope.modifiers.items()}
    collector.origin = "prelude"
    collector.collect_file(file)
    for name, group in r.scope.modifiers.items():
        for modifier in [m for m in group if m.origin == "prelude"]:
            for replaced in library.get(name, ()):
                _replace(r, group, replaced, modifier)
    resolve_declarations(r, collector)


def _replace(
    r: Resolution, group: list[ModifierSymbol], old: ModifierSymbol, new: ModifierSymbol
) -> None:
    group.remove(old)
    r.scope.declared.remove(old)
    new.origin = "library"
    for name, member in new.members.items():
        earlier = old.members.get(name)
        if isinstance(member, FieldSymbol) and earlier is not None:
            member.origin = "library"
