"""Invocations of actions and scenarios."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.constraints.specialisation import determinant_of
from osc2tx.ir.source_text import statement_name
from osc2tx.lowering.behavior.composed_behaviors import (
    Composed,
    actor_type_of,
    is_composed,
    lineage_of,
    scenario_key,
)
from osc2tx.lowering.behavior.durations import leaves_duration_open, with_open_duration
from osc2tx.lowering.behavior.fixed_arguments import without_fixed
from osc2tx.lowering.behavior.node_names import invocation_name
from osc2tx.lowering.behavior.reactions import Attached, attached_context, label_of
from osc2tx.lowering.behavior.special_scenarios import Specialised, SpecialScenarios
from osc2tx.lowering.behavior.triggers import lower_until
from osc2tx.lowering.behavior.user_actions import default_arguments, is_user_defined
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.constraints.parameter_settings import Instance, Setting
from osc2tx.lowering.context import LoweringContext, comments_around, statement_comments
from osc2tx.lowering.declarations.objects import ObjectLowering
from osc2tx.lowering.modifiers.modifiers import draw_ranges, is_override
from osc2tx.lowering.modifiers.standing_modifiers import StandingModifiers
from osc2tx.lowering.modifiers.user_modifiers import ModifierLowering
from osc2tx.lowering.placement.carla_paths import start_on_path
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.arguments import lower_arguments
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.lowering.values.range_bounds import with_bounds
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.bodies.modifiers import instead_of_scenario
from osc2tx.semantics.conversions import symbol_of
from osc2tx.semantics.model import Binding
from osc2tx.semantics.names.member_lookup import parameters_of
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

Rule = ast.KeepConstraint | ast.RemoveDefault


class InvocationLowering:
    """Lowers the invocations of one scenario."""

    def __init__(
        self, ctx: LoweringContext, constraints: ConstraintLowering, standing: StandingModifiers
    ) -> None:
        """Take the checked program, and the constraints and members of the scenario."""
        self._ctx = ctx
        self._constraints = constraints
        self._standing = standing
        self._specials = SpecialScenarios(ctx, constraints)

    def lower(self, node: ast.Invocation) -> ir.Behavior | None:
        """Lower an invocation, with the reactions of its modifiers; `None` if it was refused.

        Constraints on it become arguments, which have no comments of their own.
        """
        comments = self.comments_of(node, statement_comments(node))
        binding = self._ctx.model.binding_of(node)
        callee = binding.callee
        actor = self._actor(node, binding)
        attached = Attached()
        invocation: ir.Invoke | ir.InvokeScenario | None
        if is_composed(callee):
            special = self._specials.of(node, callee)
            invocation = self._scenario(node, special, actor, comments, attached)
        else:
            assert isinstance(callee, sym.ActionSymbol)
            invocation = self._action(node, callee, actor, comments, attached)
            self._attach_extension(node, callee, actor, attached)
        if invocation is None:
            return None
        return attached.around(invocation, f"{name_of_member(node)} with reactions")

    def comments_of(
        self, node: ast.Invocation | ast.Composition, lines: tuple[str, ...]
    ) -> tuple[str, ...]:
        """Return the comment lines of a member, those of the rules in its `with` block included."""
        rules = [each for each in node.with_members if isinstance(each, Rule)]
        said = (line for each in rules for line in self._constraints.comments_of(each))
        return comments_around(lines, said)

    def _attach_extension(
        self,
        node: ast.Invocation,
        callee: sym.ActionSymbol,
        actor: ir.Expression | None,
        attached: Attached,
    ) -> None:
        """Attach the events and reactions that `extend` adds to an action of the library."""
        for each in supertypes(callee):
            if not (added := each.added):
                continue
            place = Place(model=self._ctx.model, owner=callee, prefix=(node,), it=None)
            ctx = self._ctx.at(place).with_actor(actor or self._ctx.actor)
            attached.add(attached_context(ctx, each, added, name_of_member(node)), added)

    def _added_modifiers(
        self,
        node: ast.Invocation,
        callee: sym.ActionSymbol,
        actor: ir.Expression | None,
        attached: Attached,
    ) -> tuple[ir.ModifierCall, ...]:
        """Return the modifiers that `extend` applies in an action of the library."""
        added = [statement for each in supertypes(callee) for statement in each.added]
        members = [each for each in added if isinstance(each, ast.ModifierApplication)]
        if not members:
            return ()
        lowering = replace(self._modifier_lowering(node, actor, callee, attached), within=(node,))
        return tuple([call for each in members for call in lowering.lower(each)])

    def _action(
        self,
        node: ast.Invocation,
        callee: sym.ActionSymbol,
        actor: ir.Expression | None,
        comments: tuple[str, ...],
        attached: Attached,
    ) -> ir.Invoke:
        self._ctx.used.actions.append(callee)
        arguments = self._arguments(node, actor)
        if is_user_defined(callee):
            arguments += default_arguments(self._ctx, callee, arguments, actor, node)
        written = [member for member in node.with_members if not _is_until(member)]
        invocation = ir.Invoke(
            span=node.span,
            label=label_of(node),
            name=invocation_name(
                _written(actor),
                callee.name,
                [*(a.span.text for a in node.arguments), *(m.span.text for m in written)],
            ),
            comments=comments,
            actor=actor,
            owner=None if callee.actor is None else callee.actor.name,
            action=callee.name,
            arguments=tuple(a for a in arguments if a.parameter != "duration"),
            modifiers=(
                *self._modifiers(node, actor, attached),
                *self._added_modifiers(node, callee, actor, attached),
            ),
            duration=next((a.value for a in arguments if a.parameter == "duration"), None),
            until=lower_until(self._ctx, node.with_members),
            is_own=is_user_defined(callee),
        )
        name = f"{name_of_member(node)}.duration"
        return start_on_path(with_open_duration(self._ctx, invocation, name, node))

    def _conditions(self, callee: Composed) -> set[str]:
        """Return the parameters that a scenario has a value of as it is of a conditional type."""
        found = (determinant_of(self._ctx.model, each) for each in lineage_of(callee))
        return {condition.field.name for condition in found if condition is not None}

    def _actor(self, node: ast.Invocation, binding: Binding) -> ir.Expression | None:
        """Return the actor; without an expression it is the actor of the scenario (§5.5)."""
        callee = binding.callee
        type_of_actor = actor_type_of(callee) if isinstance(callee, sym.BehaviorSymbol) else None
        if type_of_actor is None:
            return None
        if binding.receiver is not None:
            return lower_expression(self._ctx, binding.receiver)
        type_ = ir.ValueType(ir.Kind.ACTOR, type_of_actor.name)
        return ir.FieldRef(span=node.span, type=type_, name="actor")

    def _scenario(
        self,
        node: ast.Invocation,
        special: Specialised,
        actor: ir.Expression | None,
        comments: tuple[str, ...],
        attached: Attached,
    ) -> ir.InvokeScenario | None:
        callee = special.scenario
        idle = self._specials.without_behavior(node, special)
        if idle is not None:
            self._ctx.unsupported(
                "OSC504",
                node.span,
                f"{'action' if isinstance(idle, sym.ActionSymbol) else 'scenario'} "
                f"`{idle.qualified_name}` has no `do`",
                help="state its behavior: `do …`",
            )
            return None
        self._ctx.state.invoked.append(callee)
        given = self._arguments(node, actor)
        arguments = self._specials.drawn(node, special, given, name_of_member(node))
        self.refuse_movement(node, actor, callee, "an invoked scenario", attached)
        types_ = {each.name: symbol_of(each.type) for each in parameters_of(callee)}
        objects = [(each.value, types_.get(each.parameter)) for each in arguments]
        for whose, type_ in ((actor, callee.actor), *objects):
            known_as = type_ if isinstance(type_, sym.ActorSymbol) else None
            for modifier in self._standing.not_known_to(whose, known_as):
                self._ctx.unsupported(
                    "OSC508",
                    modifier.span,
                    f"`{modifier.span.text}` would modify what `{callee.qualified_name}` does",
                    help=instead_of_scenario(callee, modifier.name, modifier.span.text),
                )
        duration: ir.Expression | None = next(
            (a.value for a in arguments if a.parameter == "duration"), None
        )
        if duration is not None and leaves_duration_open(self._ctx, callee):
            self._ctx.unsupported(
                "OSC501",
                duration.span,
                f"`{callee.qualified_name}` states its duration as a range",
                help="omit the constraint there, or the duration here",
            )
        decided = ("duration", *self._conditions(callee))
        handed_in = tuple(each for each in arguments if each.parameter not in decided)
        return ir.InvokeScenario(
            span=node.span,
            label=label_of(node),
            name=statement_name(node.span),
            comments=comments,
            scenario=callee.qualified_name,
            key=scenario_key(callee),
            actor=actor,
            specials=self._specials.lowered(special, arguments),
            arguments=without_fixed(self._ctx, self._constraints, node, callee, handed_in),
            duration=duration if duration is None else with_bounds(duration),
            until=lower_until(self._ctx, node.with_members),
        )

    def refuse_movement(
        self,
        node: Instance,
        actor: ir.Expression | None,
        behavior: sym.BehaviorSymbol | None,
        what: str,
        attached: Attached,
    ) -> None:
        """Report modifiers of other members than actions; those that move nothing may stay."""
        lowering = self._modifier_lowering(node, actor, behavior, attached)
        for member in node.with_members:
            if not isinstance(member, ast.ModifierApplication) or is_override(self._ctx, member):
                continue
            if lowering.lower(member):
                self._ctx.unsupported(
                    "OSC508",
                    member.span,
                    f"modifier `{member.modifier}` of {what} is not supported",
                    help=instead_of_scenario(behavior, member.modifier.text, member.span.text)
                    or "apply it in the `with` of the actions in it",
                )

    def _modifier_lowering(
        self,
        node: Instance,
        actor: ir.Expression | None,
        behavior: sym.BehaviorSymbol | None,
        attached: Attached | None = None,
    ) -> ModifierLowering:
        ctx = self._ctx
        if ctx.actor is None and "actor" not in ctx.own_names:
            ctx = ctx.with_actor(actor)  # the scenario has none: it is that of the invocation
        return ModifierLowering(
            *(ctx, self._constraints, name_of_member(node), actor, behavior, (node,)),
            attached=attached or Attached(),
        )

    def _arguments(
        self, node: ast.Invocation, actor: ir.Expression | None
    ) -> tuple[ir.Argument, ...]:
        """Return the arguments and the equivalent constraints `keep(it.parameter …)` (§6)."""
        binding = self._ctx.model.binding_of(node)
        fields = {parameter.name: parameter for parameter, _ in binding.arguments}
        arguments = tuple(
            argument
            for argument in lower_arguments(self._ctx, binding, node.arguments)
            if not self._constraints.narrows((node, fields[argument.parameter]))
        )
        if not is_composed(binding.callee):
            arguments = draw_ranges(self._ctx, binding, arguments, name_of_member(node))
        for argument in arguments:
            key: Key = (node, fields[argument.parameter])
            if not isinstance(argument.value, ir.RangeValue):
                self._ctx.state.given.setdefault(key, argument.value)
        assert isinstance(binding.callee, sym.BehaviorSymbol)
        lowering = self._modifier_lowering(node, actor, binding.callee)
        for member in node.with_members:
            if isinstance(member, ast.ModifierApplication):
                lowering.prepare(member)
        return arguments + self.kept_arguments(node)

    def kept_arguments(self, node: ast.Invocation | ast.Composition) -> tuple[ir.Argument, ...]:
        """Return the constrained values of the parameters without an argument of one value."""
        binding = self._ctx.model.bindings.get(node)
        is_scenario = binding is not None and is_composed(binding.callee)
        arguments = []
        for parameter, setting in self._constraints.of_instance(node):
            value = setting.value or setting.domain
            if value is None:
                continue
            is_time = parameter.name == "duration" and not isinstance(setting.domain, ir.Choices)
            # An invoked scenario draws for itself, unless a check here has to know the value.
            draws_itself = is_scenario and self._constraints.is_only_definition(
                setting, (node, parameter)
            )
            if setting.value is None and not draws_itself and not is_time:
                value = self._drawn(node, parameter, setting)
            if value is None:
                continue
            if value is not setting.domain:
                self._ctx.state.given[node, parameter] = value
            arguments.append(_named(parameter, value))
        objects = ObjectLowering(self._ctx, self._constraints)
        for parameter in self._constraints.structs_of_instance(node):
            assert isinstance(parameter.type, types.StructType)
            name = f"{name_of_member(node)}.{parameter.name}"
            type_ = lower_type(parameter.type)
            object_ = ir.FieldRef(span=node.span, type=type_, name=self._ctx.unique(name))
            self._ctx.state.given[node, parameter] = object_
            struct = objects.of_parameter((node, parameter), parameter.type, object_)
            self._ctx.state.drawn.append(struct)
            arguments.append(_named(parameter, object_))
        return tuple(arguments)

    def _drawn(
        self, node: ast.Invocation | ast.Composition, parameter: sym.FieldSymbol, setting: Setting
    ) -> ir.FieldRef | None:
        assert setting.domain is not None
        name = f"{name_of_member(node)}.{parameter.name}"
        return self._ctx.draw(name, setting.domain, lower_type(parameter.type))

    def _modifiers(
        self, node: ast.Invocation, actor: ir.Expression | None, attached: Attached
    ) -> tuple[ir.ModifierCall, ...]:
        action = self._ctx.model.binding_of(node).callee
        assert isinstance(action, sym.BehaviorSymbol)
        lowering = self._modifier_lowering(node, actor, action, attached)
        modifiers: list[ir.ModifierCall] = []
        for member in node.with_members:
            match member:
                case ast.ModifierApplication():
                    if not is_override(self._ctx, member):
                        modifiers += lowering.lower(member)
                case ast.KeepConstraint() | ast.RemoveDefault() | ast.UntilDirective():
                    pass
        return (*modifiers, *self._standing.of(actor, action))


def _written(actor: ir.Expression | None) -> str | None:
    if actor is None:
        return None
    return actor.name if isinstance(actor, ir.FieldRef) else actor.span.text


def _named(parameter: sym.FieldSymbol, value: ir.Expression) -> ir.Argument:
    return ir.Argument(parameter=parameter.name, value=value, is_positional=False, span=value.span)


def name_of_member(node: ast.Invocation | ast.Composition) -> str:
    """Return the prefix for values of a member of the tree: label, or actor and action."""
    if node.label is not None:
        return node.label.text
    if isinstance(node, ast.Composition):
        return node.operator.value
    if node.actor is None:
        return node.behavior.text
    return f"{''.join(node.actor.span.text.split())}.{node.behavior.text}"


def _is_until(member: ast.WithMember) -> bool:
    return isinstance(member, ast.UntilDirective)
