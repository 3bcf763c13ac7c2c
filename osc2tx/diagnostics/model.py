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


class InternalCompilerError(Exception):
    """A bug of osc2tx itself, never a mistake in the source."""
