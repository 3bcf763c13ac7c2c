"""Applies the fixes of diagnostics to source texts."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx.building.jobs import Job
from osc2tx.diagnostics import Diagnostic, SourceFile
from osc2tx.diagnostics.fixes import Fix, apply_edits, compatible
from osc2tx_shared.classes import dataclass

MOST_ROUNDS = 50  # a corrected syntax error lets the next ones be found


@dataclass(frozen=True, slots=True)
class FixedText:
    """A source text after its fixes.

    Attributes:
        text: The text.
        applied: How many fixes were applied.
    """

    text: str
    applied: int


def fix_text(job: Job, text: str, *, unsafe: bool) -> FixedText:
    """Apply fixes, and those of what is found then, until none is left.

    Args:
        job: The file.
        text: Its text.
        unsafe: Whether to apply also fixes whose result the author may not have meant.
    """
    applied = 0
    seen = {text}
    for _ in range(MOST_ROUNDS):
        compilation = job.compilation(text=text)
        compilation.check()
        if compilation.source is None:
            break
        fixes = compatible(_chosen(compilation.diagnostics, compilation.source, unsafe=unsafe))
        fixed = apply_edits(text, (edit for fix in fixes for edit in fix.edits))
        if fixed in seen:
            break
        seen.add(fixed)
        text, applied = fixed, applied + len(fixes)
    return FixedText(text, applied)


def has_fix(found: Iterable[Diagnostic], source: SourceFile, *, unsafe: bool) -> bool:
    """Whether a diagnostic of a file has a fix that `fix_text` applies."""
    return bool(_chosen(found, source, unsafe=unsafe))


def _chosen(found: Iterable[Diagnostic], source: SourceFile, *, unsafe: bool) -> list[Fix]:
    """Return the first fix of each diagnostic that edits this file alone."""
    chosen = []
    for diagnostic in found:
        fixes = [fix for fix in diagnostic.fixes if fix.is_safe or unsafe]
        own = [f for f in fixes if all(edit.span.source is source for edit in f.edits)]
        chosen += own[:1]
    return chosen
