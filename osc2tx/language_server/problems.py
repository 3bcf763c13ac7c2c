"""Diagnostics, and the code actions that fix them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from lsprotocol import types as lsp

from osc2tx.diagnostics import CODES, Diagnostic, Severity, SourceFile, Span
from osc2tx.diagnostics.fixes import Fix, compatible
from osc2tx.language_server.documents import Document
from osc2tx.language_server.positions import offset_of, range_of

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
}
FIX_ALL = "source.fixAll.osc2tx"


def problems(document: Document) -> list[lsp.Diagnostic]:
    """Return the diagnostics of a text; those of imported files belong to these."""
    return [
        _problem(document, found) for found in document.diagnostics if _is_shown(document, found)
    ]


def _is_shown(document: Document, found: Diagnostic) -> bool:
    return found.primary is None or found.primary.source is document.source


def _problem(document: Document, found: Diagnostic) -> lsp.Diagnostic:
    span = found.primary or Span(document.source, 0, 0)
    return lsp.Diagnostic(
        range=range_of(span),
        severity=_SEVERITIES[found.severity],
        code=found.code,
        source="osc2tx",
        message="\n".join(found.lines),
        tags=(
            [lsp.DiagnosticTag.Unnecessary] if CODES[found.code].slug.startswith("unused") else None
        ),
        related_information=[
            lsp.DiagnosticRelatedInformation(
                lsp.Location(label.span.source.path.as_uri(), range_of(label.span)), label.message
            )
            for label in found.labels
            if label.span.source.path is not None
        ],
    )


def actions(
    document: Document, uri: str, asked: lsp.Range, only: Sequence[str] | None
) -> list[lsp.CodeAction]:
    """Return the fixes at a place, and the one that applies all safe ones."""
    start = offset_of(document.source, asked.start)
    end = offset_of(document.source, asked.end)
    found = list(_quick_fixes(document, uri, start, end))
    safe = [
        fix for diagnostic in document.diagnostics for fix in diagnostic.fixes[:1] if fix.is_safe
    ]
    together = compatible([fix for fix in safe if _is_within(document.source, fix)])
    if together:
        edit = _workspace_edit(uri, together)
        found.append(lsp.CodeAction("apply all safe fixes", kind=FIX_ALL, edit=edit))
    return [each for each in found if only is None or any(_is_kind(each, kind) for kind in only)]


def _is_kind(action: lsp.CodeAction, wanted: str) -> bool:
    kind = str(getattr(action.kind, "value", action.kind))
    return kind == wanted or kind.startswith(f"{wanted}.")


def _quick_fixes(document: Document, uri: str, start: int, end: int) -> Iterator[lsp.CodeAction]:
    for diagnostic in document.diagnostics:
        span = diagnostic.primary
        if span is None or span.source is not document.source:
            continue
        if span.start > end or span.end < start:
            continue
        for number, fix in enumerate(diagnostic.fixes):
            if _is_within(document.source, fix):
                yield lsp.CodeAction(
                    fix.title,
                    kind=lsp.CodeActionKind.QuickFix,
                    diagnostics=[_problem(document, diagnostic)],
                    is_preferred=fix.is_safe and number == 0,
                    edit=_workspace_edit(uri, [fix]),
                )


def _is_within(source: SourceFile, fix: Fix) -> bool:
    return all(edit.span.source is source for edit in fix.edits)


def _workspace_edit(uri: str, fixes: Sequence[Fix]) -> lsp.WorkspaceEdit:
    edits = [lsp.TextEdit(range_of(edit.span), edit.text) for fix in fixes for edit in fix.edits]
    changes: Mapping[str, Sequence[lsp.TextEdit]] = {uri: edits}
    return lsp.WorkspaceEdit(changes=changes)
