"""The driver of the stage: imports, definition pass, resolution pass."""

from __future__ import annotations

from dataclasses import field

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.semantics.check import check_bodies
from osc2tx.semantics.declarations.collect import LIBRARY_NAMESPACES, Collector
from osc2tx.semantics.declarations.imports import ImportHelp, ImportWalk, LoadFile, no_help
from osc2tx.semantics.declarations.library import Library, build_library, shared_library
from osc2tx.semantics.declarations.list_elements import list_elements
from osc2tx.semantics.declarations.resolve import resolve_declarations
from osc2tx.semantics.dialects import Dialect, Relaxations
from osc2tx.semantics.expressions import infer
from osc2tx.semantics.model import SemanticModel
from osc2tx.semantics.names.actors_by_name import pass_actors
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import Scope
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    EnumSymbol,
    FieldSymbol,
    ScenarioSymbol,
    StructSymbol,
)
from osc2tx.support.recursion import allowing_deep_trees
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass


def rename_ambiguous_types(scope: Scope) -> None:
    """Rename the types of a layer whose names denote other types as well."""
    for name, group in scope.types.items():
        below = scope.parent is not None and scope.parent.types_named(name)
        for symbol in group if below else group[1:]:
            if isinstance(symbol, ActorSymbol | EnumSymbol | StructSymbol):
                symbol.name = f"{symbol.namespace}::{name}"


@dataclass(slots=True, eq=False)
class ModelBuilder:
    """Builds the semantic model of a program; never raises on bad input.

    Attributes:
        sink: Receives the diagnostics.
        standard: `"2.1"` or `"2.2"`.
        dialect: The dialect of the file.
        load: Finds and parses imported files; `None` means that there is no such file.
        import_help: Returns the help for a module that is not found.
    """

    sink: DiagnosticSink
    standard: str = field(kw_only=True)
    dialect: Dialect = field(kw_only=True)
    load: LoadFile = field(kw_only=True)
    import_help: ImportHelp = field(kw_only=True, default=no_help)

    def build(self, root: ast.File) -> SemanticModel:
        """Check the program that starts at a file."""
        with allowing_deep_trees():
            try:
                return self._build(root)
            except RecursionError:
                start = Span(root.span.source, 0, 0)
                self.sink.report("OSC105", start, "the text nests too deeply to be checked")
                return SemanticModel(root=root, files=(root,), scenarios=())

    def _build(self, root: ast.File) -> SemanticModel:
        relaxations = Relaxations(self.dialect)
        walk = ImportWalk(self.load, self.import_help, self.sink, relaxations)
        walk.visit(root)
        library = self._library(walk)
        resolution, collector = self._new_layer(library, walk, relaxations)
        for file in walk.files:
            collector.collect_file(file)
        _check_uses(resolution, walk.files)
        resolve_declarations(resolution, collector)
        check_bodies(resolution)
        pass_actors(resolution)
        rename_ambiguous_types(resolution.scope)
        return _model(root, walk, resolution, library)

    def _library(self, walk: ImportWalk) -> Library:
        modules = "all" if "all" in walk.modules else "types" if walk.modules else "none"
        if self.dialect.unprefixed_library and len(walk.files) == 1:
            modules = "all"  # such files often import nothing
        if any(_is_extension(s) for file in walk.files for s in file.statements):
            return build_library(self.standard, self.dialect, modules)
        return shared_library(self.standard, self.dialect.name, modules)

    def _new_layer(
        self, library: Library, walk: ImportWalk, relaxations: Relaxations
    ) -> tuple[Resolution, Collector]:
        scope = Scope(parent=library.scope)
        resolution = Resolution(scope, self.sink, relaxations, self.standard, infer)
        if "all" not in walk.modules:
            resolution.unimported = lambda: (
                shared_library(self.standard, self.dialect.name, "all").scope
            )
        unprefixed = walk.is_legacy or self.dialect.unprefixed_library
        uses = LIBRARY_NAMESPACES if unprefixed else ()
        return resolution, Collector(scope, self.sink, relaxations, null_uses=uses)


def _is_extension(statement: ast.FileStatement) -> bool:
    return isinstance(statement, ast.EnumExtension | ast.TypeExtension | ast.PrimitiveExtension)


def _check_uses(r: Resolution, files: list[ast.File]) -> None:
    for file in files:
        for statement in file.statements:
            for name in _namespaces_in(statement):
                if not r.scope.has_namespace(name):
                    library = name in LIBRARY_NAMESPACES
                    r.report(
                        "OSC206",
                        statement.span,
                        f"no namespace `{name}`",
                        help="import the library: `import osc.standard.all`" if library else None,
                    )


def _namespaces_in(statement: ast.FileStatement) -> tuple[str, ...]:
    """Return the namespaces that a statement takes for granted."""
    match statement:
        case ast.NamespaceStatement(uses=uses):
            return uses
        case ast.ExportStatement(items=items):
            return tuple(i.namespace for i in items if i.name is None and i.namespace is not None)
        case _:
            return ()


def _model(root: ast.File, walk: ImportWalk, r: Resolution, library: Library) -> SemanticModel:
    below = library.resolution
    scenarios = tuple(
        s
        for s in r.scope.declared
        if isinstance(s, ScenarioSymbol) and s.span.source is root.span.source
    )
    actions = tuple(
        s
        for layer in (library.scope, r.scope)
        for s in layer.declared
        if isinstance(s, ActionSymbol)
    )
    references = {**below.references, **r.references}
    bindings = {**below.bindings, **r.bindings}
    symbols = tuple(r.scope.declared)
    return SemanticModel(
        root=root,
        files=tuple(walk.files),
        scenarios=scenarios,
        actions=actions,
        types={**below.types, **r.types},
        references=references,
        bindings=bindings,
        units={**below.units, **r.units},
        quantities=r.quantities,
        symbols=symbols,
        known_units=tuple(r.scope.all_units()),
        elements=list_elements(symbols, references, bindings),
        global_parameters=tuple(s for s in symbols if isinstance(s, FieldSymbol)),
        callees=frozenset(binding.callee for binding in bindings.values()),
        imported=walk.imported,
    )
