"""Modifiers of all that an actor does: members of scenarios and of actors (§7.3.12.4).

One in the `with` of a composition is a member of a scenario that consists of it (§7.3.12.1.2).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from osc2tx import ir
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.lowering.behavior.composed_behaviors import actor_type_of, is_composed
from osc2tx.lowering.behavior.reactions import Attached
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.modifiers.composition_modifiers import with_edge
from osc2tx.lowering.modifiers.modifiers import is_override
from osc2tx.lowering.modifiers.user_modifiers import Applied, ModifierLowering
from osc2tx.lowering.placement.initial_placement import can_place, owner_of
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import is_subtype, supertypes
from osc2tx.semantics.types import ActorType
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

_COMPARING = ("distance", "change_lane", "change_speed")
"""Modifiers that compare the end with the start."""


@dataclass(frozen=True, slots=True)
class Standing:
    """A modifier in such a position.

    Attributes:
        node: The application.
        what: Its owner, for names of values that are drawn from ranges.
        actor: The actor of the modified behavior, where the modifier does not name it.
        it: The meaning of `it` in its body.
        within: The object whose type has it as a member.
        receiver: The same as a value.
        composition: The composition whose `with` contains it.
    """

    node: ast.ModifierApplication
    what: str
    actor: ir.Expression | None
    it: Key | None = None
    within: Key = ()
    receiver: Receiver | None = None
    composition: ast.Composition | None = None


class StandingModifiers:
    """The standing modifiers of one scenario, each lowered once."""

    def __init__(self, ctx: LoweringContext, constraints: ConstraintLowering) -> None:
        """Store the checked program and the constraints of the scenario.

        `attached` collects the reactions beside the `do` of the scenario.
        """
        self._ctx = ctx
        self._constraints = constraints
        self._around: list[ast.Composition] = []
        self._lowered: dict[tuple[ast.Node, Key], tuple[Applied, ...]] = {}
        self._used: set[ast.Node] = set()
        self._whole: set[tuple[ast.Node, str, str]] = set()
        self.attached = Attached(is_whole=True)
        self._attached: dict[ast.Composition, Attached] = {}

    @contextmanager
    def inside(self, node: ast.Composition) -> Iterator[None]:
        """Apply the modifiers of a composition to its members."""
        self._around.append(node)
        yield
        self._around.pop()
        for standing in self._of_composition(node):
            for applied in self._lower(standing):
                if applied.call.at == "all" and standing.node not in self._used:
                    self._refuse(standing, applied.call)
                    break

    def with_edges(self, node: ast.Composition, made: ir.Composition) -> ir.Composition:
        """Return a composition with its modifiers that hold at its start or its end alone."""
        for standing in self._of_composition(node):
            changed = self._with_edge(standing, made)
            assert isinstance(changed, ir.Serial | ir.Parallel | ir.OneOf)
            made = changed
        return made

    def with_edges_of_members(self, made: ir.Behavior) -> ir.Behavior:
        """Return the `do` of the scenario with its members that hold at the start or end alone."""
        for standing in self._of_scenario():
            made = self._with_edge(standing, made)
        return made

    def _with_edge(self, standing: Standing, made: ir.Behavior) -> ir.Behavior:
        for applied in self._lower(standing):
            if applied.call.at == "all" or not self._is_edge(standing, applied.call):
                continue
            acting = [n for n in ir.invocations(made) if n.actor_name == _name_of(applied)]
            if applied.call.name in _COMPARING and len(acting) > 1:
                self._refuse_whole(standing.node, applied.call)
                break
            target = applied.target
            is_known = target is None or target.origin != "user"
            changed = with_edge(made, applied.call, _name_of(applied)) if is_known else None
            if changed is None:
                self._refuse(standing, applied.call)
                break
            made = changed
        return made

    def _is_edge(self, standing: Standing, call: ir.ModifierCall) -> bool:
        """Whether a modifier `at: start` or `at: end` is that of the first or the last action.

        Starts of scenarios are placements; members of actors hold for each of their actions.
        """
        if standing.composition is not None:
            return True
        return standing.receiver is None and not self._is_start(standing.node) and stands(call)

    def attached_to(self, node: ast.Composition) -> Attached:
        """Return the reactions that the modifiers of a composition attach to it."""
        return self._attached.setdefault(node, Attached())

    def of(
        self, actor: ir.Expression | None, action: sym.BehaviorSymbol | None = None
    ) -> Iterator[ir.ModifierCall]:
        """Yield the modifiers of the invocations of an actor here.

        Args:
            actor: The actor.
            action: The invoked action; with `None` any.
        """
        for standing, call in self._calls(actor, action):
            if _is_of_the_whole(call):
                self._note_whole(standing.node, call, actor)
            yield call

    def _note_whole(
        self, node: ast.ModifierApplication, call: ir.ModifierCall, actor: ir.Expression | None
    ) -> None:
        """Refuse what one action alone has to meet, if several in a row would meet it each."""
        whose = (node, call.name, actor.name if isinstance(actor, ir.FieldRef) else "")
        if whose in self._whole:
            self._refuse_whole(node, call)
        self._whole.add(whose)

    def _refuse_whole(self, node: ast.ModifierApplication, call: ir.ModifierCall) -> None:
        self._ctx.unsupported(
            "OSC508",
            node.span,
            f"`{call.name}` is about all that several actions do together",
            help="apply it in the `with` of one of them, or leave one action",
        )

    def _calls(
        self, actor: ir.Expression | None, action: sym.BehaviorSymbol | None
    ) -> Iterator[tuple[Standing, ir.ModifierCall]]:
        if not isinstance(actor, ir.FieldRef):
            return
        for standing in self._standing(actor):
            if self._is_start(standing.node):
                continue
            for applied in self._lower(standing):
                if applied.call.at != "all" and self._is_edge(standing, applied.call):
                    continue
                is_meant = _name_of(applied) == actor.name and _fits(applied, action)
                if is_meant and stands(applied.call):
                    self._used.add(standing.node)
                    yield standing, applied.call

    def not_known_to(
        self, actor: ir.Expression | None, type_: sym.ActorSymbol | None
    ) -> Iterator[ir.ModifierCall]:
        """Yield the modifiers of an actor here, except in a behavior that has it as an argument."""
        known = tuple(supertypes(type_)) if type_ is not None else ()
        of_type = {statement for each in known for statement in each.statements}
        for standing, call in self._calls(actor, None):
            if standing.node not in of_type:
                yield call

    def of_member(self, node: ast.ModifierApplication) -> tuple[Applied, ...]:
        """Return the meaning of a member of the scenario."""
        return self._lower(_member(node))

    def _standing(self, actor: ir.FieldRef) -> Iterator[Standing]:
        yield from self._of_type(actor)
        yield from self._of_scenario()
        for node in self._around:
            yield from self._of_composition(node)

    def _of_scenario(self) -> Iterator[Standing]:
        owner = self._constraints.found.owner
        for ancestor in () if owner is None else reversed(list(supertypes(owner))):
            for statement in ancestor.statements:
                if isinstance(statement, ast.ModifierApplication):
                    yield _member(statement)

    def _of_composition(self, node: ast.Composition) -> Iterator[Standing]:
        what = node.label.text if node.label is not None else node.operator.value
        for member in node.with_members:
            if isinstance(member, ast.ModifierApplication):
                yield Standing(member, what, None, it=(node,), composition=node)

    def _of_type(self, actor: ir.FieldRef) -> Iterator[Standing]:
        """Yield the members of the type of an actor."""
        key, type_ = self._known(actor)
        for ancestor in () if type_ is None else reversed(list(supertypes(type_))):
            for statement in ancestor.statements:
                if isinstance(statement, ast.ModifierApplication):
                    assert type_ is not None
                    receiver = Receiver(type_, actor)
                    yield Standing(statement, actor.name, actor, key or None, key, receiver)

    def _known(self, actor: ir.FieldRef) -> tuple[Key, sym.ActorSymbol | None]:
        """Return the name of an actor in the analysis, and its type; `actor` has no name there."""
        owner = self._constraints.found.owner
        if actor.name == "actor" and is_composed(owner):
            return (), actor_type_of(owner)
        members = [
            *(m for each in (supertypes(owner) if owner else ()) for m in each.named(actor.name)),
            *(each for name, each in self._ctx.state.globals.items() if name == actor.name),
            *(
                each
                for elements in self._ctx.model.elements.values()
                for each in elements
                if (each.name, each.owner) == (actor.name, owner)
            ),
        ]
        for member in members:
            if isinstance(member, sym.FieldSymbol) and isinstance(member.type, ActorType):
                return (member,), member.type.symbol
        return (), None

    def _lower(self, standing: Standing) -> tuple[Applied, ...]:
        key = (standing.node, standing.within)
        callee = self._ctx.model.binding_of(standing.node).callee
        is_modifier = isinstance(callee, sym.ModifierSymbol)
        if not is_modifier or is_override(self._ctx, standing.node):
            return ()
        if key not in self._lowered:
            ctx = self._ctx if standing.receiver is None else self._ctx.inside(standing.receiver)
            lowering = ModifierLowering(
                *(ctx, self._constraints, standing.what, standing.actor, None),
                it=standing.it,
                within=standing.within,
                attached=(
                    self.attached
                    if standing.composition is None
                    else self.attached_to(standing.composition)
                ),
            )
            self._lowered[key] = lowering.applied(standing.node)
        return self._lowered[key]

    def _is_start(self, node: ast.ModifierApplication) -> bool:
        """Whether a modifier of the library is about the start alone."""
        callee = self._ctx.model.binding_of(node).callee
        states_start = any(
            a.name is not None and a.value.span.text == "start" for a in node.arguments
        )
        return callee.origin != "user" and states_start

    def _refuse(self, standing: Standing, call: ir.ModifierCall) -> None:
        whole = "scenario" if standing.composition is None else "composition"
        self._ctx.unsupported(
            "OSC508",
            standing.node.span,
            (
                f"no action in this {whole} is modified by `{call.name}`"
                if call.at == "all"
                else f"no action surely {call.at}s with this {whole}, to meet `{call.name}`"
            ),
            help="apply it in the `with` of the actions in it",
        )


def _member(node: ast.ModifierApplication) -> Standing:
    return Standing(node, node.actor.span.text if node.actor else "actor", None)


def _name_of(applied: Applied) -> str:
    return applied.actor.name if isinstance(applied.actor, ir.FieldRef) else "actor"


def stands(call: ir.ModifierCall) -> bool:
    """Whether a modifier holds for longer than the start, and is one of actions."""
    return not (call.at == "start" and can_place(call)) and not owner_of(call)


def _is_of_the_whole(call: ir.ModifierCall) -> bool:
    """Whether a modifier compares the end of what it modifies with its start, or is a place then.

    Each of several actions would meet it: twice the distance, twice the number of lanes.
    """
    return call.name in _COMPARING or (call.name == "position" and call.at == "end")


def _fits(applied: Applied, action: sym.BehaviorSymbol | None) -> bool:
    return action is None or applied.target is None or is_subtype(action, applied.target)
