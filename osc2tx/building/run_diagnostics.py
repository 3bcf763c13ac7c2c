"""What a run reports, as diagnostics at its places in the sources."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx.diagnostics import Diagnostic, Severity, Span

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Compilation


def diagnostic_of_run(
    compilation: Compilation, code: str, severity: Severity, message: str, place: str | None
) -> Diagnostic:
    """Return what a run reports as a diagnostic at its place."""
    return Diagnostic(code, severity, message, _span(compilation, place))


def _span(compilation: Compilation, place: str | None) -> Span:
    """Return the span of a place of a run: a column where it knows one, else the line."""
    from osc2tx_runtime.errors import SourcePlace

    name, _, line = (place or "").rpartition(":")
    model = compilation.model
    sources = () if model is None else (file.span.source for file in model.files)
    source = next((each for each in sources if each.name == name), None)
    if source is None or not line.isdigit():
        return compilation.start
    column = place.column if isinstance(place, SourcePlace) else 1
    begin = source.line_starts[int(line) - 1] + column - 1
    text = source.line_text(int(line))[column - 1 :].partition(" #")[0].rstrip()
    return Span(source, begin, begin + max(1, len(text)))
