"""The last step: black, and a check that the result is Python."""

from __future__ import annotations

import ast

from osc2tx.diagnostics import InternalCompilerError

LINE_LENGTH = 100


def format_module(text: str) -> str:
    """Return the module in black's style.

    Raises:
        InternalCompilerError: The templates made something that is not Python.
    """
    from black.parsing import InvalidInput

    try:
        formatted = _in_style(text)
        ast.parse(formatted)
    except (InvalidInput, SyntaxError) as error:
        raise InternalCompilerError(f"generated module is not valid Python: {error}") from error
    return formatted


def _in_style(text: str) -> str:
    """Return what `black.format_str` makes of a text, in half the time where that can be told.

    It runs twice over every text that it changes, for commas that the first pass adds may make the
    second one split other lines. Where the first pass has moved white space and exchanged quotes
    alone, the second one meets the same tokens and does the same again.
    """
    import black
    from black.mode import Mode, TargetVersion

    mode = Mode(line_length=LINE_LENGTH, target_versions={TargetVersion.PY311})
    one_pass = getattr(black, "_format_str_once", None)
    if one_pass is None:  # another version of black: it is not part of its interface
        return black.format_str(text, mode=mode)
    first: str = one_pass(text, mode=mode)
    return first if _tokens(first) == _tokens(text) else black.format_str(first, mode=mode)


def _tokens(text: str) -> str:
    return "".join(text.replace("'", '"').split())
