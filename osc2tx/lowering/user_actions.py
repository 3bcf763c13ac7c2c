"""Actions that the scenario's own files declare; a package of the user carries them out.

The declaration is what counts: a value that an invocation leaves out is the default of the
declaration, whatever the default of the Python class.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from osc2tx import ir
from osc2tx.analysis.parameter_lookup import Place
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast


def is_user_defined(action: sym.ActionSymbol) -> bool:
    """Whether an action comes neither from the library nor from the prelude of a dialect."""
    return action.origin == "user"


def default_arguments(
    ctx: LoweringContext,
    action: sym.ActionSymbol,
    given: tuple[ir.Argument, ...],
    actor: ir.Expression,
    node: ast.Invocation,
) -> tuple[ir.Argument, ...]:
    """Return what an invocation leaves to the defaults of the declaration, bases first.

    Args:
        ctx: The checked program.
        action: What is invoked.
        given: Its arguments.
        actor: Who acts: a default may be `actor`.
        node: The invocation; its constraints may speak of the defaults from now on.
    """
    names = {argument.parameter for argument in given}
    place = Place(model=ctx.model, owner=action, prefix=(node,), it=(node,))
    inside = replace(ctx.at(place), actor=actor)
    arguments = []
    for parameter in _in_order_of_use(ctx, list(_parameters(action))):
        default = parameter.default
        if parameter.name in names or default is None or isinstance(default, ast.SampleExpression):
            continue
        value = lower_expression(inside, default)
        if value is not None:
            ctx.given.setdefault((node, parameter), value)
            arguments.append(
                ir.Argument(
                    parameter=parameter.name, value=value, is_positional=False, span=node.span
                )
            )
    return tuple(arguments)


def _parameters(action: sym.ActionSymbol) -> Iterator[sym.FieldSymbol]:
    if action.base is not None:
        yield from _parameters(action.base)
    for member in action.members.values():
        if isinstance(member, sym.FieldSymbol) and not member.is_variable:
            yield member


def _in_order_of_use(
    ctx: LoweringContext, parameters: list[sym.FieldSymbol]
) -> Iterator[sym.FieldSymbol]:
    """Yield parameters in their order, but each after those that its default reads."""
    pending = list(parameters)
    while pending:
        ready = (p for p in pending if not _read_by(ctx, p) & set(pending))
        chosen = next(ready, None)
        if chosen is None:
            names = ", ".join(f"`{parameter.name}`" for parameter in pending)
            ctx.unsupported("OSC511", pending[0].span, f"defaults go round in a circle: {names}")
            return
        pending.remove(chosen)
        yield chosen


def _read_by(ctx: LoweringContext, parameter: sym.FieldSymbol) -> set[sym.Symbol | None]:
    default = parameter.default
    if default is None or isinstance(default, ast.SampleExpression):
        return set()
    return {ctx.model.symbol_of(node) for node in nodes_below(default)}
