"""Diagnostics: the findings of the compiler about a source text.

A diagnostic is data (code, severity, message, spans, help); a stage puts it into a
`DiagnosticSink` and continues. Rendering is separate.

Modules, in reading order: `source` (texts and spans), `model` (the diagnostic itself), `codes` (the
registry of codes and their explanations), `sink` (collecting and ordering), `suppressions`
(comments that silence warnings), `report` (the diagnostics of a run), `render` (its formats).
`suggestions` finds the nearest name ("did you mean").
"""

from osc2tx.diagnostics.codes import CODES, Code
from osc2tx.diagnostics.model import Diagnostic, InternalCompilerError, Label, Severity
from osc2tx.diagnostics.sink import DiagnosticSink
from osc2tx.diagnostics.source import SourceFile, Span

__all__ = [
    "CODES",
    "Code",
    "Diagnostic",
    "DiagnosticSink",
    "InternalCompilerError",
    "Label",
    "Severity",
    "SourceFile",
    "Span",
]
