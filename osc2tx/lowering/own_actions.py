"""Actions that the scenario's own files declare; a package of the user carries them out.

The declaration is what counts: a value that an invocation leaves out is the default of the
declaration, whatever the default of the Python class.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast


def is_own(action: sym.ActionSymbol) -> bool:
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
    arguments = []
    for parameter in _parameters(action):
        default = parameter.default
        if parameter.name in names or default is None or isinstance(default, ast.SampleExpression):
            continue
        value = _lower_default(ctx, default, actor)
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


def _lower_default(
    ctx: LoweringContext, default: ast.Expression, actor: ir.Expression
) -> ir.Expression | None:
    symbol = ctx.model.symbol_of(default)
    if isinstance(symbol, sym.FieldSymbol):
        if symbol.node is None and symbol.name == "actor":
            return actor
        if isinstance(symbol.owner, sym.ActionSymbol):
            ctx.unsupported(
                "OSC503", default.span, "a default cannot be another parameter of the action yet"
            )
            return None
    return lower_expression(ctx, default)
