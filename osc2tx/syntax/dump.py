"""Prints an AST as text, one node a line: for golden tests and `--emit ast`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from enum import Enum

from osc2tx.diagnostics import Span
from osc2tx.syntax import ast

_HIDDEN = frozenset({"span", "comments", "trailing_comment", "comments_below", "end_comments"})


def dump_ast(file: ast.File) -> str:
    """Return the AST as indented text, with the extent `line:column-line:column` of each node."""
    lines: list[str] = []
    # Chains nest as deeply as they are long, so the walk keeps its own stack.
    stack: list[Iterator[str | tuple[str, ast.Node, int]]] = [iter([("", file, 0)])]
    while stack:
        item = next(stack[-1], None)
        if item is None:
            stack.pop()
        elif isinstance(item, str):
            lines.append(item)
        else:
            stack.append(_node_lines(*item))
    return "\n".join(lines) + "\n"


def _node_lines(role: str, node: ast.Node, depth: int) -> Iterator[str | tuple[str, ast.Node, int]]:
    indent = "  " * depth
    children: list[tuple[str, ast.Node]] = []
    values: list[str] = []
    for field in fields(node):
        value = getattr(node, field.name)
        if field.name in _HIDDEN or value is None or value == ():
            continue
        if isinstance(value, (ast.Name, ast.BehaviorName)):
            values.append(f"{field.name}={value}@{_extent(value.span)}")
        elif isinstance(value, tuple) and isinstance(value[0], ast.Name):
            values.append(f"{field.name}={','.join(f'{n}@{_extent(n.span)}' for n in value)}")
        elif isinstance(value, ast.Node):
            children.append((field.name, value))
        elif isinstance(value, tuple) and isinstance(value[0], ast.Node):
            children += [(f"{field.name}[{i}]", child) for i, child in enumerate(value)]
        else:
            values.append(f"{field.name}={_shown(value)}")
    head = " ".join([type(node).__name__, *values])
    yield f"{indent}{role}{': ' if role else ''}{head}  <{_extent(node.span)}>"
    for name in ("comments", "trailing_comment"):
        yield from _comment_lines(node, name, indent)
    for child_role, child in children:
        yield child_role, child, depth + 1
    for name in ("end_comments", "comments_below"):
        yield from _comment_lines(node, name, indent)


def _comment_lines(node: ast.Node, name: str, indent: str) -> Iterator[str]:
    value = getattr(node, name, None)
    for text in (value,) if isinstance(value, str) else value or ():
        yield f"{indent}  # {name.removesuffix('s')}: {text}".rstrip()


def _shown(value: object) -> str:
    if isinstance(value, Enum):
        return repr(value.value)
    if isinstance(value, tuple):
        return ".".join(str(item) for item in value)
    return repr(value)


def _extent(span: Span) -> str:
    line, column = span.source.position(span.start)
    end_line, end_column = span.source.position(span.end)
    end = str(end_column) if end_line == line else f"{end_line}:{end_column}"
    return f"{line}:{column}-{end}"
