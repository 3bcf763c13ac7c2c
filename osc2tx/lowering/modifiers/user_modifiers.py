"""User-defined modifiers (§7.3.12): applications are replaced by their bodies.

Its parameters are known there: from the arguments, the defaults and the constraints. The modifiers
of its body then belong to the invocation like any others.
"""

from __future__ import annotations

from dataclasses import field

from osc2tx import ir
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.lowering.behavior.reactions import Attached, attached_context
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.constraints.parameter_domains import all_values
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.declarations.user_fields import is_plain
from osc2tx.lowering.modifiers.modifier_functions import application_of, parameters_of
from osc2tx.lowering.modifiers.modifiers import lower_modifier
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.bodies.modifiers import instead_of_scenario
from osc2tx.semantics.scope import is_subtype
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace

# Members by which a modifier changes something.
EFFECTIVE = (ast.ModifierApplication, ast.KeepConstraint, ast.OnDirective)


@dataclass(frozen=True, slots=True)
class Applied:
    """A modifier of the library, where it is applied.

    Attributes:
        call: Its call.
        target: The behavior that it is one of; `None` for modifiers of actors.
        actor: The actor of the modified behavior; `None` if that is the actor of the scenario.
    """

    call: ir.ModifierCall
    target: sym.BehaviorSymbol | None
    actor: ir.Expression | None


@dataclass(frozen=True, slots=True)
class ModifierLowering:
    """Lowers the modifiers of one invocation, or of one actor of a scenario.

    Attributes:
        ctx: The checked program.
        constraints: The constraints of the scenario.
        what: Their owner, for names of values that are drawn from ranges.
        actor: The actor of the modified behavior.
        action: The invoked action; `None` for modifiers of a whole scenario.
        it: The meaning of `it` in the body: the modified behavior.
        chain: The applications around this one, the outermost first.
        within: The object whose type has it as a member.
        attached: Collects its reactions, which run beside the modified behavior.
    """

    ctx: LoweringContext
    constraints: ConstraintLowering
    what: str
    actor: ir.Expression | None
    action: sym.BehaviorSymbol | None
    it: Key | None = None
    chain: tuple[ast.ModifierApplication, ...] = ()
    within: Key = ()
    attached: Attached = field(default_factory=Attached)

    def lower(self, node: ast.ModifierApplication) -> tuple[ir.ModifierCall, ...]:
        """Return a modifier of the library, or those that a user-defined one applies."""
        return tuple(applied.call for applied in self.applied(node))

    def applied(self, node: ast.ModifierApplication) -> tuple[Applied, ...]:
        """Return the same, with the modified object of each."""
        callee = self.ctx.model.binding_of(node).callee
        assert isinstance(callee, sym.ModifierSymbol)
        if not self._applies(node, callee):
            return ()
        if callee.origin != "user":
            call = lower_modifier(self.ctx, node, self.what)
            return (Applied(call, callee.target, self._actor_of(node)),)
        if not any(isinstance(part, EFFECTIVE) for part in callee.statements):
            self._refuse(
                node,
                f"modifier `{callee.qualified_name}` without an effect on the modified behavior",
                "apply other modifiers in it, or constrain parameters, `keep(it.parameter == …)`",
            )
            return ()
        if any(self.ctx.model.binding_of(outer).callee is callee for outer in self.chain):
            self._refuse(node, f"modifier `{callee.qualified_name}`, which applies itself,", None)
            return ()
        inner = self._inside(node, callee)
        inner.bind(callee)
        inner = inner.with_events(callee)
        parts = tuple(part for statement in callee.statements for part in inner.part(statement))
        if not parts:
            return ()
        self.ctx.used.modifiers.append(callee)
        application = application_of(callee, node, inner.values_of(callee))
        calls = [replace(p.call, applied=(application, *p.call.applied)) for p in parts]
        calls[0] = replace(calls[0], comments=(*statement_comments(node), *calls[0].comments))
        return tuple(replace(p, call=call) for p, call in zip(parts, calls, strict=True))

    def prepare(self, node: ast.ModifierApplication) -> None:
        """Find the values of the parameters of a modifier: arguments may depend on them."""
        callee = self.ctx.model.binding_of(node).callee
        if isinstance(callee, sym.ModifierSymbol) and callee.origin == "user":
            self._inside(node, callee).bind(callee)

    def _actor_of(self, node: ast.ModifierApplication) -> ir.Expression | None:
        """Return whose behavior is modified."""
        return self.actor if node.actor is None else lower_expression(self.ctx, node.actor)

    def _inside(
        self, node: ast.ModifierApplication, callee: sym.ModifierSymbol
    ) -> ModifierLowering:
        chain = (*self.chain, node)
        prefix = (*self.within, *chain)
        place = Place(model=self.ctx.model, owner=callee, prefix=prefix, it=self.it)
        actor = self._actor_of(node)
        return replace(
            self,
            ctx=replace(self.ctx.at(place), actor=actor, receiver=None),
            constraints=self.constraints.with_actor(actor),
            actor=actor,
            what=f"{self.what}.{node.modifier.text}",
            chain=chain,
        )

    def with_events(self, callee: sym.ModifierSymbol) -> ModifierLowering:
        """Return the same, its events and variables declared and its reactions attached."""
        ctx = attached_context(self.ctx, callee, callee.statements, self.what)
        self.attached.add(ctx, callee.statements)
        return replace(self, ctx=ctx)

    def values_of(self, callee: sym.ModifierSymbol) -> dict[sym.FieldSymbol, ir.Expression]:
        """Return the result of `bind`."""
        chain = (*self.within, *self.chain)
        values = (
            (each, self.ctx.state.given.get((*chain, each))) for each in parameters_of(callee)
        )
        return {parameter: value for parameter, value in values if value is not None}

    def bind(self, callee: sym.ModifierSymbol) -> None:
        """Determine the values of the parameters here."""
        for parameter in parameters_of(callee):
            key: Key = (*self.within, *self.chain, parameter)
            if key in self.ctx.state.given:
                continue
            setting = self.constraints.setting(key, parameter.type)
            value = setting.value
            if value is None and (setting.domain is not None or is_plain(parameter.type)):
                domain = setting.domain or all_values(parameter.type, parameter.span)
                name, type_ = f"{self.what}.{parameter.name}", lower_type(parameter.type)
                value = self.ctx.draw(name, domain, type_, parameter.span)
            if value is not None:
                self.ctx.state.given[key] = value
                continue
            self.ctx.unsupported(
                "OSC501",
                self.chain[-1].span,
                f"parameter `{parameter.name}` of modifier `{callee.qualified_name}` has no value",
                help="give it as an argument, or a default",
            )

    def part(self, statement: ast.Statement) -> tuple[Applied, ...]:
        """Lower one statement of the body."""
        match statement:
            case ast.ParameterDeclaration() | ast.RemoveDefault():
                return ()  # see `bind`
            case ast.MethodDeclaration():
                return ()  # calls replace its body
            case ast.EventDeclaration() | ast.VariableDeclaration() | ast.OnDirective():
                return ()  # see `with_events`
            case ast.KeepConstraint():
                pass  # the constraints of the scenario hold it, for this application
            case ast.ModifierApplication() if self._is_known(statement):
                return self.applied(statement)
            case ast.ModifierApplication():
                pass  # one of its parameters has no value, which is reported
            case _:
                self._refuse(
                    statement,
                    "a modifier with coverage in it",
                    "sample it in the scenario",
                )
        return ()

    def _is_known(self, node: ast.ModifierApplication) -> bool:
        place = self.ctx.place
        assert place is not None
        used = (place.locate(n) for n in nodes_below(node) if isinstance(n, ast.NameExpression))
        own = [key for key in used if key and key[:-1] == (*self.within, *self.chain)]
        return all(
            key in self.ctx.state.given
            or (isinstance(key[-1], sym.Symbol) and key[-1].name == "actor")
            for key in own
        )

    def _applies(self, node: ast.ModifierApplication, callee: sym.ModifierSymbol) -> bool:
        """Check the position of application: the actor, and the invoked behavior."""
        if node.actor is not None and self.action is not None:
            whose = lower_expression(self.ctx, node.actor)
            if whose is None:
                return False
            if self.actor is None or not _is_same(whose, self.actor):
                self._refuse(
                    node,
                    f"modifier `{node.modifier}` of another actor",
                    "apply it in the `with` of what that actor does",
                )
                return False
        target = callee.target
        fits = target is None or self.action is None or is_subtype(self.action, target)
        if self.chain and target is not None and not fits and self.action is not None:
            self.ctx.sink.report(
                "OSC406",
                self.chain[0].span,
                f"modifier `{node.modifier}` does not apply to `{self.action.qualified_name}`",
                notes=[f"it modifies `{target.qualified_name}`"],
                help=instead_of_scenario(
                    self.action, self.chain[0].modifier.text, self.chain[0].span.text
                ),
            )
        return fits or not self.chain

    def _refuse(self, node: ast.Node, what: str, help: str | None) -> None:
        self.ctx.unsupported("OSC508", node.span, f"{what} is not supported", help)


def _is_same(one: ir.Expression, other: ir.Expression) -> bool:
    """Whether two expressions name the same actor."""
    if isinstance(one, ir.FieldRef) and isinstance(other, ir.FieldRef):
        return one.name == other.name
    return one.span.text == other.span.text
