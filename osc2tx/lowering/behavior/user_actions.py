"""Actions that the files of a scenario declare; a package of the user implements them.

The declaration decides: an omitted argument has the default of the declaration, not that of the
Python class.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from osc2tx import ir
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.catalogue import catalogue
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

MOVEMENT = "action_for_movable_object"
"""Base of all actions of the library that modifiers of movement may be applied to."""


def is_user_defined(action: sym.ActionSymbol) -> bool:
    """Whether an action comes neither from the library nor from the prelude of a dialect."""
    return action.origin == "user"


def lower_actions(
    ctx: LoweringContext, actions: Iterable[sym.ActionSymbol]
) -> tuple[ir.UserAction, ...]:
    """Return the declarations of the invoked user-defined actions."""
    return tuple(
        _lower_action(ctx, action) for action in dict.fromkeys(actions) if is_user_defined(action)
    )


def _lower_action(ctx: LoweringContext, action: sym.ActionSymbol) -> ir.UserAction:
    bases = [action]
    while (base := bases[-1].base) is not None:
        bases.append(base)
    known = catalogue().actions
    return ir.UserAction(
        name=action.name,
        owner=None if action.actor is None else action.actor.name,
        span=action.span,
        comments=statement_comments(action.node),
        parameters=tuple(
            ir.ActionParameter(
                name=p.name,
                type=lower_type(p.type),
                has_default=p.default is not None,
                default=_constant_default(ctx, p),
                comments=() if p.node is None else statement_comments(p.node),
            )
            for p in _parameters(action)
            if p.node is not None
        ),
        takes_modifiers=any(base.name == MOVEMENT for base in bases),
        base=next((base.name for base in bases if base.qualified_name in known), None),
    )


def _constant_default(ctx: LoweringContext, parameter: sym.FieldSymbol) -> ir.Expression | None:
    """Return the default of a parameter if it is one value for all actors and arguments."""
    default = parameter.default
    if default is None or isinstance(default, ast.SampleExpression):
        return None
    value = lower_expression(ctx.quiet(), default)
    return value if isinstance(value, ir.Literal | ir.Quantity | ir.EnumValue) else None


def default_arguments(
    ctx: LoweringContext,
    action: sym.ActionSymbol,
    given: tuple[ir.Argument, ...],
    actor: ir.Expression | None,
    node: ast.Invocation,
) -> tuple[ir.Argument, ...]:
    """Return the arguments that an invocation leaves to defaults of the declaration, bases first.

    Args:
        ctx: The checked program.
        action: The invoked action.
        given: Its arguments.
        actor: The actor, if there is one: a default may be `actor`.
        node: The invocation; its constraints may refer to the defaults from now on.
    """
    names = {argument.parameter for argument in given}
    place = Place(model=ctx.model, owner=action, prefix=(node,), it=(node,))
    inside = ctx.at(place).with_actor(actor)
    arguments = []
    for parameter in _in_order_of_use(ctx, list(_parameters(action))):
        default = parameter.default
        if parameter.name in names or default is None or isinstance(default, ast.SampleExpression):
            continue
        value = lower_expression(inside, default)
        if value is not None:
            ctx.state.given.setdefault((node, parameter), value)
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
            ctx.unsupported("OSC511", pending[0].span, f"circular defaults: {names}")
            return
        pending.remove(chosen)
        yield chosen


def _read_by(ctx: LoweringContext, parameter: sym.FieldSymbol) -> set[sym.Symbol | None]:
    default = parameter.default
    if default is None or isinstance(default, ast.SampleExpression):
        return set()
    return {ctx.model.symbol_of(node) for node in nodes_below(default)}
