"""Diagnostics as `rdjson`, from which reviewdog makes comments with suggested changes.

Columns count bytes of UTF-8 from 1, and the end of a range is the position behind it. A suggestion
has one range, so that a fix of several edits becomes the text from its first to its last edit.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from osc2tx.diagnostics.fixes import Edit, Fix, apply_edits
from osc2tx.diagnostics.model import Diagnostic
from osc2tx.diagnostics.render.sarif import page_of
from osc2tx.diagnostics.report import Report, display_name
from osc2tx.diagnostics.source import SourceFile, Span
from osc2tx_shared.text import in_json


def render_rdjson(report: Report, *, docs_url: str | None = None) -> str:
    """Return the report as a document of the Reviewdog Diagnostic Format.

    Args:
        report: The report.
        docs_url: Address of the documentation; each code links to its page there.
    """
    found = [_diagnostic(each, report.folder, docs_url) for each in report.diagnostics]
    found += [
        {
            "message": fault.message,
            "severity": "ERROR" if fault.is_error else "INFO",
            "code": {"value": fault.rule},
            "location": {"path": fault.file},
        }
        for fault in report.faults
    ]
    if report.failure is not None:
        found.append({"message": report.failure, "severity": "ERROR"})
    document = {"source": {"name": "osc2tx"}, "diagnostics": found}
    return in_json(json.dumps(document, indent=2)) + "\n"


def _diagnostic(
    diagnostic: Diagnostic, folder: Path | None, docs_url: str | None
) -> dict[str, Any]:
    page = {} if docs_url is None else {"url": page_of(diagnostic.code, docs_url)}
    result: dict[str, Any] = {
        "message": "\n".join(diagnostic.lines),
        "severity": diagnostic.severity.name,
        "code": {"value": diagnostic.code, **page},
    }
    if diagnostic.primary is not None:
        source = diagnostic.primary.source
        path = display_name(source, folder)
        result["location"] = {"path": path, "range": _range(diagnostic.primary)}
        result["suggestions"] = list(_suggestions(diagnostic, source))
    return result


def _suggestions(diagnostic: Diagnostic, source: SourceFile) -> Iterator[dict[str, Any]]:
    """Yield the fixes of the file of a diagnostic: a comment cannot change another file."""
    for fix in diagnostic.fixes:
        if all(edit.span.source is source for edit in fix.edits):
            edit = _as_one_edit(fix, source)
            yield {"range": _range(edit.span), "text": edit.text}


def _as_one_edit(fix: Fix, source: SourceFile) -> Edit:
    start = min(edit.span.start for edit in fix.edits)
    end = max(edit.span.end for edit in fix.edits)
    within = (
        Edit(Span(source, edit.span.start - start, edit.span.end - start), edit.text)
        for edit in fix.edits
    )
    return Edit(Span(source, start, end), apply_edits(source.text[start:end], within))


def _range(span: Span) -> dict[str, Any]:
    return {
        "start": _position(span.source, span.start),
        "end": _position(span.source, span.end),
    }


def _position(source: SourceFile, offset: int) -> dict[str, int]:
    line, column = source.position(offset)
    before = source.text[offset - column + 1 : offset]
    return {"line": line, "column": len(before.encode("utf-8", "replace")) + 1}
