"""Event specifications and conditions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from osc2tx import ir
from osc2tx.ir.source_text import condensed
from osc2tx.lowering.behavior.composed_behaviors import is_composed, scenario_key
from osc2tx.lowering.context import LoweringContext, Receiver, present, statement_comments
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.lowering.values.range_bounds import with_bounds
from osc2tx.lowering.values.references import path_of
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

BOUNDARIES = frozenset({"start", "end"})
WHOLE = "do"
"""Label of all that a scenario does, where something reacts to its failure."""
MOMENTS = {moment.value: moment for moment in ir.Moment}


def lower_trigger(
    ctx: LoweringContext, node: ast.EventSpecification, comments: tuple[str, ...] = ()
) -> ir.Trigger | None:
    """Lower an event specification; `None` if a part of it was refused."""
    event = None if node.event is None else _lower_event(ctx, node.event)
    if node.field is not None and event is not None:
        ctx.state.event_fields[id(ctx.model.symbol_of(node.field))] = _origin_of(
            ctx, node.event, event
        )
    condition = None if node.condition is None else _lower_condition(ctx, node.condition)
    if (node.event is None) != (event is None) or (node.condition is None) != (condition is None):
        return None
    return ir.Trigger(span=node.span, event=event, condition=condition, comments=comments)


def boundary_of(ctx: LoweringContext, event: ast.EventSpecification) -> str | None:
    """Return `start` or `end` if a specification is that of the behavior itself.

    In a modifier that is the modified behavior, `it`.
    """
    path = event.event
    symbol = None if path is None else ctx.model.symbol_of(path)
    is_of_it = isinstance(path, ast.MemberAccess) and isinstance(path.base, ast.ItExpression)
    is_plain = (isinstance(path, ast.NameExpression) or is_of_it) and event.condition is None
    if not is_plain or not isinstance(symbol, sym.EventSymbol) or declares_event(symbol):
        return None
    return symbol.name if symbol.name in BOUNDARIES else None


def is_own_failure(ctx: LoweringContext, path: ast.Expression | None) -> bool:
    """Whether a path names the life-cycle event `fail` of the scenario itself."""
    symbol = ctx.model.symbol_of(path) if isinstance(path, ast.NameExpression) else None
    is_fail = isinstance(symbol, sym.EventSymbol) and symbol.name == ir.Moment.FAIL.value
    return is_fail and not declares_event(symbol)


def _origin_of(
    ctx: LoweringContext,
    path: ast.Expression | None,
    event: ir.EventRef | ir.LabelEvent | ir.InnerEvent,
) -> tuple[str, str | None]:
    """Return the name of an event, and the key of the invoked scenario that has it, if one has."""
    match event:
        case ir.EventRef(name=name):
            return name, None
        case ir.InnerEvent(label=label, name=name):
            assert isinstance(path, ast.MemberAccess), "events of invoked scenarios have labels"
            invoked = _invoked_by(ctx, _labels(ctx, path.base)[-1])
            return f"{label}.{name}", scenario_key(invoked) if is_composed(invoked) else None
        case ir.LabelEvent(label=label, moment=moment):
            return f"{label}.{moment.value}", None


def _lower_event(
    ctx: LoweringContext, path: ast.Expression
) -> ir.EventRef | ir.LabelEvent | ir.InnerEvent | None:
    symbol = ctx.model.symbol_of(path)
    if isinstance(path, ast.MemberAccess):
        labels = _labels(ctx, path.base)
        is_moment = path.name.text in MOMENTS and not declares_event(symbol)
        if labels and (is_moment or isinstance(symbol, sym.EventSymbol)):
            return _event_below(ctx, path, labels, is_moment=is_moment)
    if isinstance(symbol, sym.EventSymbol) and isinstance(
        symbol.owner, sym.ActorSymbol | sym.StructSymbol
    ):
        return event_of_object(ctx, path, symbol)
    if isinstance(symbol, sym.EventSymbol) and isinstance(path, ast.NameExpression):
        if declares_event(symbol):
            return ir.EventRef(span=path.span, name=ctx.attached.get(symbol, symbol.name))
        if is_own_failure(ctx, path):
            return ir.LabelEvent(span=path.span, label=WHOLE, moment=ir.Moment.FAIL)
        ctx.unsupported(
            "OSC506",
            path.span,
            f"`@{symbol.name}` of the scenario itself cannot be waited for here",
            help="inside the scenario its start is past and its end is ahead: use `on @start` or "
            "`on @end`, without `if`, or label the members, `@label.end`",
        )
        return None
    ctx.unsupported("OSC506", path.span, f"event `{path.span.text}` cannot be waited for yet")
    return None


def _labels(ctx: LoweringContext, base: ast.Expression) -> tuple[sym.LabelSymbol, ...]:
    """Return the labels of a path, `p1.cut`; nothing if something else is in it.

    A label inside a composition belongs to the scenario as well: the composition's is left out.
    """
    found: list[sym.LabelSymbol] = []
    current: ast.Expression | None = base
    while current is not None:
        symbol = ctx.model.symbol_of(current)
        if not isinstance(symbol, sym.LabelSymbol):
            return ()
        if not found or not isinstance(symbol.node, ast.Composition):
            found.append(symbol)
        current = current.base if isinstance(current, ast.MemberAccess) else None
    return tuple(reversed(found))


def _event_below(
    ctx: LoweringContext,
    path: ast.MemberAccess,
    labels: tuple[sym.LabelSymbol, ...],
    *,
    is_moment: bool,
) -> ir.EventRef | ir.LabelEvent | ir.InnerEvent | None:
    """Return an event of a labelled member, or of one inside of it."""
    last = labels[-1]
    if is_moment and isinstance(last.node, ast.EmitDirective):
        ctx.unsupported(
            "OSC506",
            path.span,
            f"`{last.name}` labels an `emit`, which takes no time",
            help=f"wait for the event itself, `@{last.node.event}`",
        )
        return None
    symbol = ctx.model.symbol_of(path)
    if len(labels) == 1 and isinstance(symbol, sym.EventSymbol) and _is_of_action(symbol):
        return ir.EventRef(span=path.span, name=f"{last.name}.{symbol.name}")
    invoked = labels[:-1] if is_moment else labels
    if not all(is_composed(_invoked_by(ctx, label)) for label in invoked):
        ctx.unsupported(
            "OSC506",
            path.span,
            f"nothing makes `@{path.span.text}` occur",
            help="events of an action are its `start`, `end` and `fail`",
        )
        return None
    first, *inner = (label.name for label in labels)
    if is_moment and not inner:
        return ir.LabelEvent(span=path.span, label=first, moment=MOMENTS[path.name.text])
    return ir.InnerEvent(span=path.span, label=first, name=".".join([*inner, path.name.text]))


def _is_of_action(symbol: sym.EventSymbol) -> bool:
    """Whether `extend` adds an event to an action of the library."""
    is_action = isinstance(symbol.owner, sym.ActionSymbol) and symbol.owner.origin != "user"
    return is_action and declares_event(symbol)


def _invoked_by(ctx: LoweringContext, label: sym.LabelSymbol) -> sym.Symbol | None:
    binding = ctx.model.bindings.get(label.node)
    return None if binding is None else binding.callee


def event_of_object(
    ctx: LoweringContext, path: ast.Expression, symbol: sym.EventSymbol
) -> ir.EventRef | None:
    """Return an event that an actor or struct declares, as an event of the scenario."""
    object_: ir.Expression | None
    if isinstance(path, ast.MemberAccess):
        object_ = lower_expression(ctx, path.base)
    else:
        object_ = None if ctx.receiver is None else ctx.receiver.value
    if object_ is None:
        return None
    name = f"{path_of(object_) or condensed(object_.span.text)}.{symbol.name}"
    if name not in ctx.state.object_events:
        ctx.state.object_events[name] = None  # while its own specification is looked at
        ctx.state.object_events[name] = _declared(ctx, symbol, object_, name)
    return ir.EventRef(span=path.span, name=name)


def _declared(
    ctx: LoweringContext, symbol: sym.EventSymbol, object_: ir.Expression, name: str
) -> ir.Event:
    node, owner = symbol.node, symbol.owner
    assert isinstance(owner, sym.ActorSymbol | sym.StructSymbol)
    inside = ctx.inside(Receiver(owner, object_))
    specification = None if node is None else node.specification
    return ir.Event(
        name=name,
        span=symbol.span,
        comments=() if node is None else statement_comments(node),
        trigger=None if specification is None else lower_trigger(inside, specification),
        is_implicit=False,
        parameters=tuple(event_parameter(inside, p) for p in symbol.parameters),
    )


def event_parameter(ctx: LoweringContext, parameter: sym.ParameterSymbol) -> ir.MethodParameter:
    """Lower a parameter of an event."""
    default = parameter.default
    return ir.MethodParameter(
        name=parameter.name,
        type=lower_type(parameter.type),
        default=None if default is None else lower_expression(ctx, default),
    )


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
            main = with_bounds(main)
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
