"""Diagnostics of source files, from a compilation or from the result cache.

Nothing here loads a stage: a check whose result is remembered needs none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from osc2tx.diagnostics import Diagnostic, SourceFile, Span
from osc2tx.diagnostics.report import ScenarioEntry
from osc2tx.diagnostics.suppressions import Suppression, SuppressionResult, settle
from osc2tx_shared.classes import dataclass, replace


class Reportable(Protocol):
    """The diagnostics of one source file, wherever it was compiled."""

    @property
    def source(self) -> SourceFile | None:
        """The text; `None` if there is none."""

    @property
    def start(self) -> Span:
        """The span of findings about the whole file, even if there is no text."""

    @property
    def reports(self) -> Sequence[Diagnostic]:
        """The diagnostics of the stages, in order of position."""

    @property
    def is_complete(self) -> bool:
        """Whether all stages that can report something ran and found no error."""

    @property
    def scenarios(self) -> Sequence[ScenarioEntry]:
        """The scenarios of the file, with how far each is worked out."""


@dataclass(frozen=True, slots=True)
class LossEntry:
    """The result of a scenario as OpenSCENARIO XML.

    Attributes:
        scenario: Its name.
        is_written: Whether there is XML.
        summary: Its report, in one line.
        reasons: The obstacles to XML.
    """

    scenario: str
    is_written: bool
    summary: str
    reasons: tuple[str, ...] = ()


def apply_suppressions(compilations: Sequence[Reportable]) -> SuppressionResult:
    """Return the diagnostics of several files, each once, and the suppressed ones.

    A report in a file that several others import counts once; a suppression there is used if it
    is of use to one of them.
    """
    found: dict[tuple[object, ...], Diagnostic] = {}
    for compilation in compilations:
        for reported in compilation.reports:
            span = reported.primary or compilation.start
            diagnostic = replace(reported, primary=span)
            place = (span.source.identity, span.start, span.end)
            found.setdefault((diagnostic.code, diagnostic.message, *place), diagnostic)
    judged = {
        compilation.source: compilation.is_complete
        for compilation in compilations
        if compilation.source is not None and _may_suppress(compilation.source)
    }
    return settle(found.values(), judged, _suppressions_of)


def _may_suppress(source: SourceFile) -> bool:
    return "#!" in source.text


def _suppressions_of(source: SourceFile) -> Sequence[Suppression]:
    if not _may_suppress(source):
        return ()
    from osc2tx.syntax.suppressions import find_suppressions  # few texts have any

    return find_suppressions(source)
