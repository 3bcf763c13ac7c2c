"""Runs the stages on one source file and keeps their products.

    source ─ ast ─ model ─ analysis ─ ir ─┬─ module
                                          └─ xml

Each product is computed on first access, from the one before it. A product is `None` when
the source has errors that prevent it; the sink has them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from osc2tx.compilation import stages
from osc2tx.compilation.file_reports import LossEntry, apply_suppressions
from osc2tx.compilation.imports import ImportLoader, Lookup, leads_outside, look_up
from osc2tx.compilation.inputs import is_unicode
from osc2tx.compilation.map_files import report_missing_maps
from osc2tx.compilation.products import (
    Output,
    entries_of,
    files_of_module,
    files_of_xml,
    loss_of,
    report_losses,
)
from osc2tx.compilation.roots import Roots
from osc2tx.compilation.siblings import find_siblings
from osc2tx.diagnostics import Diagnostic, DiagnosticSink, SourceFile, Span
from osc2tx.diagnostics.report import ScenarioEntry
from osc2tx.options import CompileOptions
from osc2tx.support.paths import real_path
from osc2tx.support.recursion import allowing_deep_trees
from osc2tx.syntax import parse, read_source

if TYPE_CHECKING:
    from osc2tx.analysis import Analysis, ScenarioLevel
    from osc2tx.backends.py_trees.emitter import GeneratedModule
    from osc2tx.backends.py_trees.sharing import Declarations, Sharing
    from osc2tx.backends.xosc.emitter import XmlScenario
    from osc2tx.ir import Module
    from osc2tx.semantics import SemanticModel
    from osc2tx.support.records import Records
    from osc2tx.syntax.ast import File


__all__ = ["Compilation", "Memory", "Output"]

NO_ROOTS = Roots()
NO_TEXTS: Mapping[Path, str] = {}

Memory: TypeAlias = "dict[tuple[object, ...], Compilation]"
"""Compilations of imported files for themselves, by place, name and settings."""


class Compilation:
    """The compilation of one file.

    Attributes:
        path: The file.
        name: Its name in diagnostics and generated files; relative, forward slashes.
        options: Its options.
        sink: The diagnostics so far.
        lookups: The paths searched for imported files, with their contents.
        depends_on_packages: Reports depend on the packages with actions that are installed.
        is_complete: Whether all stages that can report something ran and found no error.
        compiled_alone: Imported files that were compiled for themselves, by name.
    """

    def __init__(
        self,
        path: Path,
        name: str,
        options: CompileOptions,
        *,
        roots: Roots = NO_ROOTS,
        is_trusted: bool = True,
        text: str | None = None,
        options_of: Callable[[Path], CompileOptions] | None = None,
        memory: Memory | None = None,
        unsaved: Mapping[Path, str] = NO_TEXTS,
        findings: Records | None = None,
    ) -> None:
        """Take the file; nothing is read yet.

        Args:
            path: The file.
            name: Its name in diagnostics.
            options: Its options.
            roots: Folders whose files it may import, besides its own folder, and to which
                names are relative.
            is_trusted: Whether this very file was named; otherwise it is not read if it is a
                link to somewhere outside of the folders.
            text: The text, for a file that does not exist on disk.
            options_of: Returns the options of other files; by default those of this one.
            memory: Separately compiled imported files, shared by several files.
            unsaved: Texts that replace files, by path with links followed.
            findings: Findings of earlier builds about documents.
        """
        self.path = path
        self.name = name
        self.options = options
        self.sink = DiagnosticSink()
        self.lookups: dict[Path, Lookup] = {}
        self.depends_on_packages = False
        self.is_complete = False
        self._roots = roots
        self._options_of = options_of or (lambda _: options)
        self._memory: Memory = {} if memory is None else memory
        self._unsaved = unsaved
        self._findings = findings
        self.compiled_alone: dict[str, Compilation] = {}
        self._is_trusted = is_trusted
        self._text = text
        self._is_well_formed = False

    @cached_property
    def source(self) -> SourceFile | None:
        """The text."""
        if self._text is not None:
            return SourceFile(self.name, self._text, self.path)
        if not self._is_trusted and leads_outside(self.path, (self.path.parent, *self._roots)):
            message = f"cannot read `{self.name}`: it is a link to a file outside of the folder"
            self.sink.report("OSC101", None, message, help="name the file itself to compile it")
            return None
        if not is_unicode(str(self.path)):
            message = f"cannot read `{self.name}`: the name of the file or a folder is not UTF-8"
            self.sink.report("OSC101", None, message, help="rename it")
            return None
        return read_source(self.path, self.name, self.sink)

    @cached_property
    def ast(self) -> File | None:
        """The syntax tree of the valid parts."""
        if self.source is None:
            return None
        parsed = parse(self.source, self.sink, allow=self._relaxed)
        self._is_well_formed = not self._failed()
        return parsed

    @cached_property
    def formatted(self) -> str | None:
        """The text in the style of the standard (§9.2.2); not made if it has syntax errors."""
        if self.ast is None or self.source is None or not self._is_well_formed:
            return None
        from osc2tx.formatter import format_source

        return format_source(self.source)

    @cached_property
    def model(self) -> SemanticModel | None:
        """The checked program; not made for a text with syntax errors, as they breed others."""
        return None if self.ast is None or self._failed() else self._program(self.ast, self.sink)

    @cached_property
    def recovered_model(self) -> SemanticModel | None:
        """The program without unparsable parts; its errors are not reported."""
        return None if self.ast is None else self.model or self._program(self.ast, DiagnosticSink())

    def _program(self, file: File, sink: DiagnosticSink) -> SemanticModel:
        folders = tuple(map(Path, self.options.import_paths))
        loader = ImportLoader(
            self.path, self.name, self._roots, sink, self._relaxed, folders, self._unsaved
        )
        self.lookups = loader.lookups
        return stages.build_model(file, self.options, loader, sink)

    @cached_property
    def analysis(self) -> Analysis | None:
        """The values that constraints allow, and the levels of the scenarios."""
        if self.model is None or self._failed():
            return None
        return stages.analyse_constraints(self.model, self.options, self.sink)

    @property
    def levels(self) -> Sequence[ScenarioLevel]:
        """The level of each scenario; nothing if the constraints have no solution."""
        if "analysis" not in self.__dict__ or self.analysis is None:
            return ()  # the analysis was not requested
        return () if self._failed() else self.analysis.levels

    @cached_property
    def ir(self) -> Module | None:
        """The program in the IR, verified; an `ir.Module` without scenarios for a library."""
        if self.model is None or self.analysis is None or self._failed():
            return None
        return stages.lower_and_verify(self.model, self.analysis, self.options, self.sink)

    @cached_property
    def keeps_rules(self) -> bool:
        """Whether all calls keep the rules of the library; reports those that do not."""
        if self.ir is None:
            return False
        return stages.check_library_rules(self.ir, self.sink)

    @cached_property
    def is_supported(self) -> bool:
        """Whether the backend supports all of it; reports unsupported constructs."""
        if self.ir is None:
            return False
        keeps_rules = self.keeps_rules
        if self.options.target != "xosc":
            from osc2tx.backends.py_trees.support import check_support

            with allowing_deep_trees():
                check_support(self.ir, self.sink)
        self._report_missing_maps(self.ir)
        self.is_complete = keeps_rules and not self._failed()
        if self.options.target == "xosc":
            report_losses(self.xml, self.sink)
        return not self._failed()

    @property
    def has_module(self) -> bool:
        """Whether there is a Python module, which is not rendered for the answer."""
        if self.ir is None or self.options.target == "xosc":
            return False
        from osc2tx.backends.py_trees.own_names import has_module

        return self.is_supported and has_module(self.ir)

    @cached_property
    def sharing(self) -> Sharing:
        """The parts of the module that come from the modules of imported files."""
        from osc2tx.backends.py_trees.sharing import share

        assert self.ir is not None, "there is a module"
        with allowing_deep_trees():
            siblings = find_siblings(self.ir, self, self.alone, self._is_source)
            return share(self.declared, *siblings)

    @cached_property
    def declared(self) -> Declarations:
        """The declarations of the program, for the modules that may share it."""
        from osc2tx.backends.py_trees.sharing import Declarations

        assert self.ir is not None, "there is a module"
        return Declarations(self.ir)

    @cached_property
    def module(self) -> GeneratedModule | None:
        """The Python module; `None` also for a file that declares neither scenarios nor types."""
        return self._module(is_formatted=True)

    @cached_property
    def draft(self) -> GeneratedModule | None:
        """The same module to be executed and not read: in no style, which takes half the time."""
        return self._module(is_formatted=False)

    def _module(self, *, is_formatted: bool) -> GeneratedModule | None:
        if not self.has_module or self.ir is None:
            return None
        from osc2tx.backends.py_trees import emit

        with allowing_deep_trees():
            return emit(self.ir, self.sharing, is_formatted=is_formatted)

    def alone(self, imported: SourceFile) -> Compilation:
        """Return the compilation of an imported file for itself, as a build compiles it."""
        if imported.name not in self.compiled_alone:
            assert imported.path is not None, "it was read from a file"
            options = self._options_of(imported.path)
            key = (imported.path, imported.name, repr(options), self._roots)
            made = self._memory.get(key)
            if made is None or not made.is_of(imported, self.lookups):
                made = Compilation(
                    imported.path,
                    imported.name,
                    options,
                    roots=self._roots,
                    options_of=self._options_of,
                    memory=self._memory,
                    text=self._unsaved.get(imported.path),
                    unsaved=self._unsaved,
                )
                self._memory[key] = made
            self.compiled_alone[imported.name] = made
        return self.compiled_alone[imported.name]

    def _is_source(self, name: str) -> bool:
        """Whether a folder of the project or of libraries has a file of this name."""
        own = Path(self.path.parent, *[".."] * self.name.count("/"))
        places = [Path(root, name) for root in (own, *self._roots, *self.options.import_paths)]
        self.lookups |= {each: look_up(each) for each in places if each not in self.lookups}
        return any(self.lookups[place].text is not None for place in places)

    def is_of(self, source: SourceFile, lookups: Mapping[Path, Lookup]) -> bool:
        """Whether a text, with the present imports, is the compiled one."""
        if self.source is None or self.source.text != source.text:
            return False
        return all(
            (lookups.get(asked) or look_up(asked)) == found for asked, found in self.lookups.items()
        )

    @cached_property
    def files(self) -> frozenset[Path]:
        """The files of the program, links followed."""
        if self.model is None:
            return frozenset()
        paths = (file.span.source.path for file in self.model.files)
        return frozenset(real_path(path) for path in paths if path is not None)

    @cached_property
    def xml(self) -> tuple[XmlScenario, ...]:
        """The scenarios of the file as OpenSCENARIO XML, each with its result.

        Empty for a library, if there are errors, and if only modules are requested.
        """
        if self.ir is None or not self.ir.scenarios or self.options.target == "py":
            return ()
        if not self.keeps_rules:  # no document means what breaks them
            return ()
        from osc2tx.backends.xosc import emit

        with allowing_deep_trees():
            found = emit(self.ir, self.options.xml, self.path.parent, self.stem)
        for scenario in found:
            for place in scenario.map_places:
                self.lookups[place] = look_up(place)
        return found

    @cached_property
    def graded_xml(self) -> tuple[XmlScenario, ...]:
        """The same with measured grades, as builds write them, if this is requested."""
        if self.ir is None:
            return self.xml
        from osc2tx.grading import Source, graded, unplayed

        with allowing_deep_trees():
            folder, module = self.path.parent, self.whole_module
            source = Source(self.ir, self.options, folder, module, self._findings)
            grade = graded if self.options.xml.verify else unplayed
            return grade(self.xml, source, self.sink)

    def whole_module(self) -> GeneratedModule:
        """Return a module to run, with the declarations of imported files in it.

        Its classes inherit nothing, so that its text is what is run, and nothing else of the bases.
        """
        from osc2tx.backends.py_trees import emit
        from osc2tx.ir import without_bases

        assert self.ir is not None, "there is something to run"
        is_whole = not self.ir.bases and not any(each.base for each in self.ir.scenarios)
        if is_whole and self.has_module and not self.sharing.homes:
            return self.module or emit(self.ir, is_formatted=False)
        return emit(without_bases(self.ir), is_formatted=False)

    @property
    def stem(self) -> str:
        """The common prefix of the names of all outputs."""
        if self.ir is None:
            return ""
        from osc2tx.backends.py_trees.naming import module_name

        return module_name(self.ir.source)

    def outputs(self) -> Sequence[Output]:
        """Return the files that the source makes; none if it declares nothing or has errors."""
        return (*self.module_outputs(), *self.xml_outputs())

    def module_outputs(self) -> tuple[Output, ...]:
        """Return the Python module and its source map, if it makes one."""
        return () if self.module is None else files_of_module(self.module)

    def xml_outputs(self) -> tuple[Output, ...]:
        """Return the OpenSCENARIO XML files.

        A scenario that XML cannot express makes only the report that states why.
        """
        if not self.is_supported and self.options.target != "xosc":  # which also reports losses
            return ()
        return files_of_xml(self.graded_xml)

    @property
    def losses(self) -> tuple[LossEntry, ...]:
        """The XML results of the scenarios, as far as they are requested."""
        return tuple(map(loss_of, self.graded_xml))

    def _report_missing_maps(self, module: Module) -> None:
        """Report missing maps, and record the searched paths."""
        folders = [self.path.parent, *map(Path, self.options.xml.map_path)]
        for place in report_missing_maps(module, folders, self.sink):
            self.lookups[place] = look_up(place)

    @property
    def start(self) -> Span:
        """The span of findings about the whole file, even if there is no text."""
        return Span(self.source or SourceFile(self.name, "", self.path), 0, 0)

    @property
    def reports(self) -> tuple[Diagnostic, ...]:
        """All that was reported, suppressed or not."""
        return self.sink.sorted()

    @property
    def scenarios(self) -> tuple[ScenarioEntry, ...]:
        """The levels as plain data, for reports."""
        if not self.levels or self.model is None or self.analysis is None:
            return ()
        lowered = self.__dict__.get("ir")
        return entries_of(self.levels, self.model, self.analysis, lowered)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All that was reported and no comment suppresses, in order of place."""
        return apply_suppressions([self]).shown

    def check(self) -> bool:
        """Run all stages that can report something; return whether there is no error."""
        with (
            allowing_deep_trees()
        ):  # around all: no collection of garbage between the stages either
            return self.is_supported

    def _failed(self) -> bool:
        return self.sink.has_errors

    @cached_property
    def _relaxed(self) -> frozenset[str]:
        from osc2tx.semantics.dialects import DIALECTS

        return DIALECTS[self.options.dialect].relaxed
