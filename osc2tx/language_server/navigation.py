"""Definitions, references, renaming, outline and folding."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from lsprotocol import types as lsp

from osc2tx import stdlib
from osc2tx.language_server.documents import Document, Occurrence
from osc2tx.language_server.positions import offset_of, range_of
from osc2tx.semantics.symbols import Symbol
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax.patterns import identifier_end

LIBRARY = Path(stdlib.__file__).parent


class CannotRename(Exception):
    """Why a name cannot be changed."""


def definition(document: Document, position: lsp.Position) -> lsp.Location | None:
    """Return where the name at a position is declared, also within the library."""
    found = document.occurrence_at(offset_of(document.source, position))
    if found is None:
        return None
    span, path = found.symbol.span, path_of(found.symbol)
    if span.source is document.source:
        return lsp.Location(document.uri, range_of(span))
    return None if path is None else lsp.Location(path.as_uri(), range_of(span))


def path_of(symbol: Symbol) -> Path | None:
    """Return the file of a declaration; its text is that of the library for what that declares."""
    source = symbol.span.source
    if source.path is not None:
        return source.path
    return LIBRARY / source.name.removeprefix("<library>/") if "<library>" in source.name else None


def is_same(one: Symbol, other: Symbol) -> bool:
    """Whether two symbols, perhaps of different compilations, have the same declaration."""
    return one is other or (
        one.name == other.name
        and path_of(one) == path_of(other)
        and (one.span.start, one.span.end) == (other.span.start, other.span.end)
    )


def references(
    documents: Sequence[Document], symbol: Symbol, *, with_declaration: bool = True
) -> Iterator[tuple[Document, Occurrence]]:
    """Yield the names in some texts that denote a symbol."""
    for document in documents:
        for each in document.occurrences:
            if is_same(each.symbol, symbol) and (with_declaration or not each.is_declaration):
                yield document, each


def check_rename(symbol: Symbol, name: str, documents: Sequence[Document]) -> None:
    """Check that a symbol can be given another name.

    Args:
        symbol: The symbol.
        name: The new name.
        documents: The texts in which its present name occurs.

    Raises:
        CannotRename: If it is of the library, if the name is no identifier, or if a text has
            syntax errors that may use it: lines that cannot be parsed would keep the old name.
    """
    if symbol.origin != "user":
        raise CannotRename(f"`{symbol.name}` belongs to the standard library")
    if name in t.KEYWORDS:
        raise CannotRename(f"`{name}` is a reserved word")
    if not name or identifier_end(name, 0) != len(name):
        raise CannotRename(f"`{name}` is not a name: one begins with a letter or `_`")
    for each in documents:
        if not each.is_well_formed and each.may_use(symbol.span.source):
            raise CannotRename(f"correct the syntax errors of `{each.job.name}` first")


# --- Outline and folding --------------------------------------------------------------------

_KINDS: dict[type, lsp.SymbolKind] = {
    ast.ScenarioDeclaration: lsp.SymbolKind.Class,
    ast.ActionDeclaration: lsp.SymbolKind.Class,
    ast.ActorDeclaration: lsp.SymbolKind.Class,
    ast.ModifierDeclaration: lsp.SymbolKind.Class,
    ast.StructDeclaration: lsp.SymbolKind.Struct,
    ast.EnumDeclaration: lsp.SymbolKind.Enum,
    ast.EventDeclaration: lsp.SymbolKind.Event,
    ast.MethodDeclaration: lsp.SymbolKind.Method,
    ast.ParameterDeclaration: lsp.SymbolKind.Field,
    ast.VariableDeclaration: lsp.SymbolKind.Variable,
}


def outline(document: Document) -> list[lsp.DocumentSymbol]:
    """Return the declarations of a text, and the labelled phases of its scenarios."""
    file = document.compilation.ast
    return [] if file is None else list(_symbols(file.statements))


def _symbols(statements: Sequence[object]) -> Iterator[lsp.DocumentSymbol]:
    for each in statements:
        match each:
            case ast.DoDirective(member=member):
                yield from _symbols([member])
            case ast.Composition() | ast.Invocation() | ast.WaitDirective():
                children = list(_symbols(getattr(each, "members", ())))
                if each.label is None:
                    yield from children
                else:
                    yield _symbol(each.label, each, lsp.SymbolKind.Function, children)
            case ast.ParameterDeclaration() | ast.VariableDeclaration():
                for name in each.names:
                    yield _symbol(name, each, _KINDS[type(each)], [])
            case ast.Statement() if type(each) in _KINDS:
                children = list(_symbols(getattr(each, "members", ())))
                yield _symbol(each.name, each, _KINDS[type(each)], children)  # type: ignore[attr-defined]


def _symbol(
    name: ast.Name | ast.BehaviorName,
    node: ast.Node,
    kind: lsp.SymbolKind,
    children: list[lsp.DocumentSymbol],
) -> lsp.DocumentSymbol:
    return lsp.DocumentSymbol(
        str(name), kind, range_of(node.span.to(node.span)), range_of(name.span), children=children
    )


def foldings(document: Document) -> list[lsp.FoldingRange]:
    """Return the blocks of a text; a block begins at the line above its indentation."""
    table, source = document.tokens, document.source
    opened: list[int] = []
    found = []
    for index, kind in enumerate(table.types):
        if kind == t.INDENT:
            opened.append(source.position(table.ends[index - 2])[0] - 1)
        elif kind == t.DEDENT and opened:
            first = opened.pop()
            last = source.position(table.ends[_last_word(table.types, index)])[0] - 1
            if last > first:
                found.append(lsp.FoldingRange(first, last))
    return sorted(found, key=lambda each: (each.start_line, each.end_line))


def _last_word(types: Sequence[int], index: int) -> int:
    while index > 0 and types[index] in (t.NEWLINE, t.INDENT, t.DEDENT, t.EOF):
        index -= 1
    return index
