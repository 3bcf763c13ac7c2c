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
    from black import format_str
    from black.mode import Mode, TargetVersion
    from black.parsing import InvalidInput

    mode = Mode(line_length=LINE_LENGTH, target_versions={TargetVersion.PY311})
    try:
        formatted = format_str(text, mode=mode)
        ast.parse(formatted)
    except (InvalidInput, SyntaxError) as error:
        raise InternalCompilerError(f"generated module is not valid Python: {error}") from error
    return formatted
