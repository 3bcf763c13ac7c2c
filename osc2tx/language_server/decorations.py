"""Semantic tokens, inlay hints and code lenses."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from osc2tx.language_server.descriptions import si_value
from osc2tx.language_server.documents import Document
from osc2tx.language_server.positions import offset_of, position_of, range_of
from osc2tx.semantics.symbols import (
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
    StructSymbol,
    Symbol,
)

# Kind of symbol -> kind of token of the protocol; the first that fits.
_TOKENS: tuple[tuple[type[Symbol], str], ...] = (
    (ActorSymbol, "class"),
    (StructSymbol, "struct"),
    (EnumSymbol, "enum"),
    (PhysicalTypeSymbol, "type"),
    (ModifierSymbol, "decorator"),
    (BehaviorSymbol, "function"),
    (EnumMemberSymbol, "enumMember"),
    (EventSymbol, "event"),
    (MethodSymbol, "method"),
    (ParameterSymbol, "parameter"),
    (FieldSymbol, "property"),
    (LabelSymbol, "variable"),
)
TOKEN_TYPES = [word for _, word in _TOKENS]
TOKEN_MODIFIERS = ["declaration", "defaultLibrary"]
LEGEND = lsp.SemanticTokensLegend(TOKEN_TYPES, TOKEN_MODIFIERS)
LENSES = (
    ("run", "osc2tx.run"),
    ("show module", "osc2tx.showModule"),
    ("show XML", "osc2tx.showXml"),
    ("show tree", "osc2tx.showTree"),
    ("show report", "osc2tx.showReport"),
)


def semantic_tokens(document: Document) -> lsp.SemanticTokens:
    """Return the names of a text with their kinds; keywords are left to the editor's grammar."""
    data: list[int] = []
    last = lsp.Position(0, 0)
    for each in document.occurrences:
        kind = next((word for class_, word in _TOKENS if isinstance(each.symbol, class_)), None)
        if kind is None or "\n" in each.span.text:
            continue
        place = position_of(document.source, each.span.start)
        end = position_of(document.source, each.span.end)
        lines = place.line - last.line
        columns = place.character - (last.character if lines == 0 else 0)
        modifiers = int(each.is_declaration) + 2 * (each.symbol.origin == "library")
        length = end.character - place.character
        data += [lines, columns, length, TOKEN_TYPES.index(kind), modifiers]
        last = place
    return lsp.SemanticTokens(data)


def inlay_hints(document: Document, asked: lsp.Range) -> list[lsp.InlayHint]:
    """Return values of quantities in SI units, names of arguments, and levels of scenarios."""
    start = offset_of(document.source, asked.start)
    end = offset_of(document.source, asked.end)
    hints = [
        *_quantities(document, start, end),
        *_parameters(document, start, end),
        *_levels(document, start, end),
    ]
    return sorted(hints, key=lambda hint: (hint.position.line, hint.position.character))


def _quantities(document: Document, start: int, end: int) -> Iterator[lsp.InlayHint]:
    model = document.model
    for literal, unit in {} if model is None else model.units.items():
        span = literal.span
        if span.source is not document.source or not start <= span.end <= end:
            continue
        if (unit.factor, unit.offset) != (1.0, 0.0):
            text = f"= {si_value(literal, model)}"
            yield lsp.InlayHint(
                position_of(document.source, span.end),
                text,
                kind=lsp.InlayHintKind.Type,
                padding_left=True,
            )


def _parameters(document: Document, start: int, end: int) -> Iterator[lsp.InlayHint]:
    model = document.model
    for node, binding in {} if model is None else model.bindings.items():
        if node.span.source is not document.source:
            continue
        named = {
            argument.value
            for argument in getattr(node, "arguments", ())
            if argument.name is not None
        }
        for parameter, value in binding.arguments:
            is_shown = value not in named and start <= value.span.start <= end
            if is_shown and len(binding.arguments) > 1:
                yield lsp.InlayHint(
                    position_of(document.source, value.span.start),
                    f"{parameter.name}:",
                    kind=lsp.InlayHintKind.Parameter,
                    padding_right=True,
                )


def _levels(document: Document, start: int, end: int) -> Iterator[lsp.InlayHint]:
    """Yield how far each scenario is worked out (§6.3), behind the name that it declares."""
    model = document.model
    levels = {each.name: each for each in document.compilation.scenarios}
    for scenario in () if model is None else model.scenarios:
        entry, span = levels.get(scenario.qualified_name), scenario.span
        if entry is None or span.source is not document.source or not start <= span.end <= end:
            continue
        yield lsp.InlayHint(
            position_of(document.source, span.end),
            entry.level,
            tooltip=entry.summary,
            padding_left=True,
        )


def lenses(document: Document, uri: str) -> list[lsp.CodeLens]:
    """Return the commands for each scenario, above its declaration."""
    model = document.model
    found = []
    for scenario in () if model is None else model.scenarios:
        if scenario.span.source is document.source:
            found += [
                lsp.CodeLens(
                    range_of(scenario.span),
                    lsp.Command(title, command, arguments=[uri, scenario.qualified_name]),
                )
                for title, command in LENSES
            ]
    return found
