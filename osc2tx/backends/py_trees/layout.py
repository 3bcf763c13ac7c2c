"""Statements and calls in black's layout: one line where they fit, else one for each argument.

Statements that black may lay out differently stay on one line; `formatting` passes them to black.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from osc2tx.backends.py_trees import layout
from osc2tx.backends.py_trees.formatting import INDENT, LINE_LENGTH, is_plain
from osc2tx.backends.py_trees.view import ArgumentView, CallView, StatementView
from osc2tx.resources import resource_dir

if TYPE_CHECKING:
    from jinja2 import Environment


def statement(view: StatementView, column: int) -> str:
    """Lay a statement out from a column on, below its comments."""
    indent = " " * column
    start = indent
    if view.target is not None:
        annotation = f": {view.annotation}" if view.annotation is not None else ""
        start = f"{indent}{view.target}{annotation} = "
    lines = [""] if view.blank_before else []
    lines += _commented(view, indent, _argument(view.value, column, start, ""))
    return "\n".join(lines)


def returned(view: ArgumentView, column: int) -> str:
    """Lay a statement out that returns a value."""
    return _argument(view, column, f"{' ' * column}return ", "")


def _argument(view: ArgumentView, column: int, start: str, end: str) -> str:
    """Lay out an argument that begins in a column, between the other text on its lines."""
    if view.keyword:
        start = f"{start}{view.keyword}="
    if view.call is None:
        return f"{start}{view.code}{end}"
    opening, closing = _brackets(view.call)
    start, end = f"{start}{opening}", f"{closing}{end}"
    arguments = _on_one_line(view.call)
    if arguments is not None:
        line = f"{start}{arguments}{end}"
        if len(line) <= LINE_LENGTH or not is_plain(line):
            return line
    return "\n".join((start, *_lines(view.call, arguments, column + INDENT), " " * column + end))


def _lines(call: CallView, on_one_line: str | None, column: int) -> list[str]:
    """Lay the arguments of a call out that has several lines."""
    indent = " " * column
    if on_one_line is not None and column + len(on_one_line) <= LINE_LENGTH:
        return [indent + on_one_line]
    comma = "," if call.exploded or len(call.arguments) > 1 else ""
    lines = []
    for each in call.arguments:
        lines += _commented(each, indent, _argument(each, column, indent, comma))
    return lines + [f"{indent}{comment}" for comment in call.end_comments]


def _commented(view: ArgumentView | StatementView, indent: str, text: str) -> list[str]:
    """Write a text with its comments: the trailing one behind it, or above where it is too long."""
    above = [f"{indent}{comment}" for comment in view.comments]
    if isinstance(view, StatementView) and above[1:] and not view.comments[-1].text:
        above[-1] = ""  # a blank line parts the comment from the statement
    below = [f"{indent}{comment}" for comment in view.below]
    if view.trailing is None:
        return [*above, text, *below]
    line = f"{text}  {view.trailing}"
    if "\n" in text or len(line) > LINE_LENGTH or not is_plain(text):
        return [*above, f"{indent}{view.trailing}", text, *below]
    return [*above, line, *below]


def _on_one_line(call: CallView) -> str | None:
    """Write the arguments of a call on one line; None where they need several."""
    if call.end_comments or (call.exploded and call.arguments):
        return None
    written = []
    for each in call.arguments:
        text = str(each.code)
        if each.call is not None:
            inner = _on_one_line(each.call)
            if inner is None:
                return None
            text = inner.join(_brackets(each.call))
        if each.comments or each.trailing or each.below:
            return None
        written.append(f"{each.keyword}={text}" if each.keyword else text)
    return ", ".join(written)


def _brackets(call: CallView) -> tuple[str, str]:
    return (f"{call.callee}(", ")") if call.callee else ("[", "]")


def template_folder() -> Path:
    """Return the folder of this backend's templates."""
    return Path(str(resource_dir("templates"))) / "py_trees"


@cache
def environment() -> Environment:
    """Return the environment: strict about undefined names, with filters that lay code out."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    from osc2tx.backends.py_trees.compiled_templates import CompiledTemplates

    folder = template_folder()
    made = Environment(
        loader=FileSystemLoader(folder),
        bytecode_cache=CompiledTemplates(folder),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=False,
        keep_trailing_newline=True,
    )
    made.filters |= {"statement": layout.statement, "returned": layout.returned}
    return made
