"""Comments that suppress warnings: `#! allow OSC603, relaxed-do: the reason`.

At the end of a line such a comment applies to the warnings that start on that line; on its own
line, to the warnings of the next statement line. It names every code, errors cannot be suppressed,
and a suppression that suppresses nothing is reported itself. The front end finds the comments, as
it distinguishes comments from strings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from osc2tx.diagnostics.codes import CODES, find_code, meant_code
from osc2tx.diagnostics.fixes import Remedy, leave_out, write
from osc2tx.diagnostics.model import Diagnostic, Severity
from osc2tx.diagnostics.sink import DiagnosticSink, in_order
from osc2tx.diagnostics.source import LINE_END, SourceFile, Span
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Suppression:
    """One comment.

    Attributes:
        span: The comment.
        names: The codes and slugs in it.
        lines: The lines whose warnings it means.
    """

    span: Span
    names: tuple[Span, ...]
    lines: range


@dataclass(frozen=True, slots=True)
class SuppressionResult:
    """Diagnostics after suppression.

    Attributes:
        shown: The remaining diagnostics, and the errors of the suppressions themselves.
        suppressed: The suppressed diagnostics.
    """

    shown: tuple[Diagnostic, ...]
    suppressed: tuple[Diagnostic, ...]


def settle(
    found: Iterable[Diagnostic],
    judged: Mapping[SourceFile, bool],
    find: Callable[[SourceFile], Sequence[Suppression]],
) -> SuppressionResult:
    """Apply the suppressions of all files that have diagnostics.

    Args:
        found: The diagnostics.
        judged: The files whose suppressions are checked, with whether all stages ran on the
            file, so that an unused suppression can be detected.
        find: Finds the suppressions of a file.
    """
    entries: dict[object, _Entries] = {}

    def entries_of(source: SourceFile) -> _Entries:
        if source.identity not in entries:
            entries[source.identity] = _Entries(find(source))
        return entries[source.identity]

    shown, suppressed = [], []
    for diagnostic in found:
        span = diagnostic.primary
        if span is None or not CODES[diagnostic.code].can_be_suppressed:
            shown.append(diagnostic)
        elif entries_of(span.source).use(diagnostic.code, span.line):
            suppressed.append(diagnostic)
        else:
            shown.append(diagnostic)
    sink = DiagnosticSink()
    for source, is_complete in judged.items():
        entries_of(source).check(sink, is_complete=is_complete)
    return SuppressionResult(in_order([*shown, *sink.sorted()]), in_order(suppressed))


class _Entries:
    """The suppressions of one file, and which of their codes were of use."""

    def __init__(self, suppressions: Sequence[Suppression]) -> None:
        self._suppressions = suppressions
        self._used: set[Span] = set()
        by_range: dict[range, dict[str, Span]] = {}
        for suppression in suppressions:
            names = by_range.setdefault(suppression.lines, {})
            for name in suppression.names:
                code = find_code(name.text)
                if code is not None and code.can_be_suppressed:
                    names.setdefault(code.code, name)
        self._by_line: dict[int, list[dict[str, Span]]] = {}
        for lines, names in by_range.items():
            for line in lines:
                self._by_line.setdefault(line, []).append(names)

    def use(self, code: str, line: int) -> bool:
        """Return whether a comment suppresses this; remember the first that does."""
        for names in self._by_line.get(line, ()):
            if code in names:
                self._used.add(names[code])
                return True
        return False

    def check(self, sink: DiagnosticSink, *, is_complete: bool) -> None:
        """Report errors of the suppressions."""
        for suppression in self._suppressions:
            if not suppression.names:
                sink.report(
                    "OSC704",
                    suppression.span,
                    "the suppression names no code",
                    help="write `#! allow OSC603: reason`",
                )
            for name in suppression.names:
                self._check_name(name, sink, is_complete)

    def _check_name(self, name: Span, sink: DiagnosticSink, is_complete: bool) -> None:
        code = find_code(name.text)
        if code is None:
            meant = meant_code(name.text)
            help = write(name, meant, f"did you mean `{meant}`?", is_safe=False) if meant else None
            sink.report("OSC702", name, f"there is no code `{name.text}`", help=help)
        elif code.severity is Severity.ERROR and not code.can_be_suppressed:
            message = f"`{code.code}` is an error; only warnings can be suppressed"
            sink.report("OSC703", name, message, help="fix the reported error")
        elif not code.can_be_suppressed:
            message = f"`{code.code}` is about suppressions and cannot be suppressed"
            sink.report("OSC703", name, message)
        elif is_complete and name not in self._used:
            message = f"the suppression of `{name.text}` is not used"
            sink.report("OSC701", name, message, help=self._taken_out(name))

    def _taken_out(self, name: Span) -> Remedy:
        """Return the remedy that removes a code from its comment, or the comment if it is alone."""
        comment = next(each for each in self._suppressions if name in each.names)
        names = comment.names
        if len(names) == 1:
            return leave_out(_with_blanks(comment.span), "take it out")
        index = names.index(name)
        first, last = (name, names[1]) if index == 0 else (names[index - 1], name)
        start, end = (first.start, last.start) if index == 0 else (first.end, last.end)
        return leave_out(Span(name.source, start, end), "take it out")


def _with_blanks(comment: Span) -> Span:
    """Return the span of a comment with the blanks before it, and its line if it has it alone."""
    text = comment.source.text
    start = comment.start
    while start > 0 and text[start - 1] in " \t":
        start -= 1
    end = LINE_END.match(text, comment.end)
    is_alone = start == 0 or text[start - 1] in "\r\n"
    return Span(comment.source, start, end.end() if is_alone and end else comment.end)
