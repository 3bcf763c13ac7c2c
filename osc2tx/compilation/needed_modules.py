"""The modules that the module of a file needs, and the compilations that determine them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx.compilation.driver import Compilation

if TYPE_CHECKING:
    from osc2tx.backends.py_trees.emitter import GeneratedModule


def siblings_of(compilation: Compilation) -> tuple[Compilation, ...]:
    """Return the imported files whose modules one needs, directly or through others."""
    found: dict[str, Compilation] = {}
    pending = [compilation] if compilation.has_module else []
    while pending:
        current = pending.pop()
        needed = {home.source for home in current.sharing.homes.values()} - found.keys()
        new = {name: current.compiled_alone[name] for name in needed}
        found |= new
        pending += new.values()
    return tuple(found[name] for name in sorted(found))


def sibling_modules(compilation: Compilation) -> tuple[GeneratedModule, ...]:
    """Return the modules of those files."""
    modules = (each.module for each in siblings_of(compilation))
    return tuple(module for module in modules if module is not None)


def sibling_drafts(compilation: Compilation) -> tuple[GeneratedModule, ...]:
    """Return the same modules to be executed and not read."""
    drafts = (each.draft for each in siblings_of(compilation))
    return tuple(draft for draft in drafts if draft is not None)


def all_compiled_alone(compilation: Compilation) -> tuple[Compilation, ...]:
    """Return the imported files that were compiled for themselves, for this one or for others."""
    found: dict[str, Compilation] = {}
    pending = [compilation]
    while pending:
        made = pending.pop().compiled_alone
        new = {name: each for name, each in made.items() if name not in found}
        found |= new
        pending += new.values()
    return tuple(found[name] for name in sorted(found))
