"""Diagnostics as text for people.

The form is `file:line:col: severity[CODE]: message (§section)`, the source line with carets under
the span, then related places, notes and one line of help. Columns count characters, as editors do;
carets count the cells that a terminal needs.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from pathlib import Path

from osc2tx.diagnostics.codes import CODES
from osc2tx.diagnostics.model import Diagnostic, Severity
from osc2tx.diagnostics.report import display_name
from osc2tx.diagnostics.source import SourceFile, Span
from osc2tx_shared.text import visible

TAB_WIDTH = 4
MAX_CHARACTERS = 160  # of a source line; of longer ones only the part around the span is shown
LEAD = 60  # characters kept in front of the span there

_BOLD, _RED, _YELLOW, _BLUE, _RESET = "\x1b[1m", "\x1b[31m", "\x1b[33m", "\x1b[34m", "\x1b[0m"
_SEVERITY_COLORS = {Severity.ERROR: _BOLD + _RED, Severity.WARNING: _BOLD + _YELLOW}


def render_all(
    diagnostics: Iterable[Diagnostic], *, color: bool = False, folder: Path | None = None
) -> str:
    """Return all diagnostics in the given order, an empty line between them."""
    return "\n".join(render_text(d, color=color, folder=folder) for d in diagnostics)


def render_text(diagnostic: Diagnostic, *, color: bool = False, folder: Path | None = None) -> str:
    """Return one diagnostic as lines of text, the last one with its line end.

    Args:
        diagnostic: The diagnostic.
        color: Whether to use the colors of a terminal.
        folder: If given, files below it are cited relative to it and others by their full path,
            so that a terminal can open them; else every file has the name of its `SourceFile`.
    """
    paint = _paint if color else _plain
    severity = diagnostic.severity
    head = paint(f"{severity.value}[{diagnostic.code}]", _SEVERITY_COLORS[severity])
    section = CODES[diagnostic.code].section if diagnostic.code in CODES else ""
    message = visible(diagnostic.message) + (f" (§{section})" if section else "")
    spans = [s for s in (diagnostic.primary, *(x.span for x in diagnostic.labels)) if s is not None]
    gutter = max((len(str(_end_line(span))) for span in spans), default=1) + 1

    lines = []
    if diagnostic.primary is None:
        lines.append(f"{head}: {paint(message, _BOLD)}")
    else:
        place = _place(diagnostic.primary, folder)
        lines.append(f"{paint(place, _BOLD)}: {head}: {paint(message, _BOLD)}")
        marks = _snippet(diagnostic.primary, gutter) if diagnostic.primary.source.text else []
        lines += [paint(text, _SEVERITY_COLORS[severity]) if m else text for m, text in marks]
    for label in diagnostic.labels:
        lines.append(f"  {_place(label.span, folder)}: {visible(label.message)}")
        lines += [paint(text, _BLUE) if m else text for m, text in _snippet(label.span, gutter)]
    lines += [f"  note: {visible(note)}" for note in diagnostic.notes]
    if diagnostic.help is not None:
        lines.append(f"  {paint('help', _BOLD)}: {visible(diagnostic.help)}")
    return "".join(f"{line}\n" for line in lines)


def _plain(text: str, _: str) -> str:
    return text


def _paint(text: str, style: str) -> str:
    return f"{style}{text}{_RESET}"


def _place(span: Span, folder: Path | None) -> str:
    return visible(f"{display_name(span.source, folder)}:{span.line}:{span.column}")


def _end_line(span: Span) -> int:
    """Return the line of the last character that a span covers."""
    return span.source.position(max(span.start, span.end - 1))[0]


def _snippet(span: Span, gutter: int) -> list[tuple[bool, str]]:
    """Return the first and the last line of a span, each with marks below it.

    The flag of each row states whether it holds marks.
    """
    source = span.source
    first, column = source.position(span.start)
    last = _end_line(span)
    if first == last:
        return _marked_line(source, first, column - 1, column - 1 + span.end - span.start, gutter)
    rows = _marked_line(source, first, column - 1, len(source.line_text(first)), gutter)
    if last > first + 1:
        rows.append((False, f"{'...':>{gutter + 2}} |"))
    text = source.line_text(last)
    indent = len(text) - len(text.lstrip())
    end = source.position(span.end - 1)[1]
    return rows + _marked_line(source, last, min(indent, end - 1), end, gutter)


def _marked_line(
    source: SourceFile, line: int, start: int, end: int, gutter: int
) -> list[tuple[bool, str]]:
    """Return a source line and the carets under the characters from `start` to `end`."""
    text = source.line_text(line)
    start = min(start, len(text))
    end = max(start, min(end, len(text)))
    before = after = ""
    if len(text) > MAX_CHARACTERS:
        cut = max(0, start - LEAD)
        before, after = "…" * (cut > 0), "…" * (cut + MAX_CHARACTERS < len(text))
        text = text[cut : cut + MAX_CHARACTERS]
        start, end = start - cut, min(end - cut, len(text))
    cells = _cells(text)
    shown = before + "".join(cells) + after
    blank = len(before) + sum(map(_width, cells[:start]))
    carets = max(1, sum(map(_width, cells[start:end])))
    return [
        (False, f"  {line:>{gutter}} | {shown}".rstrip()),
        (True, f"  {'':>{gutter}} | {' ' * blank}{'^' * carets}"),
    ]


def _cells(text: str) -> list[str]:
    """Return the printed form of each character: tabs as blanks, control characters as escapes."""
    cells: list[str] = []
    column = 0
    for char in text:
        cell = " " * (TAB_WIDTH - column % TAB_WIDTH) if char == "\t" else visible(char)
        cells.append(cell)
        column += _width(cell)
    return cells


def _width(cell: str) -> int:
    """Return the terminal cells of a text."""
    return sum(
        (
            0
            if unicodedata.category(char) in ("Mn", "Me")
            else 1 + (unicodedata.east_asian_width(char) in "WF")
        )
        for char in cell
    )
