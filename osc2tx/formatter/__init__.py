"""Formats scenario files after the style guide of the standard (§9.2).

Input: a `SourceFile` without syntax errors. Output: the same tokens and comments in the same order,
laid out anew; nothing is renamed, reordered or dropped.

Stages, in order:

1. `read_lines` (`lines`): tokens and the text between them to logical lines.
2. `lay_out` (`layout`, with `spacing`): a logical line to one or several physical lines.
3. `join_lines` (`blanks`): indentation and blank lines between them.

Invariants: formatting a formatted text changes nothing; its tokens and comments are those
of the source, which is checked before the text is returned.
"""

from __future__ import annotations

from osc2tx.diagnostics import DiagnosticSink, InternalCompilerError, SourceFile
from osc2tx.formatter.blanks import join_lines
from osc2tx.formatter.lines import read_lines
from osc2tx.syntax.token_source import TokenSource
from osc2tx.syntax.tokens import TokenTable

__all__ = ["format_source"]


def format_source(source: SourceFile) -> str:
    """Return the text of a file as the style guide wants it (§9.2.2), lines ended by LF.

    Args:
        source: The text, without syntax errors.
    """
    table = _scan(source)
    formatted = join_lines(read_lines(table))
    if _content(_scan(SourceFile(source.name, formatted))) != _content(table):
        raise InternalCompilerError(f"formatting changes the content of {source.name}")
    return formatted


def _scan(source: SourceFile) -> TokenTable:
    return TokenSource(source, DiagnosticSink(), allow=("OSC111",)).scan()


def _content(table: TokenTable) -> tuple[object, ...]:
    """What formatting must not change: the tokens, and the comments where they belong."""
    layout = {
        index
        for index, text in enumerate(map(table.text, range(len(table.types))))
        if not text.strip()
    }  # line ends and blocks: their types count, not their characters
    tokens = [
        (kind, "" if index in layout else table.text(index))
        for index, kind in enumerate(table.types)
    ]
    return tokens, [(comment.before, comment.text) for comment in table.comments]
