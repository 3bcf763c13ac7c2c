"""Descriptions of names and literals in Markdown: declaration, comments, values in SI units."""

from __future__ import annotations

import re

from lsprotocol import types as lsp

from osc2tx.diagnostics import Span
from osc2tx.language_server.documents import Document
from osc2tx.language_server.positions import offset_of, range_of
from osc2tx.reference import as_markdown, find, find_topics, topic_as_markdown
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.conversions import dimension_of
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    BehaviorSymbol,
    EnumMemberSymbol,
    EnumSymbol,
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    PhysicalTypeSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
    UnitSymbol,
)
from osc2tx.syntax import ast

_KINDS: tuple[tuple[type[Symbol], str], ...] = (
    (ActorSymbol, "actor"),
    (StructSymbol, "struct"),
    (ScenarioSymbol, "scenario"),
    (ActionSymbol, "action"),
    (ModifierSymbol, "modifier"),
    (EnumSymbol, "enum"),
    (PhysicalTypeSymbol, "type"),
)


def hover(document: Document, position: lsp.Position) -> lsp.Hover | None:
    """Return the description of the name or literal at a position."""
    offset = offset_of(document.source, position)
    found = document.occurrence_at(offset)
    if found is not None:
        text = describe(found.symbol, document.model)
        return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text), range_of(found.span))
    return _hover_literal(document, offset) or _hover_word(document, offset)


def _hover_word(document: Document, offset: int) -> lsp.Hover | None:
    """Return the description of a word of the language."""
    for found in re.finditer(r"[A-Za-z_]\w*", document.source.line_text(_line(document, offset))):
        start = document.source.line_starts[_line(document, offset) - 1] + found.start()
        if start <= offset <= start + len(found[0]):
            topics = [topic for topic in find_topics(found[0]) if topic.is_of_language]
            text = "\n\n".join(map(topic_as_markdown, topics))
            span = Span(document.source, start, start + len(found[0]))
            content = lsp.MarkupContent(lsp.MarkupKind.Markdown, text)
            return lsp.Hover(content, range_of(span)) if topics else None
    return None


def _line(document: Document, offset: int) -> int:
    return document.source.position(offset)[0]


def _hover_literal(document: Document, offset: int) -> lsp.Hover | None:
    model = document.model
    for literal in model.units if model is not None else ():
        span = literal.span
        if span.source is document.source and span.start <= offset <= span.end:
            text = f"```osc\n{span.text}\n```\n{si_value(literal, model)}"
            return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text), range_of(span))
    return None


def si_value(literal: ast.PhysicalLiteral, model: SemanticModel | None) -> str:
    """Return the value of a quantity in SI units, `13.89 m/s`."""
    unit = None if model is None else model.units.get(literal)
    if unit is None:
        return literal.span.text
    value = literal.value * unit.factor + unit.offset
    return f"{value:.6g} {dimension_of(unit.type)}"


def describe(symbol: Symbol, model: SemanticModel | None) -> str:
    """Return the description of a symbol as Markdown."""
    if symbol.origin == "library":
        for kind, name in _library_keys(symbol):
            entries = find(f"{kind} {name}")
            if entries:
                return as_markdown(entries[0]).split("\n", 2)[2].lstrip()
        if topics := find_topics(_topic_name(symbol)):
            return topic_as_markdown(topics[0])
    parts = [f"```osc\n{declaration(symbol)}\n```"]
    comments = _comments(symbol)
    if comments:
        parts.append(comments)
    owner = getattr(symbol, "owner", None)
    if owner is not None:
        parts.append(f"member of `{getattr(owner, 'qualified_name', owner.name)}`")
    return "\n\n".join(parts)


def _library_keys(symbol: Symbol) -> list[tuple[str, str]]:
    kind = next((word for class_, word in _KINDS if isinstance(symbol, class_)), "")
    names = [symbol.name]
    if isinstance(symbol, BehaviorSymbol):
        names.insert(0, symbol.qualified_name)
    return [(kind, name) for name in names if kind]


def _topic_name(symbol: Symbol) -> str:
    """Return how the reference calls a member of the library, or a unit."""
    if isinstance(symbol, UnitSymbol):
        return f"unit {symbol.name}"
    owner = symbol.enum if isinstance(symbol, EnumMemberSymbol) else getattr(symbol, "owner", None)
    name = getattr(owner, "qualified_name", getattr(owner, "name", ""))
    return f"{name}.{symbol.name}"


def declaration(symbol: Symbol) -> str:
    """Return how a symbol is declared, in one line."""
    match symbol:
        case FieldSymbol():
            return f"{'var ' if symbol.is_variable else ''}{symbol.name}: {symbol.type}"
        case ParameterSymbol():
            return f"{symbol.name}: {symbol.type}"
        case MethodSymbol():
            parameters = ", ".join(f"{each.name}: {each.type}" for each in symbol.parameters)
            return f"def {symbol.name}({parameters}) -> {symbol.result}"
        case EventSymbol():
            parameters = ", ".join(f"{each.name}: {each.type}" for each in symbol.parameters)
            return f"event {symbol.name}({parameters})" if parameters else f"event {symbol.name}"
        case EnumMemberSymbol():
            return f"{symbol.enum.name}!{symbol.name}"
        case LabelSymbol():
            return f"{symbol.name}: …"
        case UnitSymbol():
            return f"unit {symbol.name} of {symbol.type}"
        case EnumSymbol():
            return f"enum {symbol.name}: [{', '.join(symbol.members)}]"
    kind = next((word for class_, word in _KINDS if isinstance(symbol, class_)), "type")
    name = symbol.qualified_name if isinstance(symbol, BehaviorSymbol) else symbol.name
    base = getattr(symbol, "base", None)
    return f"{kind} {name} inherits {base.name}" if base is not None else f"{kind} {name}"


def _comments(symbol: Symbol) -> str:
    node = getattr(symbol, "node", None)
    lines = [line for line in getattr(node, "comments", ()) if not line.startswith("!")]
    trailing = getattr(node, "trailing_comment", None)
    if trailing and not trailing.startswith("!"):
        lines.append(trailing)
    return "\n".join(lines)
