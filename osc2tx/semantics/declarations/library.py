"""The resolved standard library, built once per process and shared by all programs."""

from __future__ import annotations

from functools import cache

from osc2tx.diagnostics import DiagnosticSink, InternalCompilerError
from osc2tx.semantics.check import check_bodies
from osc2tx.semantics.declarations.collect import Collector
from osc2tx.semantics.declarations.resolve import resolve_declarations
from osc2tx.semantics.dialects import DIALECTS, Dialect, Relaxations
from osc2tx.semantics.expressions import infer
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import Scope
from osc2tx.semantics.symbols import FieldSymbol, ModifierSymbol
from osc2tx.stdlib import LIBRARY, TYPES, library_file
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass


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


@dataclass(frozen=True, slots=True)
class Library:
    """The library of one standard and dialect; read-only once it is built.

    Attributes:
        scope: Its definitions.
        resolution: The side tables over its texts, for defaults of parameters.
    """

    scope: Scope
    resolution: Resolution


@cache
def shared_library(standard: str, dialect: str, modules: str) -> Library:
    """Return the shared library.

    Args:
        standard: `"2.1"` or `"2.2"`.
        dialect: Name of the dialect, whose prelude is part of the library.
        modules: `"none"`, `"types"` or `"all"`.
    """
    return build_library(standard, DIALECTS[dialect], modules)


def build_library(standard: str, dialect: Dialect, modules: str) -> Library:
    """Build a library that its caller may change, to extend library types."""
    sink = DiagnosticSink()
    scope = Scope()
    resolution = Resolution(scope, sink, Relaxations(dialect), standard, infer)
    collector = Collector(scope, sink, resolution.relaxations, origin="library")
    names = {"none": (), "types": (TYPES,), "all": LIBRARY}[modules]
    for name in names:
        collector.collect_file(library_file(name, standard))
    if dialect.prelude is not None and modules == "all":
        collect_prelude(resolution, collector, library_file(dialect.prelude, standard))
    else:
        resolve_declarations(resolution, collector)
    check_bodies(resolution)
    if sink.has_errors:
        first = sink.sorted()[0]
        raise InternalCompilerError(f"library: {first.primary}: {first.message}")
    return Library(scope, resolution)
