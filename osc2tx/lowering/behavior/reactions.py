"""Reactions of `on` directives, and those that modifiers and extensions attach to a behavior."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field

from osc2tx import ir
from osc2tx.ir.source_text import condensed, statement_name
from osc2tx.lowering.behavior.triggers import (
    boundary_of,
    declares_event,
    event_parameter,
    lower_trigger,
)
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.arguments import lower_arguments
from osc2tx.lowering.values.calls import lower_call
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace

# Life-cycle events that a scenario may emit, and whether it succeeds then.
FINISHING = {"end": True, "fail": False}


def lower_on(ctx: LoweringContext, node: ast.OnDirective) -> ir.On | None:
    """Lower an `on` directive; its reactions take no time."""
    trigger = lower_trigger(ctx, node.event)
    found = lower_reactions(ctx, node)
    if trigger is None or not found:
        return None
    return ir.On(
        span=node.span,
        label=None,
        name=f"on {condensed(node.event.span.text)}",
        comments=statement_comments(node),
        trigger=trigger,
        reactions=found,
    )


def lower_reactions(
    ctx: LoweringContext, node: ast.OnDirective
) -> tuple[ir.Emit | ir.Finish | ir.Call, ...]:
    """Return the reactions of an `on` directive, without its comments."""
    found: list[ir.Emit | ir.Finish | ir.Call | None] = []
    for member in node.members:
        if isinstance(member, ast.EmitDirective):
            found.append(lower_emit(ctx, member))
        else:
            found.append(lower_call_directive(ctx, member))
    return present(found)


def at_boundary(
    ctx: LoweringContext, statements: Iterable[ast.Statement], moment: str
) -> tuple[ir.Behavior, ...]:
    """Return the reactions to the start or end of a behavior: they frame the body.

    Events that are specified as this instant, `event begun is @start`, precede reactions.
    """
    emitted: list[ir.Behavior] = []
    done: list[ir.Behavior] = []
    for node in statements:
        if isinstance(node, ast.EventDeclaration) and _is_at(ctx, node.specification, moment):
            event = ir.EventRef(span=node.name.span, name=_name_of(ctx, node))
            name = f"emit {node.name}"
            emitted.append(
                ir.Emit(span=node.span, label=None, name=name, event=event, arguments=())
            )
        elif isinstance(node, ast.OnDirective) and _is_at(ctx, node.event, moment):
            found: list[ir.Behavior] = list(lower_reactions(ctx, node))
            if found:
                comments = (*statement_comments(node), *found[0].comments)
                found[0] = replace(found[0], comments=comments)
            done += found
    return (*emitted, *done)


def _is_at(ctx: LoweringContext, node: ast.EventSpecification | None, moment: str) -> bool:
    return node is not None and boundary_of(ctx, node) == moment


def _name_of(ctx: LoweringContext, node: ast.EventDeclaration) -> str:
    events = (
        (each, name) for each, name in ctx.attached.items() if isinstance(each, sym.EventSymbol)
    )
    return next((name for each, name in events if each.node is node), node.name.text)


def lower_call_directive(ctx: LoweringContext, node: ast.CallDirective) -> ir.Call | None:
    """Lower the call of a method."""
    call = lower_call(ctx, node)
    if call is None:
        return None
    return ir.Call(
        span=node.span,
        label=label_of(node),
        name=statement_name(node.span),
        comments=statement_comments(node),
        call=call,
    )


def lower_emit(ctx: LoweringContext, node: ast.EmitDirective) -> ir.Emit | ir.Finish | None:
    """Lower `emit`; `emit end` and `emit fail` end the scenario."""
    event = ctx.model.symbol_of(node.event)
    comments = statement_comments(node)
    if not declares_event(event) and node.event.text in FINISHING:
        return ir.Finish(
            span=node.span,
            label=label_of(node),
            name=statement_name(node.span),
            comments=comments,
            succeeds=FINISHING[node.event.text],
        )
    if not declares_event(event) or event is None:
        ctx.unsupported("OSC506", node.event.span, f"`emit {node.event}` is not supported yet")
        return None
    binding = ctx.model.bindings.get(node)
    name = ctx.attached.get(event, node.event.text)
    return ir.Emit(
        span=node.span,
        label=label_of(node),
        name=statement_name(node.span),
        comments=comments,
        event=ir.EventRef(span=node.event.span, name=name),
        arguments=() if binding is None else lower_arguments(ctx, binding, node.arguments),
    )


def label_of(node: ast.BehaviorMember) -> str | None:
    """Return the label of a member of the tree."""
    return None if node.label is None else node.label.text


@dataclass(slots=True)
class Attached:
    """Reactions that modifiers and extensions of the library attach to a behavior.

    Attributes:
        is_whole: The behavior is the `do` of a scenario.
        before: Reactions to its start.
        beside: Reactions during its execution.
        after: Reactions to its end.
    """

    is_whole: bool = False
    before: list[ir.Behavior] = field(default_factory=list)
    beside: list[ir.On] = field(default_factory=list)
    after: list[ir.Behavior] = field(default_factory=list)

    def add(self, ctx: LoweringContext, statements: Sequence[ast.Statement]) -> None:
        """Attach the `on` directives of a body, and its events at a boundary.

        Variables are sampled while a scenario runs.
        """
        for node in () if self.is_whole else statements:
            if isinstance(node, ast.VariableDeclaration) and isinstance(
                node.default, ast.SampleExpression
            ):
                ctx.unsupported(
                    "OSC508",
                    node.span,
                    "a variable that is sampled while a part of a scenario runs is not supported",
                    help="apply the modifier as a member of the scenario, or sample it there",
                )
        self.before += at_boundary(ctx, statements, "start")
        self.after += at_boundary(ctx, statements, "end")
        for node in statements:
            if isinstance(node, ast.OnDirective) and boundary_of(ctx, node.event) is None:
                self.beside += present([lower_on(ctx, node)])

    def extend(self, other: Attached) -> None:
        """Add the reactions of a part of the behavior."""
        self.before += other.before
        self.beside += other.beside
        self.after += other.after

    def around(self, body: ir.Behavior, name: str) -> ir.Behavior:
        """Return a behavior with all reactions.

        Args:
            body: The behavior; its label stays its own.
            name: Name of the result.
        """
        if self.before or self.after:
            members = (*self.before, body, *self.after)
            body = ir.Serial(span=body.span, label=None, name=name, members=members)
        if self.beside:
            members = (body, *self.beside)
            body = ir.Parallel(span=body.span, label=None, name=name, members=members)
        return body


def attached_context(
    ctx: LoweringContext, owner: sym.TypeSymbol, statements: Sequence[ast.Statement], what: str
) -> LoweringContext:
    """Return the context for the body of attached members, with their events and variables.

    Each application has events and variables of its own: they are declared in the scenario.

    Args:
        ctx: The context of the application.
        owner: The modifier, or the extended action.
        statements: Its members.
        what: Their owner, for their names.
    """
    own = {id(statement) for statement in statements}
    members = [
        each
        for each in owner.members.values()
        if isinstance(each, sym.EventSymbol | sym.FieldSymbol) and id(each.node) in own
    ]
    members = [m for m in members if isinstance(m, sym.EventSymbol) or m.is_variable]
    names: Mapping[sym.Symbol, str] = {m: _free(ctx, f"{what}.{m.name}") for m in members}
    inside = ctx.with_attached(names)
    for member in members:
        ctx.state.object_events[names[member]] = None  # while its own specification is looked at
    for member in members:
        name = names[member]
        if isinstance(member, sym.EventSymbol):
            ctx.state.object_events[name] = _event(inside, member, name)
        else:
            ctx.state.object_events.pop(name)
            ctx.state.drawn.extend(present([_variable(inside, member, name)]))
    return inside


def _free(ctx: LoweringContext, name: str) -> str:
    taken = {*ctx.state.object_events, *(each.name for each in ctx.state.drawn)}
    candidates = (name if n == 1 else f"{name} {n}" for n in range(1, len(taken) + 2))
    return next(each for each in candidates if each not in taken)


def _event(ctx: LoweringContext, symbol: sym.EventSymbol, name: str) -> ir.Event:
    node = symbol.node
    specification = None if node is None else node.specification
    if specification is not None and boundary_of(ctx, specification) is not None:
        specification = None
    return ir.Event(
        name=name,
        span=symbol.span,
        comments=() if node is None else statement_comments(node),
        trigger=None if specification is None else lower_trigger(ctx, specification),
        is_implicit=False,
        parameters=tuple(event_parameter(ctx, each) for each in symbol.parameters),
    )


def _variable(ctx: LoweringContext, symbol: sym.FieldSymbol, name: str) -> ir.Variable | None:
    """Lower a variable: sampled, or with a value that stays."""
    default, sample = symbol.default, None
    assert symbol.node is not None
    initial = default
    if isinstance(default, ast.SampleExpression):
        moment = boundary_of(ctx, default.event)
        trigger = ir.Moment(moment) if moment else lower_trigger(ctx, default.event)
        expression = lower_expression(ctx, default.expression)
        if trigger is None or expression is None:
            return None
        sample, initial = ir.Sample(expression=expression, trigger=trigger), default.default
    value = None
    if initial is not None and not isinstance(initial, ast.SampleExpression):
        value = lower_expression(ctx, initial)
    return ir.Variable(
        name=name,
        span=symbol.node.span,
        comments=statement_comments(symbol.node),
        type=lower_type(symbol.type),
        value=value,
        sample=sample,
    )
