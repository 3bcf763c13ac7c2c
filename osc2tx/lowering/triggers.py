"""Event specifications and conditions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

MOMENTS = {moment.value: moment for moment in ir.Moment}


def lower_trigger(
    ctx: LoweringContext, node: ast.EventSpecification, comments: tuple[str, ...] = ()
) -> ir.Trigger | None:
    """Lower an event specification; `None` if a part of it was refused."""
    event = None if node.event is None else _lower_event(ctx, node.event)
    if node.field is not None:
        if not isinstance(event, ir.EventRef):
            ctx.unsupported("OSC506", node.field.span, "`as` is not supported for this event yet")
            return None
        ctx.event_fields[id(ctx.model.symbol_of(node.field))] = event.name
    condition = None if node.condition is None else _lower_condition(ctx, node.condition)
    if (node.event is None) != (event is None) or (node.condition is None) != (condition is None):
        return None
    return ir.Trigger(span=node.span, event=event, condition=condition, comments=comments)


def _lower_event(
    ctx: LoweringContext, path: ast.Expression
) -> ir.EventRef | ir.LabelEvent | ir.InnerEvent | None:
    symbol = ctx.model.symbol_of(path)
    if isinstance(path, ast.MemberAccess) and path.name.text in MOMENTS:
        base = ctx.model.symbol_of(path.base)
        if isinstance(base, sym.LabelSymbol) and isinstance(base.node, ast.EmitDirective):
            ctx.unsupported(
                "OSC506",
                path.span,
                f"`{base.name}` labels an `emit`, which takes no time",
                help=f"wait for the event itself, `@{base.node.event}`",
            )
            return None
        if isinstance(base, sym.LabelSymbol):
            moment = MOMENTS[path.name.text]
            return ir.LabelEvent(span=path.span, label=base.name, moment=moment)
    if isinstance(symbol, sym.EventSymbol) and isinstance(path, ast.MemberAccess):
        label = ctx.model.symbol_of(path.base)
        if isinstance(label, sym.LabelSymbol) and isinstance(symbol.owner, sym.ScenarioSymbol):
            return ir.InnerEvent(span=path.span, label=label.name, name=symbol.name)
    if isinstance(symbol, sym.EventSymbol) and isinstance(path, ast.NameExpression):
        if not declares_event(symbol):
            ctx.unsupported("OSC506", path.span, f"`@{symbol.name}` cannot be waited for yet")
            return None
        return ir.EventRef(span=path.span, name=symbol.name)
    ctx.unsupported("OSC506", path.span, f"event `{path.span.text}` cannot be waited for yet")
    return None


def _lower_condition(ctx: LoweringContext, node: ast.EventCondition) -> ir.Condition | None:
    main = lower_expression(ctx, _main_expression(node))
    if main is None:
        return None
    match node:
        case ast.LevelCondition():
            return ir.Level(span=node.span, expression=main)
        case ast.RiseCondition() | ast.FallCondition():
            rising = isinstance(node, ast.RiseCondition)
            return ir.Edge(span=node.span, rising=rising, expression=main)
        case ast.ElapsedCondition():
            main = (
                ctx.draw("wait time", main, main.lower.type)
                if isinstance(main, ir.RangeValue)
                else main
            )
            return ir.Elapsed(span=node.span, duration=main)
        case ast.EveryCondition(offset=offset):
            shift = None if offset is None else lower_expression(ctx, offset)
            return ir.Every(span=node.span, period=main, offset=shift)
        case _:
            assert_never(node)


def _main_expression(node: ast.EventCondition) -> ast.Expression:
    match node:
        case ast.ElapsedCondition(duration=duration):
            return duration
        case ast.EveryCondition(period=period):
            return period
        case _:
            return node.expression


def declares_event(symbol: sym.Symbol | None) -> bool:
    """Whether an event belongs to the scenario: declared, or made by its use in a dialect."""
    return isinstance(symbol, sym.EventSymbol) and (symbol.node is not None or symbol.is_implicit)


def lower_until(ctx: LoweringContext, members: Sequence[ast.WithMember]) -> tuple[ir.Trigger, ...]:
    """Lower the `until`s of a `with` block; the first of them ends the member."""
    return present(
        [
            lower_trigger(ctx, member.event, statement_comments(member))
            for member in members
            if isinstance(member, ast.UntilDirective)
        ]
    )
