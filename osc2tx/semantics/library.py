"""The resolved standard library, built once per process and shared by all programs."""

from __future__ import annotations

from functools import cache

from osc2tx.diagnostics import DiagnosticSink, InternalCompilerError
from osc2tx.semantics.check import check_bodies
from osc2tx.semantics.collect import Collector
from osc2tx.semantics.dialects import DIALECTS, Dialect, Relaxations
from osc2tx.semantics.expressions import infer
from osc2tx.semantics.prelude import collect_prelude
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.resolve import resolve_declarations
from osc2tx.semantics.scope import Scope
from osc2tx.stdlib import DOMAIN, TYPES, library_file
from osc2tx_classes import dataclass


@dataclass(frozen=True, slots=True)
class Library:
    """The library of one standard and dialect; nobody writes to it once it is built.

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
    names = {"none": (), "types": (TYPES,), "all": (TYPES, DOMAIN)}[modules]
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
