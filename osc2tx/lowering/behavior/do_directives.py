"""The `do` of a scenario as one tree, with the reactions to its start and end."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.lowering.behavior.behaviors import BehaviorLowering
from osc2tx.lowering.behavior.composed_behaviors import Composed
from osc2tx.lowering.behavior.durations import lasting
from osc2tx.lowering.behavior.reactions import Attached
from osc2tx.lowering.behavior.triggers import WHOLE, is_own_failure
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext, present
from osc2tx.lowering.modifiers.standing_modifiers import StandingModifiers
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


def lower_body(
    ctx: LoweringContext,
    scenario: Composed,
    statements: tuple[ast.Statement, ...],
    constraints: ConstraintLowering,
    standing: StandingModifiers,
    duration: ir.Expression | None,
) -> ir.Behavior | None:
    """Lower the `do`; several of them, where a dialect allows it, run one after the other."""
    directives = [s for s in statements if isinstance(s, ast.DoDirective)]
    if not directives:
        if not any(other.base is scenario for other in ctx.model.scenarios):
            ctx.sink.report(
                "OSC510",
                scenario.node.name.span,
                f"scenario `{scenario.name}` has no `do`",
            )
        return None
    lowering = BehaviorLowering(ctx, constraints, standing)
    body = _lower_directives(lowering, scenario, directives)
    attached = Attached(is_whole=True)
    attached.add(ctx, statements)
    attached.extend(standing.attached)
    if body is None:
        return None
    body = standing.with_edges_of_members(body)
    body = lasting(ctx, body, duration)
    body = _framed(scenario, tuple(attached.before), body, tuple(attached.after))
    on = [s for s in statements if isinstance(s, ast.OnDirective)]
    events = [s for s in statements if isinstance(s, ast.EventDeclaration)]
    watched = (*(s.event for s in on), *(s.specification for s in events))
    if any(each is not None and is_own_failure(ctx, each.event) for each in watched):
        body = _labelled(scenario, body)
    if not attached.beside:
        return body
    return ir.Parallel(
        span=body.span,
        label=None,
        name=scenario.name,
        members=(_named_as_do(body), *attached.beside),
    )


def _labelled(scenario: Composed, body: ir.Behavior) -> ir.Behavior:
    """Return the body with the label by which its failure is known."""
    if body.label is None:
        return replace(body, label=WHOLE)
    return ir.Serial(span=body.span, label=WHOLE, name=scenario.name, members=(body,))


def _framed(
    scenario: Composed,
    before: tuple[ir.Behavior, ...],
    body: ir.Behavior,
    after: tuple[ir.Behavior, ...],
) -> ir.Behavior:
    """Return the body, framed by the reactions to its start and its end."""
    if not before and not after:
        return body
    is_bare = isinstance(body, ir.Serial) and not body.until and body.duration is None
    if is_bare and isinstance(body, ir.Serial) and body.label is None:
        return replace(body, members=(*before, *body.members, *after))
    return ir.Serial(
        span=body.span,
        label=None,
        name=scenario.name,
        members=(*before, _named_as_do(body), *after),
    )


def _lower_directives(
    lowering: BehaviorLowering, scenario: Composed, directives: list[ast.DoDirective]
) -> ir.Behavior | None:
    several = len(directives) > 1
    lowered = [lowering.lower_do(do, is_phase=several) for do in directives]
    bodies: tuple[ir.Behavior, ...] = present(lowered)
    if not bodies:
        return None
    if several:
        span = directives[0].span.to(directives[-1].span)
        members = tuple(_named_as_do(body) for body in bodies)
        return ir.Serial(span=span, label=None, name=scenario.name, members=members)
    body = bodies[0]
    if isinstance(body, ir.Serial | ir.Parallel | ir.OneOf):
        return replace(body, name=scenario.name, is_phase=False)
    return body


def _named_as_do(body: ir.Behavior) -> ir.Behavior:
    """Name one of several `do` after its operator: each is a phase."""
    match body:
        case ir.Serial() | ir.Parallel() | ir.OneOf():
            name = f"do {type(body).__name__.lower()}"
            return replace(body, name=name, is_phase=True)
        case _:
            return body


def nothing_left(scenario: Composed) -> ir.Behavior:
    """Return a tree for a scenario that only places its actors: it ends immediately."""
    zero = ir.Literal(
        span=scenario.node.name.span, type=ir.ValueType(ir.Kind.FLOAT, "float"), value=0.0
    )
    elapsed = ir.Elapsed(span=zero.span, duration=zero)
    trigger = ir.Trigger(span=zero.span, event=None, condition=elapsed)
    return ir.Wait(span=zero.span, label=None, name="nothing further", trigger=trigger)


def labelled_once(body: ir.Behavior) -> ir.Behavior:
    """Return the tree with unique labels: a dialect allows repeated labels, which are numbered.

    Members that refer to a repeated label mean the first one.
    """
    taken = {node.label for node in ir.walk_behaviors(body) if node.label is not None}
    seen: set[str] = set()

    def numbered(node: ir.Behavior) -> ir.Behavior:
        if node.label in seen:
            number = 2
            while (label := f"{node.label}_{number}") in taken:
                number += 1
            node = replace(node, label=label)
            taken.add(label)
        elif node.label is not None:
            seen.add(node.label)
        if not isinstance(node, ir.Serial | ir.Parallel | ir.OneOf):
            return node
        return replace(node, members=tuple(map(numbered, node.members)))

    return numbered(body)
