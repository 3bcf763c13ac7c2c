"""Method calls, and the built-in operators of lists and ranges (§7.3.7, §7.4.2.7)."""

from __future__ import annotations

from typing import assert_never

from osc2tx.semantics.assign import check_condition
from osc2tx.semantics.binding import bind_call, type_arguments
from osc2tx.semantics.builtins import (
    LIST_METHODS,
    RANGE_METHODS,
    list_method_result,
    range_method_result,
)
from osc2tx.semantics.conversions import symbol_of
from osc2tx.semantics.expressions.access import note_prelude_member, report_unknown_member
from osc2tx.semantics.lookup import find_member, lookup_value, visible_names
from osc2tx.semantics.model import Binding
from osc2tx.semantics.resolution import Environment, Resolution, declared_here, did_you_mean
from osc2tx.semantics.symbols import MethodSymbol, Symbol
from osc2tx.semantics.types import BOOL, ERROR, VOID, ListType, PrimitiveType, RangeType, Type
from osc2tx.syntax import ast


def infer_call(r: Resolution, node: ast.Call, env: Environment) -> Type:
    """Type `callee(arguments)`; a method without result is no value."""
    result = resolve_call(r, node, node.callee, env)
    if result == VOID:
        r.report(
            "OSC410",
            node.span,
            "a method without result cannot be used in an expression",
            help="write `call …` as a member of the behavior",
        )
        return ERROR
    return result


def resolve_call(
    r: Resolution,
    node: ast.Call | ast.CallDirective,
    callee: ast.Expression,
    env: Environment,
) -> Type:
    """Bind a call, and return the result type of the method."""
    match callee:
        case ast.NameExpression():
            symbol = _find_plain(r, callee, env)
            receiver = None
        case ast.MemberAccess():
            base = r.type_of(callee.base, env)
            if isinstance(base, ListType | RangeType) and isinstance(node, ast.Call):
                return _resolve_operator(r, node, callee, base, env)
            symbol = _find_member(r, callee, base, env)
            receiver = callee.base
        case _:
            r.type_of(callee, env)
            r.report("OSC316", callee.span, "this cannot be called; it is not a method")
            symbol, receiver = None, None
    if symbol is None:
        type_arguments(r, node.arguments, env)
        return ERROR
    r.references[callee] = symbol
    bind_call(r, node, symbol, receiver, callee.span, env)
    return symbol.result


def _find_plain(r: Resolution, callee: ast.NameExpression, env: Environment) -> MethodSymbol | None:
    symbol = lookup_value(r, callee.name, env)
    if symbol is None:
        r.report(
            "OSC201",
            callee.span,
            f"no method `{callee.name}`",
            help=did_you_mean(callee.name.text, visible_names(r, env)),
        )
        return None
    return _as_method(r, callee, symbol)


def _as_method(
    r: Resolution, callee: ast.NameExpression | ast.MemberAccess, symbol: Symbol
) -> MethodSymbol | None:
    if isinstance(symbol, MethodSymbol):
        return symbol
    r.report(
        "OSC316",
        callee.name.span,
        f"`{callee.name}` is not a method",
        labels=declared_here(symbol),
    )
    return None


def _find_member(
    r: Resolution, callee: ast.MemberAccess, base: Type, env: Environment
) -> MethodSymbol | None:
    if base == ERROR:
        return None
    owner = symbol_of(base)
    if owner is None and isinstance(base, PrimitiveType):
        owner = r.scope.primitive_named(base.name)
    if owner is None:
        r.report("OSC208", callee.name.span, f"`{base}` has no method `{callee.name}`")
        return None
    member = find_member(r, owner, callee.name, env.context)
    if member is None:
        report_unknown_member(r, owner, callee.name)
        return None
    note_prelude_member(r, member, owner, callee.name)
    return _as_method(r, callee, member)


def _resolve_operator(
    r: Resolution,
    node: ast.Call,
    callee: ast.MemberAccess,
    base: ListType | RangeType,
    env: Environment,
) -> Type:
    match base:
        case ListType():
            operators = LIST_METHODS
        case RangeType():
            operators = RANGE_METHODS
        case _:
            assert_never(base)
    method = operators.get(callee.name.text)
    if method is None:
        r.report(
            "OSC208",
            callee.name.span,
            f"`{base}` has no method `{callee.name}`",
            help=did_you_mean(callee.name.text, operators),
        )
        type_arguments(r, node.arguments, env)
        return ERROR
    r.references[callee] = method
    pairs = tuple(
        (parameter, argument.value)
        for parameter, argument in zip(method.parameters, node.arguments, strict=False)
    )
    r.bindings[node] = Binding(method, callee.base, pairs)
    _check_operator_arity(r, node, callee, method)
    if isinstance(base, RangeType):
        r.needs_standard(callee.name.span, f"`{method.name}()`")
        return range_method_result(base)
    return _infer_list_operator(r, node, method, base, env)


def _check_operator_arity(
    r: Resolution, node: ast.Call, callee: ast.MemberAccess, method: MethodSymbol
) -> None:
    if len(node.arguments) > len(method.parameters):
        count = len(method.parameters)
        extra = node.arguments[count]
        r.report("OSC405", extra.span, f"`{method.name}` takes {count or 'no'} argument")
    elif len(node.arguments) < len(method.parameters):
        r.report("OSC404", callee.name.span, f"`{method.name}` misses its argument")


def _infer_list_operator(
    r: Resolution, node: ast.Call, method: MethodSymbol, base: ListType, env: Environment
) -> Type:
    inner = env.with_it(base.element)
    argument: Type = ERROR
    if node.arguments and method.parameters:
        value = node.arguments[0].value
        if method.parameters[0].type == BOOL:
            check_condition(r, value, inner)
        else:
            argument = r.type_of(value, inner)
    return list_method_result(method.name, base, argument)
