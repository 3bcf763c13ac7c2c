"""Explanation of a code as text."""

from __future__ import annotations

from textwrap import fill, indent

from osc2tx.diagnostics.codes import Code

_BOLD, _RED, _GREEN, _RESET = "\x1b[1m", "\x1b[31m", "\x1b[32m", "\x1b[0m"
WIDEST = 100  # columns of a text that is easy to read

STANDARD = "OpenSCENARIO DSL 2.2"


def render_explanation(entry: Code, *, width: int | None = None, color: bool = False) -> str:
    """Return the page of a code, without the last line end.

    Args:
        entry: The code.
        width: Columns of the terminal, which prose keeps to; sources have lines of their own.
        color: Whether to use the colors of a terminal.
    """

    def prose(text: str) -> str:
        room = min(width or 0, WIDEST)
        lines = text.split("\n")
        return (
            "\n".join(fill(line, room, break_on_hyphens=False) for line in lines) if room else text
        )

    def painted(text: str, style: str) -> str:
        return f"{style}{text}{_RESET}" if color else text

    head = painted(f"{entry.code} {entry.slug} ({entry.severity.value})", _BOLD)
    parts = [head, prose(entry.summary)]
    if entry.section:
        parts[-1] += f"\nSee {STANDARD}, section {entry.section}."
    explanation = entry.explanation
    if explanation is not None:
        options = f" (with {explanation.options})" if explanation.options else ""
        parts += [painted(f"Faulty{options}:", _RED), _indented(explanation.faulty)]
        parts.append(prose(explanation.remedy))
        if explanation.fixed:
            parts += [painted("Fixed:", _GREEN), _indented(explanation.fixed)]
    return "\n\n".join(parts)


def explanation_data(entry: Code) -> dict[str, str | None]:
    """Return the documentation of a code, for other programs."""
    explanation = entry.explanation
    return {
        "code": entry.code,
        "name": entry.slug,
        "severity": entry.severity.value,
        "summary": entry.summary,
        "section": entry.section,
        "options": explanation.options if explanation else None,
        "remedy": explanation.remedy if explanation else None,
        "faulty": explanation.faulty if explanation else None,
        "fixed": explanation.fixed if explanation else None,
    }


def code_block(source: str) -> str:
    """Return a source text as a code block of Markdown."""
    fence = "```" if "```" not in source else "````"
    return f"{fence}\n{source.rstrip()}\n{fence}"


def _indented(source: str) -> str:
    return indent(source.rstrip(), "    ")
