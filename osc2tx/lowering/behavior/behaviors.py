"""The `do` tree: compositions, invocations, directives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypedDict, assert_never

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.ir.source_text import condensed, statement_name
from osc2tx.lowering.behavior.durations import with_open_duration
from osc2tx.lowering.behavior.invocations import InvocationLowering, label_of, name_of_member
from osc2tx.lowering.behavior.node_names import composition_name
from osc2tx.lowering.behavior.triggers import (
    boundary_of,
    declares_event,
    lower_trigger,
    lower_until,
)
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.modifiers.standing_modifiers import StandingModifiers
from osc2tx.lowering.values.arguments import lower_arguments
from osc2tx.lowering.values.calls import lower_call
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

# Life-cycle events that a scenario may emit, and whether it succeeds then.
FINISHING = {"end": True, "fail": False}

# Those that `on` can react to at the place where they occur.


class _CompositionFields(TypedDict):
    """The common fields of the three compositions, as keyword arguments."""

    span: Span
    label: str | None
    name: str
    comments: tuple[str, ...]
    members: tuple[ir.Behavior, ...]
    is_phase: bool
    duration: ir.Expression | None
    until: tuple[ir.Trigger, ...]
    end_comments: tuple[str, ...]


class BehaviorLowering:
    """Lowers the tree of one scenario."""

    def __init__(
        self, ctx: LoweringContext, constraints: ConstraintLowering, standing: StandingModifiers
    ) -> None:
        """Take the checked program, and the constraints and members of the scenario."""
        self._ctx = ctx
        self._standing = standing
        self._invocations = InvocationLowering(ctx, constraints, standing)

    def lower_do(self, node: ast.DoDirective, *, is_phase: bool) -> ir.Behavior | None:
        """Lower a `do`; the compositions right below its member are phases."""
        member = node.member
        comments = (*statement_comments(node), *statement_comments(member))
        if isinstance(member, ast.Composition):
            return self._composition(member, comments, is_phase=is_phase, is_root=True)
        body = self.lower(member)
        return None if body is None else replace(body, comments=comments)

    def lower_on(self, node: ast.OnDirective) -> ir.On | None:
        """Lower an `on` directive; its reactions take no time."""
        trigger = lower_trigger(self._ctx, node.event)
        reactions = self.reactions(node)
        if trigger is None or not reactions:
            return None
        return ir.On(
            span=node.span,
            label=None,
            name=f"on {condensed(node.event.span.text)}",
            comments=statement_comments(node),
            trigger=trigger,
            reactions=reactions,
        )

    def reactions(self, node: ast.OnDirective) -> tuple[ir.Emit | ir.Finish | ir.Call, ...]:
        """Return the actions of an `on` directive; its own comments are not among theirs."""
        reactions: list[ir.Emit | ir.Finish | ir.Call | None] = []
        for member in node.members:
            comments = statement_comments(member)
            if isinstance(member, ast.EmitDirective):
                reactions.append(self._finish(member, comments) or self._emit(member, comments))
            else:
                reactions.append(self._call(member, comments))
        return present(reactions)

    def at_boundary(self, nodes: Sequence[ast.OnDirective], moment: str) -> tuple[ir.Behavior, ...]:
        """Return what directives do at the start or end of the scenario: they frame its body."""
        found: list[ir.Behavior] = []
        for node in nodes:
            if boundary_of(self._ctx, node.event) == moment:
                reactions: list[ir.Behavior] = list(self.reactions(node))
                if reactions:
                    comments = (*statement_comments(node), *reactions[0].comments)
                    reactions[0] = replace(reactions[0], comments=comments)
                found += reactions
        return tuple(found)

    def lower(self, node: ast.BehaviorMember, *, below_root: bool = False) -> ir.Behavior | None:
        """Lower a member; `None` if it was refused."""
        comments = statement_comments(node)
        match node:
            case ast.Composition():
                is_phase = below_root or node.label is not None
                return self._composition(node, comments, is_phase=is_phase, is_root=False)
            case ast.Invocation():
                return self._invocations.lower(node, comments)
            case ast.WaitDirective(event=event):
                trigger = lower_trigger(self._ctx, event)
                if trigger is None:
                    return None
                return ir.Wait(
                    span=node.span,
                    label=label_of(node),
                    name=statement_name(node.span),
                    comments=comments,
                    trigger=trigger,
                )
            case ast.EmitDirective():
                return self._finish(node, comments) or self._emit(node, comments)
            case ast.CallDirective():
                return self._call(node, comments)
            case _:
                assert_never(node)

    def _composition(
        self,
        node: ast.Composition,
        comments: tuple[str, ...],
        *,
        is_phase: bool,
        is_root: bool,
    ) -> ir.Behavior | None:
        with self._standing.inside(node):
            lowered = [self.lower(member, below_root=is_root) for member in node.members]
        members: tuple[ir.Behavior, ...] = present(lowered)
        if not members:
            return None
        arguments = self._composition_arguments(node)
        kept = {
            argument.parameter: argument.value
            for argument in self._invocations.kept_arguments(node)
        }
        common: _CompositionFields = {
            "span": node.span,
            "label": label_of(node),
            "name": composition_name(node.operator.value, members, is_phase=is_phase),
            "comments": comments,
            "members": members,
            "is_phase": is_phase,
            "duration": self._time(arguments.get("duration")) or kept.get("duration"),
            "until": lower_until(self._ctx, node.with_members),
            "end_comments": node.end_comments,
        }
        made: ir.Serial | ir.OneOf | ir.Parallel
        match node.operator:
            case ast.CompositionOperator.SERIAL:
                made = ir.Serial(**common)
            case ast.CompositionOperator.ONE_OF:
                made = ir.OneOf(**common)
            case ast.CompositionOperator.PARALLEL:
                made = ir.Parallel(
                    **common,
                    overlap=_overlap(arguments.get("overlap")),
                    start_to_start=self._time(arguments.get("start_to_start")),
                    end_to_end=self._time(arguments.get("end_to_end")),
                )
        return with_open_duration(self._ctx, made, f"{name_of_member(node)}.duration")

    def _composition_arguments(self, node: ast.Composition) -> dict[str, ast.Expression]:
        """Return the arguments by name; the first position of `parallel` is `overlap`."""
        is_parallel = node.operator is ast.CompositionOperator.PARALLEL
        first = "overlap" if is_parallel else "duration"
        return {
            argument.name.text if argument.name is not None else first: argument.value
            for argument in node.arguments
        }

    def _time(self, value: ast.Expression | None) -> ir.Expression | None:
        return None if value is None else lower_expression(self._ctx, value)

    def _call(self, node: ast.CallDirective, comments: tuple[str, ...]) -> ir.Call | None:
        call = lower_call(self._ctx, node)
        if call is None:
            return None
        return ir.Call(
            span=node.span,
            label=label_of(node),
            name=statement_name(node.span),
            comments=comments,
            call=call,
        )

    def _finish(self, node: ast.EmitDirective, comments: tuple[str, ...]) -> ir.Finish | None:
        """Lower `emit end` and `emit fail`: the scenario says that it is over."""
        event = self._ctx.model.symbol_of(node.event)
        if declares_event(event) or node.event.text not in FINISHING:
            return None
        return ir.Finish(
            span=node.span,
            label=label_of(node),
            name=statement_name(node.span),
            comments=comments,
            succeeds=FINISHING[node.event.text],
        )

    def _emit(self, node: ast.EmitDirective, comments: tuple[str, ...]) -> ir.Emit | None:
        if not declares_event(self._ctx.model.symbol_of(node.event)):
            self._ctx.unsupported(
                "OSC506", node.event.span, f"`emit {node.event}` is not supported yet"
            )
            return None
        binding = self._ctx.model.bindings.get(node)
        arguments = () if binding is None else lower_arguments(self._ctx, binding, node.arguments)
        return ir.Emit(
            span=node.span,
            label=label_of(node),
            name=statement_name(node.span),
            comments=comments,
            event=ir.EventRef(span=node.event.span, name=node.event.text),
            arguments=arguments,
        )


def emitted_at(
    ctx: LoweringContext, events: Sequence[ast.EventDeclaration], moment: str
) -> tuple[ir.Behavior, ...]:
    """Return what makes the events occur whose specification is the start or end: `is @start`."""
    return tuple(
        ir.Emit(
            span=node.span,
            label=None,
            name=f"emit {node.name}",
            event=ir.EventRef(span=node.name.span, name=node.name.text),
            arguments=(),
        )
        for node in events
        if node.specification is not None and boundary_of(ctx, node.specification) == moment
    )


def _overlap(value: ast.Expression | None) -> str | None:
    return None if value is None else value.span.text
