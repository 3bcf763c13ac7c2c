"""Operators of lists as comprehensions of Python."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyExpr, PyName

Write: TypeAlias = Callable[[ir.Expression], PyExpr]


def element_name(depth: int) -> PyName:
    """Name the element that an operator of a list looks at."""
    return PyName("it" if depth == 0 else f"it_{depth + 1}")


def list_operation(node: ir.ListOperation, write: Write) -> PyExpr:
    """Write an operator of a list as a comprehension (§7.4.2.7).

    Args:
        node: The operation.
        write: Writes the expressions in it.
    """
    name = element_name(node.depth)
    values = write(node.base).within(Level.OR)
    if node.argument is None:
        return PyExpr(f"len({write(node.base)})", Level.ATOM)
    argument = write(node.argument)
    inner, test = argument.within(Level.CONDITIONAL), argument.within(Level.OR)
    match node.operator:
        case ir.ListOperator.FILTER:
            text = f"[{name} for {name} in {values} if {test}]"
        case ir.ListOperator.MAP:
            text = f"[{inner} {_elements(node, write)}]"
        case ir.ListOperator.HAS:
            text = f"any({inner} {_elements(node, write)})"
        case ir.ListOperator.COUNT:
            text = f"sum({inner} {_elements(node, write)})"
        case _:  # the first index
            found = f"index for index, {name} in enumerate({values}) if {test}"
            text = f"next(({found}), -1)"
    return PyExpr(text, Level.ATOM)


def _elements(node: ir.ListOperation, write: Write) -> str:
    """Write `for it in values`; a filter below needs no list."""
    base = node.base
    name = element_name(node.depth)
    if (
        isinstance(base, ir.ListOperation)
        and base.operator is ir.ListOperator.FILTER
        and base.argument is not None
        and base.depth == node.depth
    ):
        test = write(base.argument).within(Level.OR)
        return f"for {name} in {write(base.base).within(Level.OR)} if {test}"
    return f"for {name} in {write(base).within(Level.OR)}"
