"""The sink that collects the diagnostics of all stages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from osc2tx.diagnostics.codes import CODES
from osc2tx.diagnostics.fixes import Help, Remedy
from osc2tx.diagnostics.model import Diagnostic, InternalCompilerError, Label, Severity
from osc2tx.diagnostics.source import Span


class DiagnosticSink:
    """Collects diagnostics; the same report at the same place is kept once."""

    def __init__(self) -> None:
        """Start empty."""
        self._found: dict[tuple[object, ...], Diagnostic] = {}

    def report(
        self,
        code: str,
        primary: Span | None,
        message: str,
        *,
        labels: Sequence[Label] = (),
        notes: Sequence[str] = (),
        help: Help = None,
    ) -> None:
        """Add a diagnostic; its severity comes from the registry of codes."""
        if code not in CODES:
            raise InternalCompilerError(f"diagnostic code {code} is not registered")
        diagnostic = Diagnostic(
            code,
            CODES[code].severity,
            message,
            primary,
            tuple(labels),
            tuple(notes),
            help=help.help if isinstance(help, Remedy) else help,
            fixes=help.fixes if isinstance(help, Remedy) else (),
        )
        self.add([diagnostic])

    def add(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add diagnostics from elsewhere."""
        for each in diagnostics:
            span = each.primary
            place = (span.source.name, span.start, span.end) if span else ()
            self._found.setdefault((each.code, each.message, *place), each)

    @property
    def has_errors(self) -> bool:
        """Whether anything found forbids going on to the next stage."""
        return any(d.severity is Severity.ERROR for d in self._found.values())

    def has_report_at(self, span: Span) -> bool:
        """Whether something was reported at a place."""
        return any(each.primary == span for each in self._found.values())

    def sorted(self) -> tuple[Diagnostic, ...]:
        """Return everything found, in order."""
        return in_order(self._found.values())


def in_order(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return diagnostics ordered by file, position, severity and code."""

    def key(diagnostic: Diagnostic) -> tuple[str, int, int, str]:
        span = diagnostic.primary
        place = (span.source.name, span.start) if span else ("", 0)
        return *place, int(diagnostic.severity is Severity.WARNING), diagnostic.code

    return tuple(sorted(diagnostics, key=key))
