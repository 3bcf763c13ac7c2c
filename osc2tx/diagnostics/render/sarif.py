"""Diagnostics as SARIF 2.1.0, the format of code scanning.

Columns count UTF-16 code units from 1, as the log states. Warnings that a comment suppresses are
left out: GitHub would show them as open alerts in spite of their `suppressions`.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Iterator, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import quote

from osc2tx.diagnostics.codes import CODES, Code
from osc2tx.diagnostics.fixes import Fix
from osc2tx.diagnostics.model import Diagnostic
from osc2tx.diagnostics.render.explanation import code_block
from osc2tx.diagnostics.report import FileFault, Report, display_name
from osc2tx.diagnostics.source import SourceFile, Span
from osc2tx_shared.text import in_json, visible

FINGERPRINT = "osc2tx/v1"  # of the code, the file, the text of the line, and which one of those
SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)


def render_sarif(
    report: Report, *, version: str, failed: bool = False, docs_url: str | None = None
) -> str:
    """Return the report as a SARIF log with one run.

    Args:
        report: The report.
        version: The version of osc2tx.
        failed: Whether osc2tx itself failed on some file.
        docs_url: Address of the documentation; each rule links to its page there.
    """
    codes = sorted({diagnostic.code for diagnostic in report.diagnostics})
    driver: dict[str, Any] = {
        "name": "osc2tx",
        "version": version,
        "rules": [_rule(CODES[code], docs_url) for code in codes],
    }
    results = [
        {
            **_result(diagnostic, codes.index(diagnostic.code), report.folder),
            "partialFingerprints": {FINGERPRINT: fingerprint},
        }
        for diagnostic, fingerprint in zip(
            report.diagnostics, _fingerprints(report.diagnostics, report.folder), strict=True
        )
    ]
    rules = sorted({fault.rule for fault in report.faults})
    driver["rules"] = [*driver["rules"], *map(_file_rule, rules)]
    results += [_fault(fault, len(codes) + rules.index(fault.rule)) for fault in report.faults]
    invocation: dict[str, Any] = {"executionSuccessful": not failed}
    if report.failure is not None:
        notification = {"level": "error", "message": {"text": _escape(report.failure)}}
        invocation["toolExecutionNotifications"] = [notification]
    run = {
        "tool": {"driver": driver},
        "invocations": [invocation],
        "columnKind": "utf16CodeUnits",
        "results": results,
    }
    document = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    return in_json(json.dumps(document, indent=2)) + "\n"


def _file_rule(rule: str) -> dict[str, Any]:
    text = rule.replace("-", " ").capitalize() + "."
    return {"id": rule, "shortDescription": {"text": text}}


def _fault(fault: FileFault, index: int) -> dict[str, Any]:
    artifact = {"uri": quote(fault.file)}
    return {
        "ruleId": fault.rule,
        "ruleIndex": index,
        "level": "error" if fault.is_error else "note",
        "message": {"text": _escape(f"{fault.file}: {fault.message}")},
        "locations": [{"physicalLocation": {"artifactLocation": artifact}}],
        "partialFingerprints": {FINGERPRINT: sha256(repr(fault).encode()).hexdigest()[:32]},
    }


def _fingerprints(diagnostics: Sequence[Diagnostic], folder: Path | None) -> Iterator[str]:
    """Yield fingerprints of diagnostics, which do not change with other lines."""
    seen: Counter[tuple[str, ...]] = Counter()
    for diagnostic in diagnostics:
        span = diagnostic.primary
        place = () if span is None else (display_name(span.source, folder), _line_of(span))
        key = (diagnostic.code, *place)
        seen[key] += 1
        yield sha256("\0".join((*key, str(seen[key]))).encode("utf-8", "replace")).hexdigest()[:32]


def _line_of(span: Span) -> str:
    text = span.source.text
    start = text.rfind("\n", 0, span.start) + 1
    return text[start:].partition("\n")[0].strip()


def _rule(entry: Code, docs_url: str | None) -> dict[str, Any]:
    page = {} if docs_url is None else {"helpUri": page_of(entry.code, docs_url)}
    return {
        "id": entry.code,
        "name": "".join(part.capitalize() for part in entry.slug.split("-")),
        "shortDescription": {"text": _escape(entry.summary)},
        **page,
        "help": {"text": _escape(_help(entry)), "markdown": _markdown_help(entry)},
        "defaultConfiguration": {"level": entry.severity.value},
    }


def page_of(code: str, docs_url: str) -> str:
    """Return the address of the page of a code in a published documentation."""
    return f"{docs_url.rstrip('/')}/diagnostics/{code.lower()}.html"


def _help(entry: Code) -> str:
    parts = [entry.summary]
    if entry.section:
        parts.append(f"See OpenSCENARIO DSL 2.2, section {entry.section}.")
    if entry.explanation:
        parts.append(entry.explanation.remedy)
    return " ".join(parts)


def _markdown_help(entry: Code) -> str:
    text = _help(entry)
    explanation = entry.explanation
    if explanation:
        text += f"\n\nFaulty:\n\n{code_block(explanation.faulty)}"
        if explanation.fixed:
            text += f"\n\nMended:\n\n{code_block(explanation.fixed)}"
    return "\n".join(map(_escape, text.split("\n")))


def _result(diagnostic: Diagnostic, index: int, folder: Path | None) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": diagnostic.code,
        "ruleIndex": index,
        "level": diagnostic.severity.value,
        "message": {"text": "\n".join(map(_escape, diagnostic.lines))},
    }
    if diagnostic.primary is not None:
        result["locations"] = [{"physicalLocation": _location(diagnostic.primary, folder)}]
    if diagnostic.labels:
        result["relatedLocations"] = [
            {
                "id": number,
                "physicalLocation": _location(label.span, folder),
                "message": {"text": _escape(label.message)},
            }
            for number, label in enumerate(diagnostic.labels, start=1)
        ]
    if diagnostic.fixes:
        result["fixes"] = [_fix(fix, folder) for fix in diagnostic.fixes]
    return result


def _fix(fix: Fix, folder: Path | None) -> dict[str, Any]:
    """Return a fix, whose edits SARIF groups by file."""
    files: dict[SourceFile, list[dict[str, Any]]] = {}
    for edit in fix.edits:
        replacement = {
            "deletedRegion": _region(edit.span),
            "insertedContent": {"text": edit.text},
        }
        files.setdefault(edit.span.source, []).append(replacement)
    return {
        "description": {"text": _escape(fix.title)},
        "artifactChanges": [
            {"artifactLocation": _artifact(source, folder), "replacements": replacements}
            for source, replacements in files.items()
        ],
    }


def _location(span: Span, folder: Path | None) -> dict[str, Any]:
    artifact = _artifact(span.source, folder)
    return {"artifactLocation": artifact, "region": _region(span)}


def _region(span: Span) -> dict[str, int]:
    line, column = _position(span.source, span.start)
    end_line, end_column = _position(span.source, span.end)
    return {
        "startLine": line,
        "startColumn": column,
        "endLine": end_line,
        "endColumn": end_column,
    }


def _artifact(source: SourceFile, folder: Path | None) -> dict[str, str]:
    name = display_name(source, folder)
    if source.path is None:
        return {"uri": quote(os.fsencode(name))}
    if Path(name).is_absolute():
        return {"uri": Path(name).as_uri()}
    return {"uri": quote(os.fsencode(name)), "uriBaseId": "%SRCROOT%"}


def _position(source: SourceFile, offset: int) -> tuple[int, int]:
    line, column = source.position(offset)
    before = source.text[offset - column + 1 : offset]
    return line, len(before.encode("utf-16-le")) // 2 + 1


def _escape(text: str) -> str:
    """Return a text as a SARIF message: braces and links are escaped."""
    return visible(text).replace("{", "{{").replace("}", "}}").replace("](", "\\](")
