"""User-defined modifiers as functions of their parameters.

An application is replaced by modifiers of the library (`user_modifiers`), which are the meaning of
the program. Here its body is lowered once, in terms of its parameters, for back ends that can write
it as a function. A modifier has no function if its body depends on more than its parameters: on the
modified action (`it`), on its actor, on global parameters, or on a value that is drawn at each
application. Constraints are not part of a function: they belong to the scenario.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from osc2tx import ir
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.lowering.constraints.parameter_domains import as_type
from osc2tx.lowering.context import (
    LoweringContext,
    comments_around,
    present,
    stated_keeps,
    statement_comments,
)
from osc2tx.lowering.modifiers.modifiers import lower_modifier
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.arguments import lower_arguments
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

OF_THE_SCENARIO = (
    ir.FieldRef,
    ir.ScenarioSelf,
    ir.InvokedValue,
    ir.EventArgument,
    ir.UserShape,
)
"""Members that only a scenario can have."""


def modifier_key(modifier: sym.ModifierSymbol) -> str:
    """Return the key of a modifier, which differs from others of the same name."""
    return f"modifier {modifier.span.source.name}:{modifier.span.start}"


def parameters_of(modifier: sym.ModifierSymbol) -> Iterator[sym.FieldSymbol]:
    """Yield the parameters of a modifier, in source order."""
    for member in modifier.members.values():
        if isinstance(member, sym.FieldSymbol) and not member.is_variable:
            yield member


def lower_modifiers(
    ctx: LoweringContext, modifiers: Iterable[sym.ModifierSymbol]
) -> tuple[ir.UserModifier, ...]:
    """Return those modifiers that are functions, and those that they apply."""
    functions = _Functions(ctx)
    for modifier in modifiers:
        functions.of(modifier)
    return functions.found()


def own_modifiers(model: SemanticModel) -> Iterator[sym.ModifierSymbol]:
    """Yield the modifiers that the root file declares."""
    modifiers = (each for each in model.symbols if isinstance(each, sym.ModifierSymbol))
    return (each for each in modifiers if each.span.source is model.root.span.source)


class _Functions:
    """The functions made so far; `None` for a modifier without one, or not yet with one."""

    def __init__(self, ctx: LoweringContext) -> None:
        self._ctx = ctx
        self._found: dict[sym.ModifierSymbol, ir.UserModifier | None] = {}

    def found(self) -> tuple[ir.UserModifier, ...]:
        return present(list(self._found.values()))

    def of(self, modifier: sym.ModifierSymbol) -> ir.UserModifier | None:
        if modifier not in self._found:
            self._found[modifier] = None  # while its body is looked at: it may apply itself
            self._found[modifier] = self._lower(modifier)
        return self._found[modifier]

    def _lower(self, modifier: sym.ModifierSymbol) -> ir.UserModifier | None:
        place = Place(model=self._ctx.model, owner=modifier, prefix=(), it=None)
        ctx = self._ctx.quiet().at(place)
        ctx.state.given = {}  # its parameters have no values of an invocation
        parameters = []
        for field in parameters_of(modifier):
            parameters.append(self._parameter(ctx, field))
            type_ = parameters[-1].type
            reference = ir.ParameterRef(span=field.span, type=type_, name=field.name)
            ctx.state.given[(field,)] = reference
        applications = [s for s in modifier.statements if isinstance(s, ast.ModifierApplication)]
        calls = [call for each in applications for call in self._calls(ctx, each)]
        values = [argument.value for call in calls for argument in _arguments(call)]
        parts = [part for value in values for part in ir.walk(value)]
        is_open = any(isinstance(part, OF_THE_SCENARIO) for part in parts)
        if not calls or ctx.state.drawn or ctx.sink.has_errors or is_open:
            return None
        return ir.UserModifier(
            name=modifier.name,
            key=modifier_key(modifier),
            span=modifier.span,
            parameters=tuple(parameters),
            calls=tuple(calls),
            comments=statement_comments(modifier.node),
            keeps=tuple(stated_keeps(modifier.statements)),
        )

    def _parameter(self, ctx: LoweringContext, field: sym.FieldSymbol) -> ir.MethodParameter:
        default = field.default
        value = None
        if default is not None and not isinstance(default, ast.SampleExpression):
            value = lower_expression(ctx.quiet(), default)
        if value is not None and not isinstance(value, ir.Literal | ir.Quantity | ir.EnumValue):
            value = None  # Python would look at it once, before there are parameters
        return ir.MethodParameter(
            name=field.name,
            type=lower_type(field.type),
            default=None if value is None else as_type(value, field.type),
            comments=_comments_of(field),
        )

    def _calls(
        self, ctx: LoweringContext, node: ast.ModifierApplication
    ) -> Iterator[ir.ModifierCall]:
        binding = ctx.model.binding_of(node)
        callee = binding.callee
        assert isinstance(callee, sym.ModifierSymbol)
        if callee.origin != "user":
            yield lower_modifier(ctx, node, callee.name)
            return
        inner = self.of(callee)
        if inner is None:
            ctx.unsupported("OSC508", node.span, "applies a modifier that is no function")
            return
        types = {parameter.name: parameter.type for parameter, _ in binding.arguments}
        given = tuple(
            replace(each, value=as_type(each.value, types[each.parameter]))
            for each in lower_arguments(ctx, binding, node.arguments)
        )
        application = ir.Application(span=node.span, key=inner.key, arguments=given)
        values = {p.name: p.default for p in inner.parameters if p.default is not None}
        values |= {argument.parameter: argument.value for argument in given}
        if any(parameter.name not in values for parameter in inner.parameters):
            ctx.unsupported("OSC501", node.span, "leaves a parameter to constraints")
            return
        first, *others = (
            replace(call, applied=(application, *call.applied))
            for call in ir.applied_with(inner.calls, values)
        )
        yield replace(first, comments=(*statement_comments(node), *first.comments))
        yield from others


def _comments_of(field: sym.FieldSymbol) -> tuple[str, ...]:
    """Return the comment lines of a parameter, and its constraints as the source has them."""
    node = field.node
    if node is None or node.names[0].span != field.span:
        return ()
    rules = node.constraints if isinstance(node, ast.ParameterDeclaration) else ()
    return comments_around(statement_comments(node), stated_keeps(rules))


def _arguments(call: ir.ModifierCall) -> Iterator[ir.Argument]:
    yield from call.arguments
    for application in call.applied:
        yield from application.arguments


def application_of(
    modifier: sym.ModifierSymbol,
    node: ast.ModifierApplication,
    values: Mapping[sym.FieldSymbol, ir.Expression],
) -> ir.Application:
    """Return the application of a modifier with such values of its parameters."""
    arguments = (
        ir.Argument(parameter=field.name, value=values[field], is_positional=False, span=node.span)
        for field in parameters_of(modifier)
        if field in values
    )
    return ir.Application(span=node.span, key=modifier_key(modifier), arguments=tuple(arguments))
