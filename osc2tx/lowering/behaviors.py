"""The `do` tree: compositions, invocations, directives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypedDict, assert_never

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.constraints import lower_constraints
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.dialects import dialect_defaults
from osc2tx.lowering.expressions import lower_arguments, lower_expression
from osc2tx.lowering.names import (
    composition_name,
    condensed,
    invocation_name,
    statement_name,
)
from osc2tx.lowering.triggers import declares_event, lower_trigger
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.model import Binding
from osc2tx.syntax import ast


class _CompositionFields(TypedDict):
    """What the three compositions share, as keyword arguments."""

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

    def __init__(self, ctx: LoweringContext) -> None:
        """Take the checked program."""
        self._ctx = ctx

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
        reactions: list[ir.Emit | None] = []
        for member in node.members:
            if isinstance(member, ast.EmitDirective):
                reactions.append(self._emit(member, statement_comments(member)))
            else:
                self._ctx.unsupported("OSC506", member.span, "`call` is not supported yet")
        if trigger is None or not present(reactions):
            return None
        return ir.On(
            span=node.span,
            label=None,
            name=f"on {condensed(node.event.span)}",
            comments=statement_comments(node),
            trigger=trigger,
            reactions=present(reactions),
        )

    def lower(self, node: ast.BehaviorMember, *, below_root: bool = False) -> ir.Behavior | None:
        """Lower a member; `None` if it was refused."""
        comments = statement_comments(node)
        match node:
            case ast.Composition():
                is_phase = below_root or node.label is not None
                return self._composition(node, comments, is_phase=is_phase, is_root=False)
            case ast.Invocation():
                return self._invocation(node, comments)
            case ast.WaitDirective(event=event):
                trigger = lower_trigger(self._ctx, event)
                if trigger is None:
                    return None
                return ir.Wait(
                    span=node.span,
                    label=_label(node),
                    name=statement_name(node.span),
                    comments=comments,
                    trigger=trigger,
                )
            case ast.EmitDirective():
                return self._emit(node, comments)
            case ast.CallDirective():
                self._ctx.unsupported("OSC506", node.span, "`call` is not supported yet")
                return None
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
        lowered = [self.lower(member, below_root=is_root) for member in node.members]
        members: tuple[ir.Behavior, ...] = present(lowered)
        if not members:
            return None
        self._refuse_other_members(node.with_members)
        arguments = self._composition_arguments(node)
        common: _CompositionFields = {
            "span": node.span,
            "label": _label(node),
            "name": composition_name(node.operator.value, members, is_phase=is_phase),
            "comments": comments,
            "members": members,
            "is_phase": is_phase,
            "duration": self._time(arguments.get("duration")),
            "until": self._until(node.with_members),
            "end_comments": node.end_comments,
        }
        match node.operator:
            case ast.CompositionOperator.SERIAL:
                return ir.Serial(**common)
            case ast.CompositionOperator.ONE_OF:
                return ir.OneOf(**common)
            case ast.CompositionOperator.PARALLEL:
                return ir.Parallel(
                    **common,
                    overlap=_overlap(arguments.get("overlap")),
                    start_to_start=self._time(arguments.get("start_to_start")),
                    end_to_end=self._time(arguments.get("end_to_end")),
                )

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

    def _until(self, members: Sequence[ast.WithMember]) -> tuple[ir.Trigger, ...]:
        return present(
            [
                lower_trigger(self._ctx, member.event, statement_comments(member))
                for member in members
                if isinstance(member, ast.UntilDirective)
            ]
        )

    def _refuse_other_members(self, members: Sequence[ast.WithMember]) -> None:
        for member in members:
            match member:
                case ast.UntilDirective():
                    pass
                case ast.ModifierApplication(modifier=modifier):
                    self._ctx.unsupported(
                        "OSC508", member.span, f"modifier `{modifier}` of a composition"
                    )
                case ast.KeepConstraint() | ast.RemoveDefault():
                    self._ctx.unsupported("OSC502", member.span, "constraint of a composition")

    def _invocation(
        self, node: ast.Invocation, comments: tuple[str, ...]
    ) -> ir.Invoke | ir.InvokeScenario | None:
        binding = self._ctx.model.binding_of(node)
        callee = binding.callee
        actor = self._actor(node, binding)
        if isinstance(callee, sym.ScenarioSymbol):
            return self._scenario(node, callee, actor, comments)
        if not isinstance(callee, sym.ActionSymbol) or callee.actor is None or actor is None:
            self._ctx.unsupported(
                "OSC504", node.span, "an action without actor is not supported yet"
            )
            return None
        arguments = lower_arguments(self._ctx, binding, node.arguments)
        arguments += self._kept_arguments(node.with_members)
        written = [member for member in node.with_members if not _is_until(member)]
        return ir.Invoke(
            span=node.span,
            label=_label(node),
            name=invocation_name(
                actor.name if isinstance(actor, ir.FieldRef) else actor.span.text,
                callee.name,
                [*(a.span.text for a in node.arguments), *(m.span.text for m in written)],
            ),
            comments=comments,
            actor=actor,
            owner=callee.actor.name,
            action=callee.name,
            arguments=tuple(a for a in arguments if a.parameter != "duration"),
            modifiers=self._modifiers(node.with_members),
            duration=next((a.value for a in arguments if a.parameter == "duration"), None),
            until=self._until(node.with_members),
        )

    def _actor(self, node: ast.Invocation, binding: Binding) -> ir.Expression | None:
        """Return who acts; without an expression it is the actor of the scenario (§5.5)."""
        if binding.receiver is not None:
            return lower_expression(self._ctx, binding.receiver)
        callee = binding.callee
        if not isinstance(callee, sym.ScenarioSymbol | sym.ActionSymbol) or callee.actor is None:
            return None
        type_ = ir.ValueType(ir.Kind.ACTOR, callee.actor.name)
        return ir.FieldRef(span=node.span, type=type_, name="actor")

    def _scenario(
        self,
        node: ast.Invocation,
        callee: sym.ScenarioSymbol,
        actor: ir.Expression | None,
        comments: tuple[str, ...],
    ) -> ir.InvokeScenario | None:
        if not has_behavior(callee):
            self._ctx.unsupported(
                "OSC504", node.span, f"scenario `{callee.qualified_name}` has no `do`"
            )
            return None
        self._ctx.invoked.append(callee)
        arguments = lower_arguments(
            self._ctx, self._ctx.model.binding_of(node), node.arguments
        ) + self._kept_arguments(node.with_members)
        for modifier in self._modifiers(node.with_members):
            self._ctx.unsupported(
                "OSC508", modifier.span, f"modifier `{modifier.name}` of an invoked scenario"
            )
        span = callee.node.name.span
        return ir.InvokeScenario(
            span=node.span,
            label=_label(node),
            name=statement_name(node.span),
            comments=comments,
            scenario=callee.qualified_name,
            key=f"{span.source.name}:{span.start}",
            actor=actor,
            arguments=tuple(a for a in arguments if a.parameter != "duration"),
            duration=next((a.value for a in arguments if a.parameter == "duration"), None),
            until=self._until(node.with_members),
        )

    def _kept_arguments(self, members: Sequence[ast.WithMember]) -> tuple[ir.Argument, ...]:
        """Return what `keep(it.parameter == value)` says: the same as an argument (§6)."""
        keeps = tuple(member for member in members if isinstance(member, ast.KeepConstraint))
        arguments = []
        for bound in lower_constraints(self._ctx, keeps):
            is_range = isinstance(bound.value, ir.RangeValue)
            if bound.root is not None or len(bound.path) != 1:
                self._ctx.unsupported(
                    "OSC502", bound.span, "only parameters of the invocation can be kept here yet"
                )
            elif is_range and bound.path[0] != "duration":
                self._ctx.unsupported(
                    "OSC502", bound.span, "a range for this parameter is not supported yet"
                )
            else:
                arguments.append(
                    ir.Argument(
                        parameter=bound.path[0],
                        value=bound.value,
                        is_positional=False,
                        span=bound.span,
                    )
                )
        return tuple(arguments)

    def _modifiers(self, members: Sequence[ast.WithMember]) -> tuple[ir.ModifierCall, ...]:
        modifiers = []
        for member in members:
            match member:
                case ast.ModifierApplication():
                    modifiers.append(lower_modifier(self._ctx, member))
                case ast.RemoveDefault():
                    self._ctx.unsupported(
                        "OSC502", member.span, "`remove_default` is not supported"
                    )
                case ast.KeepConstraint() | ast.UntilDirective():
                    pass
        return tuple(modifiers)

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
            label=_label(node),
            name=statement_name(node.span),
            comments=comments,
            event=ir.EventRef(span=node.event.span, name=node.event.text),
            arguments=arguments,
        )


def lower_modifier(ctx: LoweringContext, node: ast.ModifierApplication) -> ir.ModifierCall:
    """Lower a modifier; `at` is taken out of its arguments, for it says when it holds."""
    binding = ctx.model.binding_of(node)
    arguments = lower_arguments(ctx, binding, node.arguments)
    arguments += dialect_defaults(binding.callee, arguments, node.span)
    at = next((a.value for a in arguments if a.parameter == "at"), None)
    return ir.ModifierCall(
        span=node.span,
        name=node.modifier.text,
        arguments=tuple(a for a in arguments if a.parameter != "at"),
        at=at.member if isinstance(at, ir.EnumValue) else "all",
        comments=statement_comments(node),
    )


def has_behavior(scenario: sym.ScenarioSymbol) -> bool:
    """Whether a scenario or one of its bases has a `do`."""
    current: sym.ScenarioSymbol | None = scenario
    while current is not None:
        if any(isinstance(statement, ast.DoDirective) for statement in current.statements):
            return True
        current = current.base
    return False


def _label(node: ast.BehaviorMember) -> str | None:
    return None if node.label is None else node.label.text


def _is_until(member: ast.WithMember) -> bool:
    return isinstance(member, ast.UntilDirective)


def _overlap(value: ast.Expression | None) -> str | None:
    return None if value is None else value.span.text
