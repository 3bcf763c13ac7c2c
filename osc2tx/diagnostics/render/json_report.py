"""Diagnostics as JSON; `docs/diagnostics.schema.json` describes the form.

Lines and columns count from 1, columns in characters, as in the text for people. The end of a
place is the position behind its last character.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from osc2tx.diagnostics.codes import CODES
from osc2tx.diagnostics.fixes import Fix
from osc2tx.diagnostics.model import Diagnostic
from osc2tx.diagnostics.report import FileFault, Report, display_name
from osc2tx.diagnostics.source import Span
from osc2tx_shared.text import in_json

SCHEMA_VERSION = 1


def render_json(report: Report, *, version: str) -> str:
    """Return the report as a JSON document.

    Args:
        report: The report.
        version: The version of osc2tx.
    """
    document: dict[str, Any] = {
        "version": SCHEMA_VERSION,
        "tool": {"name": "osc2tx", "version": version},
        "diagnostics": [_diagnostic(item, report.folder) for item in report.diagnostics],
        "hidden": [{"file": file, "count": count} for file, count in report.hidden.items()],
        "scenarios": [
            {
                "file": display_name(entry.source, report.folder),
                "name": entry.name,
                "level": entry.level,
                "open": list(entry.open),
                "runnable": entry.is_runnable,
                "values": dict(entry.values),
            }
            for entry in report.scenarios
        ],
        "summary": {
            "files": report.files,
            "errors": report.errors,
            "warnings": report.warnings,
            "suppressed": report.suppressed,
        },
    }
    if report.faults:
        document["files"] = [_fault(fault) for fault in report.faults]
    if report.failure is not None:
        document["failure"] = report.failure
    return in_json(json.dumps(document, indent=2)) + "\n"


def _fault(fault: FileFault) -> dict[str, str]:
    found = {"file": fault.file, "rule": fault.rule, "message": fault.message}
    return found if fault.diff is None else {**found, "diff": fault.diff}


def _diagnostic(diagnostic: Diagnostic, folder: Path | None) -> dict[str, Any]:
    entry = CODES[diagnostic.code]
    return {
        "code": entry.code,
        "slug": entry.slug,
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        "section": entry.section or None,
        "location": _location(diagnostic.primary, folder) if diagnostic.primary else None,
        "related": [
            {"message": label.message, "location": _location(label.span, folder)}
            for label in diagnostic.labels
        ],
        "notes": list(diagnostic.notes),
        "help": diagnostic.help,
        "fixes": [_fix(fix, folder) for fix in diagnostic.fixes],
    }


def _fix(fix: Fix, folder: Path | None) -> dict[str, Any]:
    edits = [{"location": _location(edit.span, folder), "text": edit.text} for edit in fix.edits]
    return {
        "title": fix.title,
        "applicability": "safe" if fix.is_safe else "unsafe",
        "edits": edits,
    }


def _location(span: Span, folder: Path | None) -> dict[str, Any]:
    return {
        "file": display_name(span.source, folder),
        "start": _position(span, span.start),
        "end": _position(span, span.end),
    }


def _position(span: Span, offset: int) -> dict[str, int]:
    line, column = span.source.position(offset)
    return {"line": line, "column": column}
