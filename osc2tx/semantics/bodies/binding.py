"""Binds arguments to parameters (§7.3.5.1.3, §7.3.7)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import dropwhile

from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Help, write
from osc2tx.semantics.assignability import check_value
from osc2tx.semantics.builtins import DURATION
from osc2tx.semantics.conversions import converts
from osc2tx.semantics.declarations.resolve_types import choose
from osc2tx.semantics.model import Binding
from osc2tx.semantics.names.aliases import parameter_alias
from osc2tx.semantics.names.member_lookup import lookup_value, parameters_of
from osc2tx.semantics.names.stray_modifiers import move_out
from osc2tx.semantics.names.unknown_names import report_unknown
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.symbols import (
    ActionSymbol,
    BehaviorSymbol,
    EventSymbol,
    FieldSymbol,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    Symbol,
)
from osc2tx.semantics.types import EnumType, RangeType, Type
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace
from osc2tx_shared.rules import Rule, violations


class _Written(dict[str, ast.Expression]):
    """Arguments by parameter; these rules do not read the values."""

    def word(self, name: str) -> None:
        """No rule looks at words."""

    def bounds(self, name: str) -> None:
        """No rule looks at numbers."""


def check_exclusive(
    r: Resolution,
    callee: Symbol,
    pairs: Sequence[tuple[FieldSymbol | ParameterSymbol, ast.Expression]],
) -> None:
    """Report arguments of a library modifier or action of which only one may be given."""
    given = _Written({parameter.name: value for parameter, value in pairs})
    for rule in _rules(callee):
        if rule.kind == "at_most_one":
            in_order = tuple(name for name in given if name in rule.of)
            if len(in_order) < 2:
                continue
            for broken in violations(f"`{callee.name}`", [replace(rule, of=in_order)], given):
                assert broken.parameter is not None
                r.report("OSC408", given[broken.parameter].span, f"`{callee.name}`: {broken.text}")


def _rules(callee: Symbol) -> Sequence[Rule]:
    if not isinstance(callee, ModifierSymbol | ActionSymbol) or callee.origin == "user":
        return ()
    if isinstance(callee, ActionSymbol):
        action = catalogue().actions.get(callee.qualified_name)
        return () if action is None else action.rules
    modifier = catalogue().modifiers.get(callee.name)
    return () if modifier is None else modifier.rules


Parameter = FieldSymbol | ParameterSymbol
Pairs = tuple[tuple[Parameter, ast.Expression], ...]


def bind_behavior(
    r: Resolution,
    node: ast.Invocation | ast.ModifierApplication,
    callee: BehaviorSymbol,
    env: Environment,
) -> None:
    """Bind the arguments of an invocation or modifier application; any may be left out."""
    parameters: list[Parameter] = list(parameters_of(callee))
    if isinstance(callee, ScenarioSymbol | ActionSymbol):
        parameters.append(DURATION)
    pairs = _match(r, node, parameters, callee, env)
    named = {argument.value for argument in node.arguments if argument.name is not None}
    for parameter, value in pairs:
        check_value(
            r,
            value,
            parameter.type,
            env,
            f"`{parameter.name}`",
            allow_range=True,
            advise=None if value in named else partial(_meant, node, callee, value),
        )
    check_exclusive(r, callee, pairs)
    r.bindings[node] = Binding(callee, node.actor, pairs)


def _meant(
    node: ast.Invocation | ast.ModifierApplication,
    callee: BehaviorSymbol,
    value: ast.Expression,
    given: Type,
) -> Help:
    """Return the help for a positional argument that does not fit the first parameter.

    It names the only other parameter that it fits, or the modifier of the action that states such a
    value: `drive(50kph)`.
    """
    written = {argument.name.text for argument in node.arguments if argument.name is not None}
    parameters = (each for each in parameters_of(callee) if each.name not in written)
    fitting = [each for each in parameters if _takes(each.type, value, given)]
    fitting = [each for each in fitting if each.type == given] or fitting
    if len(fitting) == 1:
        return write(value.span, f"{fitting[0].name}: {value.span.text}", is_safe=False)
    name = str(given)
    action = catalogue().actions.get(callee.qualified_name)
    if action is None or name not in action.modifiers or not isinstance(node, ast.Invocation):
        return None
    return move_out(node, value, name)


def _takes(parameter: Type, value: ast.Expression, given: Type) -> bool:
    if isinstance(parameter, EnumType):
        return value.span.text in parameter.symbol.members
    return converts(given, parameter)


def bind_call(
    r: Resolution,
    node: ast.Call | ast.CallDirective | ast.EmitDirective | ast.ModifierApplication,
    callee: MethodSymbol | EventSymbol,
    receiver: ast.Expression | None,
    span: Span,
    env: Environment,
) -> None:
    """Bind the arguments of a method call or an emit; those without default are required."""
    if isinstance(callee, EventSymbol) and callee.is_implicit:
        type_arguments(r, node.arguments, env)
        r.bindings[node] = Binding(callee, receiver, ())
        return
    pairs = _match(r, node, list(callee.parameters), callee, env)
    for parameter, value in pairs:
        type_ = r.type_of(value, env, parameter.type)
        if isinstance(type_, RangeType) and not isinstance(parameter.type, RangeType):
            r.report("OSC409", value.span, f"`{parameter.name}` takes one value, not a range")
            continue
        check_value(r, value, parameter.type, env, f"`{parameter.name}`")
    given = {parameter for parameter, _ in pairs}
    known = {p.name for p in callee.parameters}
    misnamed = any(a.name is not None and a.name.text not in known for a in node.arguments)
    misnamed |= bool(misplaced_of(node.arguments))
    for required in callee.parameters:
        if required not in given and not _has_default(required) and not misnamed:
            r.report(
                "OSC404",
                span,
                f"`{callee.name}` lacks its argument `{required.name}`",
                labels=declared_here(required),
            )
    r.bindings[node] = Binding(callee, receiver, pairs)


def _has_default(parameter: ParameterSymbol) -> bool:
    return parameter.default is not None


def type_arguments(r: Resolution, arguments: Sequence[ast.Argument], env: Environment) -> None:
    """Type the arguments of a call whose callee is unknown, to find mistakes inside them."""
    for argument in arguments:
        if not isinstance(argument.value, ast.NameExpression):
            r.type_of(argument.value, env)


def _match(
    r: Resolution,
    node: (
        ast.Invocation | ast.ModifierApplication | ast.Call | ast.CallDirective | ast.EmitDirective
    ),
    parameters: Sequence[Parameter],
    callee: Symbol,
    env: Environment,
) -> Pairs:
    """Pair arguments with parameters in source order; report arguments without a parameter."""
    arguments = node.arguments
    pairs: list[tuple[Parameter, ast.Expression]] = []
    taken: set[Parameter] = set()
    implied: list[tuple[Parameter, ast.Expression]] = []
    unknown: dict[ast.Name, ast.Expression] = {}
    misplaced = misplaced_of(arguments)
    positional = _positional(parameters, callee)
    for index, argument in enumerate(arguments):
        parameter: Parameter | None
        if argument in misplaced:
            type_arguments(r, [argument], env)
            continue
        if argument.name is not None:
            parameter = _find_named(r, argument.name, parameters, callee, env)
            if parameter is None:
                parameter = _find_alias(r, argument.name, parameters, callee, implied)
            if parameter is None:
                unknown[argument.name] = argument.value
        else:
            parameter = positional[index] if index < len(positional) else None
            if parameter is None:
                _report_too_many(r, argument, parameters, callee)
            else:
                _note_prelude(r, parameter, callee, argument.span)
        if parameter is None:
            type_arguments(r, [argument], env)
        elif _is_left_out(r, argument, env):
            taken.add(parameter)
        elif parameter in taken:
            r.report("OSC403", argument.span, f"`{parameter.name}` is given twice")
            type_arguments(r, [argument], env)
        else:
            taken.add(parameter)
            pairs.append((parameter, argument.value))
    report_unknown(r, unknown, parameters, callee, node)
    for parameter, value in implied:
        if parameter in taken:
            r.report("OSC403", value.span, f"`{parameter.name}` is given twice")
        else:
            taken.add(parameter)
            pairs.append((parameter, value))
    return tuple(pairs)


def _is_left_out(r: Resolution, argument: ast.Argument, env: Environment) -> bool:
    """Whether an argument has the value `None`, as ScenarioRunner's users write it."""
    value = argument.value
    return (
        isinstance(value, ast.NameExpression)
        and value.span.text == "None"
        and lookup_value(r, value.name, env, quiet=True) is None
        and r.relaxes(
            "OSC627",
            argument.span,
            "`None` is no value; the argument is taken as omitted",
            key=argument.span.text,
            help=f"leave `{argument.span.text}` out",
        )
    )


def _positional(parameters: Sequence[Parameter], callee: Symbol) -> Sequence[Parameter]:
    """Return the parameters that have a place; `duration` has one in the library's actions."""
    if callee.origin != "user":
        return parameters
    return [parameter for parameter in parameters if parameter is not DURATION]


def misplaced_of(arguments: Sequence[ast.Argument]) -> set[ast.Argument]:
    """Return the positional arguments that follow named ones; the parser has reported them."""
    following = dropwhile(lambda argument: argument.name is None, arguments)
    return {argument for argument in following if argument.name is None}


def _find_alias(
    r: Resolution,
    name: ast.Name,
    parameters: Sequence[Parameter],
    callee: Symbol,
    implied: list[tuple[Parameter, ast.Expression]],
) -> Parameter | None:
    """Return the parameter that another name denotes; add the arguments that the name implies."""
    named = {p.name: p for p in parameters}
    alias = parameter_alias(r, callee, name, named)
    if alias is None:
        return None
    if alias.implied is not None:
        parameter, member = alias.implied
        value = ast.NameExpression(span=name.span, name=ast.Name(span=name.span, text=member))
        implied.append((named[parameter], value))
    r.references[name] = named[alias.parameter]
    return named[alias.parameter]


def _report_too_many(
    r: Resolution, argument: ast.Argument, parameters: Sequence[Parameter], callee: Symbol
) -> None:
    count = len([p for p in parameters if p is not DURATION])
    r.report(
        "OSC405",
        argument.span,
        f"`{callee.name}` takes {count or 'no'} argument{'' if count == 1 else 's'}",
        labels=declared_here(callee),
    )


def _find_named(
    r: Resolution,
    name: ast.Name,
    parameters: Sequence[Parameter],
    callee: Symbol,
    env: Environment,
) -> Parameter | None:
    parameter = find_parameter(r, name, parameters, env)
    if parameter is None:
        return None
    r.references[name] = parameter
    _note_prelude(r, parameter, callee, name.span)
    return parameter


def find_parameter(
    r: Resolution, name: ast.Name, parameters: Sequence[Parameter], env: Environment
) -> Parameter | None:
    """Return the parameter of a name; its name has a namespace as any other (§7.7.4)."""
    named = [p for p in parameters if p.name == name.text]
    if name.namespace is None and any(p.origin == "builtin" for p in named):
        return named[0]
    visible = r.scope.select(named, name, env.context)
    if visible or name.namespace is not None:
        return next(iter(visible), None)
    return choose(r, named, name, env.context)


def _note_prelude(r: Resolution, parameter: Parameter, callee: Symbol, span: Span) -> None:
    if parameter.origin == "prelude" and callee.origin == "library":
        r.relaxes(
            "OSC608",
            span,
            f"parameter `{parameter.name}` of `{callee.name}` belongs to dialect "
            f"`{r.relaxations.dialect.name}`, not to the standard library",
            key=callee.name,
        )
