"""The diagnostic as data."""

from __future__ import annotations

from enum import Enum

from osc2tx.diagnostics.fixes import Fix
from osc2tx.diagnostics.source import Span
from osc2tx_shared.classes import dataclass


class Severity(Enum):
    """How much a diagnostic matters: an error means that nothing is emitted."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class Label:
    """A further position that explains a diagnostic, with a description of it."""

    span: Span
    message: str


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One report about the source.

    Attributes:
        code: Stable identifier from the registry, `OSC203`.
        severity: Error or warning.
        message: Lower case, no full stop, code words in backticks.
        primary: The smallest span that shows the mistake; `None` for a whole input.
        labels: Related places, each with a remark.
        notes: Further facts, a line each.
        help: The remedy, one line.
        fixes: Corrections that apply it; none where the replacement is not known.
    """

    code: str
    severity: Severity
    message: str
    primary: Span | None
    labels: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str | None = None
    fixes: tuple[Fix, ...] = ()

    @property
    def lines(self) -> list[str]:
        """The message, the notes and the help, for programs that show a text."""
        notes = [f"note: {note}" for note in self.notes]
        return [self.message, *notes, *([] if self.help is None else [f"help: {self.help}"])]


class InternalCompilerError(Exception):
    """A bug of osc2tx itself, never a mistake in the source."""
