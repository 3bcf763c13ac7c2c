"""A source text with its compilation."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from osc2tx.building.jobs import Job
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import Diagnostic, DiagnosticSink, SourceFile, Span
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.symbols import EnumSymbol, Symbol, TypeSymbol
from osc2tx.support.paths import real_path
from osc2tx.syntax import ast
from osc2tx.syntax.token_source import TokenSource
from osc2tx.syntax.tokens import TokenTable


class Occurrence(NamedTuple):
    """A name in a text, and its symbol.

    Attributes:
        span: The name.
        symbol: Its meaning.
        is_declaration: Whether the name is declared there.
    """

    span: Span
    symbol: Symbol
    is_declaration: bool = False


class Document:
    """One text of a file; an edit makes another document.

    Attributes:
        job: How to compile it.
        text: The text.
        uri: How the editor calls it.
    """

    def __init__(self, job: Job, text: str, uri: str, unsaved: Mapping[Path, str]) -> None:
        """Take the text; nothing is compiled yet.

        Args:
            job: How to compile it.
            text: The text.
            uri: How the editor calls it.
            unsaved: The texts of all open files, which it may import.
        """
        self.job = job
        self.text = text
        self.uri = uri
        self._unsaved = unsaved

    @cached_property
    def compilation(self) -> Compilation:
        """Its compilation, with all stages that can report something."""
        compilation = self.compilation_of(self.text)
        compilation.check()
        return compilation

    def compilation_of(self, text: str) -> Compilation:
        """Return the compilation of another text in its place; no stage has run yet."""
        return self.job.compilation(text=text, unsaved=self._unsaved)

    @cached_property
    def source(self) -> SourceFile:
        """The text as a source file."""
        return self.compilation.source or SourceFile(self.job.name, self.text, self.job.path)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """The diagnostics that no comment suppresses, in this file or about it."""
        return self.compilation.diagnostics

    @property
    def model(self) -> SemanticModel | None:
        """The program; of a text with syntax errors that of the valid parts."""
        return self.compilation.recovered_model

    @property
    def is_well_formed(self) -> bool:
        """Whether all of the text could be parsed, so that no name in it is unknown."""
        return self.compilation.model is not None

    def imports(self, path: Path) -> bool:
        """Whether it depends on a file, links followed: it imports the file, or searched it."""
        searched = {} if self.model is None else self.compilation.lookups
        return any(found.path == str(path) for found in searched.values())

    def may_use(self, source: SourceFile) -> bool:
        """Whether its names may denote declarations of a text: it is this text, or imports it."""
        return source.path is not None and (
            source.path == self.job.path or self.imports(real_path(source.path))
        )

    @cached_property
    def tokens(self) -> TokenTable:
        """The tokens, also of a text with errors."""
        return TokenSource(self.source, DiagnosticSink()).scan()

    @cached_property
    def occurrences(self) -> tuple[Occurrence, ...]:
        """The resolved names of this text, in order of position."""
        model = self.model
        if model is None:
            return ()
        found: dict[tuple[int, int], Occurrence] = {}
        for each in occurrences(model):
            if each.span.source is self.source:
                found.setdefault((each.span.start, each.span.end), each)
        return tuple(found[key] for key in sorted(found))

    def occurrence_at(self, offset: int) -> Occurrence | None:
        """Return the name at an offset, or right before it."""
        starts = [each.span.start for each in self.occurrences]
        index = bisect_right(starts, offset) - 1
        found = self.occurrences[index] if index >= 0 else None
        return found if found is not None and offset <= found.span.end else None


def occurrences(model: SemanticModel) -> Iterator[Occurrence]:
    """Yield the names of a program with their meanings, declarations first."""
    symbols = dict.fromkeys([*model.symbols, *model.references.values()])
    for symbol in list(symbols):
        if isinstance(symbol, TypeSymbol | EnumSymbol):
            symbols |= dict.fromkeys(symbol.members.values())
    for symbol in symbols:
        if symbol.origin == "user":
            yield Occurrence(symbol.span, symbol, is_declaration=True)
    for node, symbol in model.references.items():
        yield Occurrence(name_span(node), symbol)
    for node, binding in model.bindings.items():
        yield Occurrence(name_span(node), binding.callee)


def name_span(node: ast.Node) -> Span:
    """Return the span of the name by which a node refers to something."""
    match node:
        case ast.NameExpression(name=name) | ast.MemberAccess(name=name):
            return name.span
        case ast.EnumLiteral(member=name) | ast.Invocation(behavior=name):
            return name.span
        case ast.ModifierApplication(modifier=name) | ast.EmitDirective(event=name):
            return name.span
        case ast.Call(callee=callee) | ast.CallDirective(method=callee):
            return name_span(callee)
        case _:
            return node.span
