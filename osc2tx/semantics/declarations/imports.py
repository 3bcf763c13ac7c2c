"""Imports: the files of a program, in order (§7.7.5)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field
from pathlib import PurePosixPath

from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.diagnostics.fixes import Help, write
from osc2tx.semantics.dialects import LIBRARY_FILES, RUNNER_FILE, Relaxations
from osc2tx.support.paths import real_path
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

LoadFile = Callable[[ast.Import, SourceFile], ast.File | None]
ImportHelp = Callable[[ast.Import], str | None]

RESERVED = frozenset({"std", "stdtypes"})  # namespaces of the library, no modules
LEGACY = ("osc", "standard")
MODULES = {
    LEGACY: "all",
    (*LEGACY, "all"): "all",
    (*LEGACY, "types"): "types",
    (*LEGACY, "domain"): "all",
}


@dataclass(slots=True, eq=False)
class ImportWalk:
    """Follows imports depth first; every file counts once, at its first import.

    Attributes:
        load: Finds and parses a file that is imported by name; `None` if there is no such file.
        import_help: Returns the help for a module that is not found.
        sink: Receives the diagnostics.
        relaxations: The dialect of the file.
        files: The files, each after those that it imports.
        imported: The names of the files that each file imports itself.
        modules: Parts of the library that are needed, `"types"` or `"all"`.
        is_legacy: Whether library names need no prefix in the null namespace.
    """

    load: LoadFile
    import_help: ImportHelp
    sink: DiagnosticSink
    relaxations: Relaxations
    files: list[ast.File] = field(default_factory=list)
    imported: dict[str, set[str]] = field(default_factory=dict)
    modules: set[str] = field(default_factory=set)
    is_legacy: bool = False
    _seen: set[object] = field(default_factory=set)

    def visit(self, file: ast.File) -> None:
        """Add a file after those it imports."""
        self._seen.add(_identity(file))
        for statement in file.imports:
            if statement.uri is None:
                self._import_module(statement)
            else:
                self._import_file(statement, statement.uri, file.span.source)
        self.files.append(file)

    def _import_module(self, statement: ast.Import) -> None:
        module = MODULES.get(statement.module)
        if module is not None:
            self.modules.add(module)
            self.is_legacy |= statement.module == LEGACY
            return
        name = ".".join(statement.module)
        if statement.module[-1] == "osc" and len(statement.module) == 2:
            self._import_unquoted(statement, name)
            return
        library = "the standard library is `osc.standard.all`"
        if statement.module[:1] == ("osc",):
            advice: Help = write(statement.span, "import osc.standard", library, is_safe=False)
        else:
            imported = self.load(statement, statement.span.source)
            if imported is not None:
                self._follow(statement, imported)
                return
            is_library = statement.module[0] in RESERVED
            advice = library if is_library else self.import_help(statement)
        self._report(statement, f"no module `{name}`", advice)

    def _import_unquoted(self, statement: ast.Import, name: str) -> None:
        """Import `name.osc`, as ScenarioRunner writes it; the library is taken for granted."""
        source = statement.span.source
        if "OSC617" not in self.relaxations.dialect.relaxed:
            quoted_import = f'import "{name}"'
            help_ = f"to import a file write `{quoted_import}`"
            if name == RUNNER_FILE:
                help_ += "; for a scenario of ScenarioRunner check with `--dialect carla`"
            advice = write(statement.span, quoted_import, help_, is_safe=False)
            self._report(statement, f"no module `{name}`", advice)
            return
        self.modules.add("all")
        quoted = ast.Import(span=statement.span, uri=name, module=())
        found = self.load(quoted, source)
        if found is None or not self.relaxations.is_new("OSC617", source.name, name):
            self._import_file(quoted, name, source)
            return
        self.sink.report(
            "OSC617",
            statement.span,
            f'`import {name}` is taken for `import "{name}"`',
            help=write(statement.span, f'import "{name}"'),
        )
        self._follow(quoted, found)

    def _import_file(self, statement: ast.Import, uri: str, source: SourceFile) -> None:
        imported = self.load(statement, source)
        if imported is not None:
            self._follow(statement, imported)
            return
        name = PurePosixPath(uri).name
        if name in self.relaxations.dialect.library_files and "/" not in uri:
            self.modules.add("types" if name == "types.osc" else "all")
            if self.relaxations.is_new("OSC606", source.name, uri):
                whole = "the standard library"
                taken = f"the prelude of dialect `{self.relaxations.dialect.name}`"
                self.sink.report(
                    "OSC606",
                    statement.span,
                    f'`"{uri}"` is taken for {taken if name == RUNNER_FILE else whole}; '
                    "there is no such file",
                    help=write(statement.span, "import osc.standard.all"),
                )
            return
        advice: Help = None
        if name in LIBRARY_FILES:
            library = "import osc.standard.all"
            help_ = f"for the standard library write `{library}`"
            advice = write(statement.span, library, help_, is_safe=False)
        elif name == RUNNER_FILE:
            advice = "for a scenario of ScenarioRunner check with `--dialect carla`"
        self._report(statement, f'no file `"{uri}"`', advice)

    def _follow(self, statement: ast.Import, file: ast.File) -> None:
        importing = statement.span.source.name
        self.imported.setdefault(importing, set()).add(file.span.source.name)
        if _identity(file) not in self._seen:
            self.visit(file)

    def _report(self, statement: ast.Import, message: str, help: Help) -> None:
        """Report a failed import; library names are known from then on, to avoid a flood."""
        self.sink.report("OSC205", statement.span, message, help=help)
        self.modules.add("all")
        self.is_legacy = True


def no_help(statement: ast.Import) -> str | None:
    """Return no help: without files there is no folder for a module."""
    return None


def _identity(file: ast.File) -> object:
    source = file.span.source
    return real_path(source.path) if source.path is not None else source.name
