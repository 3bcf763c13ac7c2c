"""Runs the stages on one source file and keeps what they make.

    source ─ ast ─ model ─ analysis ─ ir ─ module

Each product is made when it is first asked for, from the one before it. A product is `None` when
the source has errors that stand in the way; the sink says which.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

from osc2tx.diagnostics import Diagnostic, DiagnosticSink, SourceFile, Span
from osc2tx.diagnostics.suppressions import Settled, settle
from osc2tx.imports import ImportLoader
from osc2tx.options import CompileOptions, ProductName
from osc2tx.stack import room_for_trees
from osc2tx.syntax import dump_ast, parse, read_source
from osc2tx.syntax.suppressions import find_suppressions

if TYPE_CHECKING:
    from pathlib import Path

    from osc2tx.analysis import Analysis, ScenarioLevel
    from osc2tx.backends.py_trees.emitter import GeneratedModule
    from osc2tx.ir import Module
    from osc2tx.semantics import SemanticModel
    from osc2tx.syntax.ast import File


class Compilation:
    """The compilation of one file.

    Attributes:
        path: The file.
        name: How diagnostics and generated files call it; relative, forward slashes.
        options: How to compile it.
        sink: What the stages had to say so far.
        is_complete: Whether all stages that can report something ran and found no error.
    """

    def __init__(
        self, path: Path, name: str, options: CompileOptions, *, roots: Sequence[Path] = ()
    ) -> None:
        """Take the file; nothing is read yet.

        Args:
            path: The file.
            name: What to call it.
            options: How to compile it.
            roots: Folders whose files it may import, besides its own folder.
        """
        self.path = path
        self.name = name
        self.options = options
        self.sink = DiagnosticSink()
        self.is_complete = False
        self._roots = (path.parent, *roots)

    @cached_property
    def source(self) -> SourceFile | None:
        """The text."""
        return read_source(self.path, self.name, self.sink)

    @cached_property
    def ast(self) -> File | None:
        """The syntax tree of what could be understood."""
        if self.source is None:
            return None
        return parse(self.source, self.sink, allow=self._relaxed)

    @cached_property
    def model(self) -> SemanticModel | None:
        """The checked program; not made for a text with syntax errors, as they breed others."""
        if self.ast is None or self._failed():
            return None
        from osc2tx.semantics import DIALECTS, ModelBuilder

        builder = ModelBuilder(
            self.sink,
            standard=self.options.standard,
            dialect=DIALECTS[self.options.dialect],
            load=ImportLoader(self.path, self.name, self._roots, self.sink, self._relaxed),
        )
        with room_for_trees():
            return builder.build(self.ast)

    @cached_property
    def analysis(self) -> Analysis | None:
        """What constraints allow, and how far the scenarios are worked out."""
        if self.model is None or self._failed():
            return None
        from osc2tx.analysis import analyse

        with room_for_trees():
            return analyse(self.model, self.sink)

    @property
    def levels(self) -> Sequence[ScenarioLevel]:
        """How far each scenario is worked out; nothing if the constraints have no solution."""
        if "analysis" not in self.__dict__ or self.analysis is None:
            return ()  # nobody has asked for it
        return () if self._failed() else self.analysis.levels

    @cached_property
    def ir(self) -> Module | None:
        """What the scenarios mean, verified; an `ir.Module` without scenarios for a library."""
        if self.model is None or self.analysis is None or self._failed():
            return None
        from osc2tx.ir import verify
        from osc2tx.lowering import lower

        with room_for_trees():
            module = lower(self.model, self.options, self.sink)
            if self._failed():
                return None
            verify(module)
        return module

    @cached_property
    def is_supported(self) -> bool:
        """Whether the backend can write all of it down; what it cannot is reported."""
        if self.ir is None:
            return False
        from osc2tx.backends.py_trees.support import check_support

        check_support(self.ir, self.sink)
        self.is_complete = not self._failed()
        return self.is_complete

    @cached_property
    def module(self) -> GeneratedModule | None:
        """The Python module; `None` also for a file that declares no scenario."""
        if self.ir is None or not self.is_supported or not self.ir.scenarios:
            return None
        from osc2tx.backends.py_trees import emit

        with room_for_trees():
            return emit(self.ir)

    @property
    def is_readable(self) -> bool:
        """Whether there is a text at all."""
        return self.source is not None

    @property
    def start(self) -> Span:
        """The place of what concerns the file as a whole, even if there is no text."""
        return Span(self.source or SourceFile(self.name, "", self.path), 0, 0)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All that was reported and no comment suppresses, in order of place."""
        return settle_all([self]).shown

    def check(self) -> bool:
        """Run all stages that can report something; return whether there is no error."""
        return self.is_supported

    def dump(self, product: ProductName) -> str | None:
        """Return a product as text; `None` where it does not exist."""
        return _DUMPS[product](self)

    def _failed(self) -> bool:
        return self.sink.has_errors

    @cached_property
    def _relaxed(self) -> frozenset[str]:
        from osc2tx.semantics.dialects import DIALECTS

        return DIALECTS[self.options.dialect].relaxed


def _dump_ast(compilation: Compilation) -> str | None:
    return None if compilation.ast is None else dump_ast(compilation.ast)


def _dump_model(compilation: Compilation) -> str | None:
    from osc2tx.semantics import dump_model

    return None if compilation.model is None else dump_model(compilation.model)


def _dump_ir(compilation: Compilation) -> str | None:
    from osc2tx.ir import dump_ir

    return None if compilation.ir is None else dump_ir(compilation.ir)


def _dump_module(compilation: Compilation) -> str | None:
    return None if compilation.module is None else compilation.module.python


_DUMPS: Mapping[ProductName, Callable[[Compilation], str | None]] = {
    "ast": _dump_ast,
    "model": _dump_model,
    "ir": _dump_ir,
    "py": _dump_module,
}


def settle_all(compilations: Sequence[Compilation]) -> Settled:
    """Return what was reported on several files, each report once, and what comments suppress.

    A report in a file that several others import counts once; a suppression there is used if it
    is of use to one of them.
    """
    found: dict[tuple[object, ...], Diagnostic] = {}
    for compilation in compilations:
        for reported in compilation.sink.sorted():
            span = reported.primary or compilation.start
            diagnostic = replace(reported, primary=span)
            place = (span.source.identity, span.start, span.end)
            found.setdefault((diagnostic.code, diagnostic.message, *place), diagnostic)
    judged = {
        compilation.source: compilation.is_complete
        for compilation in compilations
        if compilation.source is not None
    }
    return settle(found.values(), judged, find_suppressions)
