"""Which members of a `do` tree never end by themselves."""

from __future__ import annotations

from functools import cache

from osc2tx.analysis.library_facts import is_instant, is_open_ended, library_modifiers
from osc2tx.analysis.tree_walk import do_directives, do_members, nodes_below
from osc2tx.catalogue import catalogue
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.builtins import DURATION
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

MOST_ROUNDS = 50

Behavior = sym.ScenarioSymbol | sym.ActionSymbol


@dataclass(frozen=True, slots=True)
class Endings:
    """How the members of all `do` trees end.

    Attributes:
        endless: Members that continue until something around them ends them.
        endless_behaviors: Behaviors whose `do` does.
    """

    endless: frozenset[ast.BehaviorMember]
    endless_behaviors: frozenset[Behavior]


def find_endings(model: SemanticModel) -> Endings:
    """Judge all behaviors of the user's files."""
    behaviors = [
        symbol
        for symbol in model.symbols
        if isinstance(symbol, sym.ScenarioSymbol | sym.ActionSymbol)
    ]
    judge = _TerminationAnalysis(model)
    for _ in range(MOST_ROUNDS):  # as behaviors invoke each other
        known = len(judge.endless_behaviors)
        for behavior in reversed(behaviors):
            judge.judge(behavior)
        if len(judge.endless_behaviors) == known:
            break
    return Endings(frozenset(judge.endless), frozenset(judge.endless_behaviors))


class _TerminationAnalysis:
    def __init__(self, model: SemanticModel) -> None:
        self.model = model
        self.endless: set[ast.BehaviorMember] = set()
        self.endless_behaviors: set[Behavior] = set()
        self._instant: set[ast.BehaviorMember] = set()
        self._is_instant_action = cache(is_instant)
        self._is_open_ended_action = cache(is_open_ended)

    def judge(self, behavior: Behavior) -> None:
        for directive in do_directives(behavior):
            for member in reversed(list(do_members(directive.member))):
                if self._is_instant(member):
                    self._instant.add(member)
                if self._is_endless(member) and not (
                    member is directive.member and self._has_own_duration(behavior)
                ):
                    self.endless.add(member)
            if directive.member in self.endless:
                self.endless_behaviors.add(behavior)

    def _has_own_duration(self, behavior: Behavior) -> bool:
        return any(
            _states_own_duration(self.model, statement)
            for ancestor in supertypes(behavior)
            for statement in ancestor.statements
        )

    def _is_instant(self, member: ast.BehaviorMember) -> bool:
        match member:
            case ast.EmitDirective() | ast.CallDirective():
                return True
            case ast.WaitDirective():
                return False
            case ast.Invocation():
                callee = self._callee(member)
                return isinstance(callee, sym.ActionSymbol) and self._is_instant_action(callee)
            case ast.Composition():
                return all(child in self._instant for child in member.members)

    def _is_endless(self, member: ast.BehaviorMember) -> bool:
        match member:
            case ast.Composition():
                return not is_bounded(self.model, member) and self._has_endless_content(member)
            case ast.Invocation():
                return not is_bounded(self.model, member) and self._goes_on(self._callee(member))
            case _:
                return False

    def _has_endless_content(self, node: ast.Composition) -> bool:
        endless = [child in self.endless for child in node.members]
        match node.operator:
            case ast.CompositionOperator.SERIAL:
                return any(endless)
            case ast.CompositionOperator.ONE_OF:
                return all(endless)
            case ast.CompositionOperator.PARALLEL:
                return any(endless) and all(
                    child in self.endless or child in self._instant for child in node.members
                )

    def _goes_on(self, callee: sym.Symbol | None) -> bool:
        if isinstance(callee, sym.ActionSymbol) and not do_directives(callee):
            return self._is_open_ended_action(callee)
        return callee in self.endless_behaviors

    def _callee(self, node: ast.Invocation) -> sym.Symbol | None:
        binding = self.model.bindings.get(node)
        return binding.callee if binding is not None else None


def has_duration(node: ast.Composition | ast.Invocation) -> bool:
    """Whether an argument states how long a member takes."""
    first = "duration" if isinstance(node, ast.Composition) else ""
    if isinstance(node, ast.Composition) and node.operator is ast.CompositionOperator.PARALLEL:
        first = ""  # the first argument is the overlap
    names = (each.name.text if each.name is not None else first for each in node.arguments)
    return "duration" in names


def is_bounded(model: SemanticModel, node: ast.Composition | ast.Invocation) -> bool:
    """Whether a member has a duration, an `until` or a goal of its own."""
    return has_duration(node) or any(
        isinstance(member, ast.UntilDirective)
        or _constrains_duration(model, member)
        or _is_goal(model, member)
        for member in node.with_members
    )


def _is_goal(model: SemanticModel, member: ast.WithMember) -> bool:
    """Whether a modifier states a goal."""
    return isinstance(member, ast.ModifierApplication) and any(
        _bounds(modifier) or _applies_at_end(modifier)
        for modifier in library_modifiers(model, member)
    )


def _bounds(modifier: ast.ModifierApplication) -> bool:
    """Whether the state of a modifier bounds an open-ended action."""
    entry = catalogue().modifiers.get(modifier.modifier.text)
    return entry is not None and entry.bounds


def _applies_at_end(modifier: ast.ModifierApplication) -> bool:
    return any(
        argument.name is not None
        and argument.name.text == "at"
        and argument.value.span.text == "end"
        for argument in modifier.arguments
    )


def _states_own_duration(model: SemanticModel, member: ast.Statement) -> bool:
    """Whether a member of a scenario constrains how long that takes."""
    if isinstance(member, ast.ModifierApplication):
        return _constrains_duration(model, member)
    return isinstance(member, ast.KeepConstraint) and any(
        isinstance(node, ast.NameExpression) and model.symbol_of(node) is DURATION
        for node in nodes_below(member)
    )


def _constrains_duration(model: SemanticModel, member: ast.Statement) -> bool:
    """Whether a member constrains the duration, or applies a modifier that does."""
    if isinstance(member, ast.ModifierApplication):
        binding = model.bindings.get(member)
        callee = None if binding is None else binding.callee
        return isinstance(callee, sym.ModifierSymbol) and any(
            _constrains_duration(model, part)
            for part in callee.statements
            if isinstance(part, ast.KeepConstraint)
        )
    return isinstance(member, ast.KeepConstraint) and any(
        isinstance(node, ast.Name) and node.text == "duration" for node in nodes_below(member)
    )
