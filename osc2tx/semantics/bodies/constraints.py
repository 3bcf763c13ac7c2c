"""Constraints (§7.3.11)."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.semantics.assignability import check_condition
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.symbols import EnumMemberSymbol, FieldSymbol, ParameterSymbol
from osc2tx.semantics.types import BOOL
from osc2tx.syntax import ast


def check_keep(r: Resolution, node: ast.KeepConstraint, env: Environment) -> None:
    """Check `keep(expression)`: boolean, and at least one parameter is affected."""
    check_condition(r, node.expression, env)
    if r.types[node.expression] == BOOL:
        _check_affects_parameter(r, node.expression)


def check_remove_default(r: Resolution, node: ast.RemoveDefault, env: Environment) -> None:
    """Check `remove_default(parameter)`."""
    r.type_of(node.parameter, env)
    symbol = r.references.get(node.parameter)
    if symbol is not None and (not isinstance(symbol, FieldSymbol) or symbol.is_variable):
        r.report(
            "OSC411",
            node.parameter.span,
            f"`{symbol.name}` is not a parameter",
            labels=declared_here(symbol),
        )


def _check_affects_parameter(r: Resolution, expression: ast.Expression) -> None:
    """Report a constraint that could only be met by changing variables (§7.3.6)."""
    variable: FieldSymbol | None = None
    for path in paths_of(expression):
        if isinstance(r.references.get(path), EnumMemberSymbol):
            continue
        fields = list(_symbols_along(r, path))
        if any(s is None for s in fields):
            return
        culprit = next((s for s in fields if isinstance(s, FieldSymbol) and s.is_variable), None)
        if culprit is None:
            return
        variable = variable or culprit
    if variable is not None:
        r.report(
            "OSC411",
            expression.span,
            f"`{variable.name}` is a variable; a constraint cannot set it",
            labels=declared_here(variable),
        )


def root_of(path: ast.Expression) -> ast.Expression:
    """Return the first name of a path."""
    while isinstance(path, ast.MemberAccess | ast.Index | ast.Cast):
        path = path.base
    return path


def _symbols_along(r: Resolution, path: ast.Expression) -> Iterator[object]:
    current: ast.Expression = path
    while isinstance(current, ast.MemberAccess | ast.Index | ast.Cast):
        if isinstance(current, ast.MemberAccess):
            yield r.references.get(current)
        current = current.base
    if isinstance(current, ast.NameExpression):
        yield r.references.get(current)
    elif not isinstance(current, ast.ItExpression):
        yield ParameterSymbol


def paths_of(expression: ast.Expression) -> Iterator[ast.Expression]:
    """Yield the paths to fields in an expression; calls count as paths of unknown effect."""
    stack: list[ast.Expression] = [expression]
    while stack:
        node = stack.pop()
        match node:
            case ast.Binary():
                stack += (node.left, node.right)
            case ast.Unary():
                stack.append(node.operand)
            case ast.Conditional():
                stack += (node.condition, node.when_true, node.when_false)
            case ast.ListLiteral():
                stack += node.elements
            case ast.RangeLiteral():
                stack += (node.lower, node.upper)
            case ast.TypeTest():
                stack.append(node.base)
            case ast.NameExpression() | ast.MemberAccess() | ast.Index() | ast.Cast():
                yield node
            case ast.Call() | ast.ItExpression():
                yield node
            case _:
                continue
