"""The `do` tree: compositions, invocations, directives."""

from __future__ import annotations

from typing import TypedDict, assert_never

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.ir.source_text import statement_name
from osc2tx.lowering.behavior.durations import with_open_duration
from osc2tx.lowering.behavior.invocations import InvocationLowering, name_of_member
from osc2tx.lowering.behavior.node_names import composition_name
from osc2tx.lowering.behavior.reactions import label_of, lower_call_directive, lower_emit
from osc2tx.lowering.behavior.triggers import lower_trigger, lower_until
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.modifiers.standing_modifiers import StandingModifiers
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


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
        if isinstance(member, ast.Composition):
            comments = (*statement_comments(node), *statement_comments(member))
            return self._composition(member, comments, is_phase=is_phase, is_root=True)
        body = self.lower(member)
        if body is None:
            return None
        return replace(body, comments=(*statement_comments(node), *body.comments))

    def lower(self, node: ast.BehaviorMember, *, below_root: bool = False) -> ir.Behavior | None:
        """Lower a member; `None` if it was refused."""
        comments = statement_comments(node)
        match node:
            case ast.Composition():
                is_phase = below_root or node.label is not None
                return self._composition(node, comments, is_phase=is_phase, is_root=False)
            case ast.Invocation():
                return self._invocations.lower(node)
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
                return lower_emit(self._ctx, node)
            case ast.CallDirective():
                return lower_call_directive(self._ctx, node)
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
            "comments": self._invocations.comments_of(node, comments),
            "members": members,
            "is_phase": is_phase,
            "duration": kept.get("duration") or self._time(arguments.get("duration")),
            "until": lower_until(self._ctx, node.with_members),
            "end_comments": node.end_comments,
        }
        made: ir.Composition
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
        made = self._standing.with_edges(node, made)
        made = with_open_duration(self._ctx, made, f"{name_of_member(node)}.duration", node)
        name = f"{name_of_member(node)} with reactions"
        return self._standing.attached_to(node).around(made, name)

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


def _overlap(value: ast.Expression | None) -> str | None:
    return None if value is None else value.span.text
