"""Explanation of a code as text."""

from __future__ import annotations

from textwrap import indent

from osc2tx.diagnostics.codes import Code

STANDARD = "OpenSCENARIO DSL 2.2"


def render_explanation(entry: Code) -> str:
    """Return the page of a code, without the last line end."""
    parts = [f"{entry.code} {entry.slug} ({entry.severity.value})", entry.summary]
    if entry.section:
        parts[-1] += f"\nSee {STANDARD}, section {entry.section}."
    explanation = entry.explanation
    if explanation is not None:
        options = f" (with {explanation.options})" if explanation.options else ""
        parts += [f"Faulty{options}:", _indented(explanation.faulty), explanation.remedy]
        if explanation.fixed:
            parts += ["Fixed:", _indented(explanation.fixed)]
    return "\n\n".join(parts)


def explanation_data(entry: Code) -> dict[str, str | None]:
    """Return what there is to say of a code, for other programs."""
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
