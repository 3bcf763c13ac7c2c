"""Method calls, and the built-in operators of lists and ranges (§7.3.7, §7.4.2.7)."""

from __future__ import annotations

from typing import assert_never

from osc2tx.diagnostics.fixes import Help, write
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.assignability import check_condition
from osc2tx.semantics.bodies.binding import bind_call, type_arguments
from osc2tx.semantics.builtins import (
    LIST_METHODS,
    RANGE_METHODS,
    list_method_result,
    range_method_result,
)
from osc2tx.semantics.conversions import symbol_of
from osc2tx.semantics.declarations.resolve_types import type_of_symbol
from osc2tx.semantics.expressions.access import note_prelude_member, report_unknown_member
from osc2tx.semantics.expressions.type_receivers import implied_object
from osc2tx.semantics.model import Binding
from osc2tx.semantics.names.colloquial_names import CONDITIONS, LIST_WORDS, MEMBERS, plain_word
from osc2tx.semantics.names.member_lookup import find_member, lookup_value, visible_names
from osc2tx.semantics.names.unknown_names import in_newest_version
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import (
    ActorSymbol,
    FieldSymbol,
    MethodSymbol,
    PrimitiveSymbol,
    StructSymbol,
    Symbol,
)
from osc2tx.semantics.types import (
    BOOL,
    ERROR,
    INT,
    OBJECT,
    UINT,
    VOID,
    ListType,
    PrimitiveType,
    RangeType,
    Type,
)
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
            symbol = _find_plain(r, node, callee, env)
            receiver = None
        case ast.MemberAccess():
            base = type_itself(r, callee.base, callee.name, env)
            base = base or r.type_of(callee.base, env, OBJECT)
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


def type_itself(
    r: Resolution, receiver: ast.Expression, method: ast.Name, env: Environment
) -> Type | None:
    """Return the struct or actor type that precedes the dot instead of an instance.

    This is valid if the type has no fields, as all its instances are equal. For other actor types
    it is an object (`type_receivers`).
    """
    if not isinstance(receiver, ast.NameExpression):
        return None
    if lookup_value(r, receiver.name, env, quiet=True) is not None:
        return None
    named = r.scope.select(r.scope.types_named(receiver.name.text), receiver.name, env.context)
    if len(named) != 1 or not isinstance(named[0], StructSymbol | ActorSymbol):
        return None
    symbol = named[0]
    kind = "struct" if isinstance(symbol, StructSymbol) else "actor type"
    members = [m for ancestor in supertypes(symbol) for m in ancestor.members.values()]
    is_static = not any(isinstance(m, FieldSymbol) for m in members)
    if isinstance(symbol, ActorSymbol) and not is_static:
        return None
    r.references[receiver] = symbol
    if is_static and r.relaxes(
        "OSC618",
        receiver.span,
        f"`{receiver.name}.{method}()` is called on the {kind} itself, not on an instance",
        key=f"{symbol.name}.{method}",
        help=f"declare a field of type `{symbol.name}`, and call it on that",
    ):
        r.types[receiver] = type_of_symbol(symbol)
        r.references[receiver] = implied_object(r, symbol, receiver)
        return r.types[receiver]
    r.types[receiver] = ERROR
    r.report(
        "OSC316",
        receiver.span,
        f"`{receiver.name}` is a {kind}, not an instance of it".replace(" a a", " an a"),
        notes=[] if is_static else ["it has fields, whose values may be needed"],
        help=f"declare a field of type `{symbol.name}`, and call `{method}()` on that",
        labels=declared_here(symbol),
    )
    return ERROR


def call_by_statement(r: Resolution, node: ast.ModifierApplication, env: Environment) -> bool:
    """Whether a line that looks like a modifier calls a method of a struct."""
    if node.actor is None:
        return False
    if r.scope.modifiers_named(node.modifier.text):
        return False
    base = type_itself(r, node.actor, node.modifier, env)
    if base is None:
        return False
    owner = symbol_of(base)
    method = None if owner is None else find_member(r, owner, node.modifier, env.context)
    if not isinstance(method, MethodSymbol):
        type_arguments(r, node.arguments, env)
        if owner is not None:
            report_unknown_member(r, owner, node.modifier)
        return True
    r.references[node.modifier] = method
    bind_call(r, node, method, node.actor, node.modifier.span, env)
    if method.node is not None and not isinstance(method.node.body, ast.ExternalBody):
        r.relaxes(
            "OSC618",
            node.span,
            f"the result of `{node.actor.span.text}.{node.modifier}()` is not used",
            key=str(node.span.start),
            help="remove the line",
        )
    return True


def _find_plain(
    r: Resolution,
    node: ast.Call | ast.CallDirective,
    callee: ast.NameExpression,
    env: Environment,
) -> MethodSymbol | None:
    symbol = lookup_value(r, callee.name, env)
    word = callee.name.text
    if symbol is None and word in CONDITIONS:
        help_ = f"name it, `event e is {word}(…)`, or wait for one after the other"
        r.report(
            "OSC201",
            callee.span,
            f"`{word}(…)` is an event condition, which is used alone",
            help=help_,
        )
        return None
    if symbol is None and word == "sample":
        help_ = "declare the field with `var`"
        r.report("OSC201", callee.span, "only a variable is sampled", help=help_)
        return None
    named = r.scope.select(r.scope.types_named(word), callee.name, env.context)
    if symbol is None and named and isinstance(named[0], StructSymbol):
        help_ = (
            f"declare a field, `name: {word} with:`, and constrain its members by `keep(it.… == …)`"
        )
        r.report("OSC201", callee.span, f"`{word}` is a struct, not a method", help=help_)
        return None
    if symbol is None:
        r.report(
            "OSC201",
            callee.span,
            f"no method `{callee.name}`",
            help=_method_meant(callee, node) or name_meant(callee.span, visible_names(r, env)),
        )
        return None
    return _as_method(r, callee, symbol)


def _method_meant(callee: ast.NameExpression, node: ast.Call | ast.CallDirective) -> Help:
    """Return the help for `len(list)`, which is a method of its argument."""
    word = callee.name.text
    if word in MEMBERS and node.arguments:
        receiver = node.arguments[0].value.span.text
        return f"methods are called on an object: `{receiver}.{MEMBERS[word]}`"
    if word not in LIST_WORDS or len(node.arguments) != 1:
        return None
    return write(node.span, f"{node.arguments[0].value.span.text}.{LIST_WORDS[word]}()")


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
        owner = _primitive_of(r, callee, base)
    if owner is None:
        r.report(
            "OSC208",
            callee.name.span,
            f"`{base}` has no method `{callee.name}`",
            help=in_newest_version(r, str(base), callee.name) or None,
        )
        return None
    member = find_member(r, owner, callee.name, env.context)
    if member is None:
        report_unknown_member(r, owner, callee.name)
        return None
    note_prelude_member(r, member, owner, callee.name)
    return _as_method(r, callee, member)


def _primitive_of(
    r: Resolution, callee: ast.MemberAccess, base: PrimitiveType
) -> PrimitiveSymbol | None:
    """Return the methods of a primitive type; an integer literal is an `int` where that helps."""
    own = r.scope.primitive_named(base.name)
    if base != UINT or (own is not None and callee.name.text in own.members):
        return own
    signed = r.scope.primitive_named(INT.name)
    is_literal = isinstance(callee.base, ast.IntegerLiteral)
    return signed if is_literal and signed is not None else own


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
            help=plain_word(callee.name.span, LIST_WORDS if isinstance(base, ListType) else {})
            or name_meant(callee.name.span, operators),
        )
        type_arguments(r, node.arguments, env.with_it(ERROR))
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
    for argument in node.arguments:
        if argument.name is not None:
            r.report(
                "OSC402",
                argument.name.span,
                f"`{method.name}` has no parameter `{argument.name}`",
                help="leave the name out",
            )
    if len(node.arguments) > len(method.parameters):
        count = len(method.parameters)
        extra = node.arguments[count]
        r.report("OSC405", extra.span, f"`{method.name}` takes {count or 'no'} argument")
    elif len(node.arguments) < len(method.parameters):
        r.report("OSC404", callee.name.span, f"`{method.name}` lacks its argument")


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
