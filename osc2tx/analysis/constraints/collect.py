"""The constraints that hold in a type, in the order of the text (§7.3.11, §7.6.2.3).

For a type these are: the `keep`s of its body and of its bases, defaults and `with` blocks of its
fields, arguments and `with` blocks of its invocations and modifier applications; and, for fields
and invocations of user-defined types, the constraints of these types.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias

from osc2tx.analysis.constraints.constraint import Constraint, ConstraintWriter, Entry, Removal
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.constraints.specialisation import Special
from osc2tx.analysis.tree_walk import do_members
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.builtins import DURATION
from osc2tx.semantics.conversions import symbol_of
from osc2tx.semantics.model import Binding
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

Operator = ast.CompositionOperator

DEEPEST_MEMBER = 4  # levels of user-defined structs below a field

Instance: TypeAlias = ast.Invocation | ast.ModifierApplication


Shared: TypeAlias = "dict[sym.TypeSymbol, tuple[list[Entry], Mapping[Key, sym.TypeSymbol]]]"
"""The constraints of each type itself, and the objects in them."""


class Collector:
    """Collects the constraints of types.

    Args:
        model: The checked program.
        special: The conditional types that objects are known to be of.
        shared: The constraints of types themselves, which derived types share.
    """

    def __init__(
        self,
        model: SemanticModel,
        special: Mapping[Key, tuple[Special, ...]] | None = None,
        shared: Shared | None = None,
    ) -> None:
        self._model = model
        self._write = ConstraintWriter(model)
        self._special = special or {}
        self._shared = {} if shared is None or special else shared
        self._files = {file.span.source: number for number, file in enumerate(model.files)}
        self.objects: dict[Key, sym.TypeSymbol] = {}

    def collect(self, owner: sym.TypeSymbol) -> list[Entry]:
        """Return the constraints on an instance of a type, in the order of the text."""
        own = list(self._of_own_actor(owner))
        for ancestor in reversed(list(supertypes(owner))):
            entries, objects = self._of_ancestor(ancestor)
            own += entries
            self.objects |= objects
        return [*self._of_globals(own), *own]

    def _of_ancestor(
        self, ancestor: sym.TypeSymbol
    ) -> tuple[list[Entry], Mapping[Key, sym.TypeSymbol]]:
        """Return the constraints of a type itself, and of the objects in it."""
        if ancestor not in self._shared:
            it = None if isinstance(ancestor, sym.ModifierSymbol) else ()
            place = Place(model=self._model, owner=ancestor, prefix=(), it=it)
            others, self.objects = self.objects, {}
            entries = list(self._of_own(place, ancestor, depth=0))
            self._shared[ancestor] = entries, self.objects
            self.objects = others
        return self._shared[ancestor]

    def _of_own_actor(self, owner: sym.TypeSymbol) -> Iterator[Entry]:
        """Yield the constraints of modifiers that are members of the type of a behavior's actor."""
        actor = owner.actor if isinstance(owner, sym.ScenarioSymbol | sym.ActionSymbol) else None
        for ancestor in () if actor is None else supertypes(actor):
            place = Place(model=self._model, owner=ancestor, prefix=(), it=None)
            for statement in ancestor.statements:
                if isinstance(statement, ast.ModifierApplication):
                    yield from self._of_instance(place, statement, statement.arguments)

    def collect_global(self, parameter: sym.FieldSymbol) -> list[Entry]:
        """Return the constraints on a global parameter, and on those that it depends on."""
        place = Place(model=self._model, owner=None, prefix=(), it=None)
        own: list[Entry] = []
        if isinstance(parameter.node, ast.ParameterDeclaration):
            own = list(self._of_field(place, parameter, parameter.node, depth=0))
        others = [e for e in self._of_globals(own) if e not in own]
        return [*others, *own]

    def collect_globals(self) -> list[Entry]:
        """Return the constraints on the global parameters of the program."""
        place = Place(model=self._model, owner=None, prefix=(), it=None)
        return [
            entry
            for symbol in self._model.global_parameters
            if isinstance(symbol.node, ast.ParameterDeclaration)
            for entry in self._of_field(place, symbol, symbol.node, depth=0)
        ]

    def _of_globals(self, entries: list[Entry]) -> list[Entry]:
        """Return the constraints on the global parameters that some constraints mention."""
        place = Place(model=self._model, owner=None, prefix=(), it=None)
        found: list[Entry] = []
        seen: set[Key] = set()
        while entries:
            keys = {
                (k[0],) for e in entries if isinstance(e, Constraint) for k in e.operations.keys
            }
            entries = []
            for key in sorted(keys - seen, key=lambda k: k[0].span.start):
                seen.add(key)
                match key[0]:
                    case sym.FieldSymbol(owner=None, node=ast.ParameterDeclaration() as node):
                        entries += self._of_field(place, key[0], node, depth=0)
            found = [*entries, *found]
        return found

    def _of_type(self, place: Place, owner: sym.TypeSymbol, depth: int) -> Iterator[Entry]:
        for ancestor in reversed(list(supertypes(owner))):
            yield from self._of_own(place, ancestor, depth)

    def _of_own(self, place: Place, ancestor: sym.TypeSymbol, depth: int) -> Iterator[Entry]:
        yield from self._of_condition(place, ancestor)
        for statement in self._in_order_of_text(ancestor):
            yield from self._of_statement(place, ancestor, statement, depth)

    def _in_order_of_text(self, type_: sym.TypeSymbol) -> list[ast.Statement]:
        """Return the members of a type; an extension may precede it (§7.3.11.3.2)."""
        return sorted(
            type_.statements,
            key=lambda each: (self._files.get(each.span.source, -1), each.span.start),
        )

    def _of_condition(self, place: Place, type_: sym.TypeSymbol) -> Iterator[Entry]:
        """Yield the constraints on all instances of a type with conditional inheritance."""
        match type_:
            case (
                sym.StructSymbol(condition=ast.InheritanceCondition() as condition)
                | sym.ActorSymbol(condition=ast.InheritanceCondition() as condition)
                | sym.ScenarioSymbol(condition=ast.InheritanceCondition() as condition)
                | sym.ActionSymbol(condition=ast.InheritanceCondition() as condition)
            ):
                field = self._model.symbol_of(condition.field)
                if isinstance(field, sym.FieldSymbol):
                    key = (*place.prefix, field)
                    yield self._write.setting(place, key, field.type, condition.value, "condition")

    def _of_statement(
        self, place: Place, ancestor: sym.TypeSymbol, statement: ast.Statement, depth: int
    ) -> Iterator[Entry]:
        match statement:
            case ast.ParameterDeclaration():
                for member in (m for name in statement.names for m in ancestor.named(name.text)):
                    if isinstance(member, sym.FieldSymbol) and member.node is statement:
                        yield from self._of_field(place, member, statement, depth)
            case ast.KeepConstraint() | ast.RemoveDefault():
                yield from self._write.rule(place, statement)
            case ast.ModifierApplication():
                yield from self._of_instance(place, statement, statement.arguments)
            case ast.DoDirective() if depth == 0:
                yield from self._of_tree(place, statement)

    def _of_field(
        self, place: Place, field: sym.FieldSymbol, node: ast.ParameterDeclaration, depth: int
    ) -> Iterator[Entry]:
        key = (*place.prefix, field)
        type_ = symbol_of(field.type)
        if key in place.handed_in:
            yield from self._of_with_field(replace(place, it=key, it_type=type_), node)
            return
        if isinstance(type_, sym.ActorSymbol) and isinstance(node.default, ast.NameExpression):
            # Another actor, whose declaration has all its constraints.
            yield from self._of_with_field(replace(place, it=key, it_type=type_), node)
            return
        is_ours = type_ is not None and any(not t.is_as_library for t in supertypes(type_))
        for element in self._model.elements.get(field, ()) if len(key) == 1 else ():
            yield from self._of_element(place, element, depth)
        if type_ is not None and is_ours and depth < DEEPEST_MEMBER:
            inner = replace(place, owner=type_, prefix=key, it=key)
            entries = self._of_type(inner, type_, depth + 1)
            is_invoked = not isinstance(type_, sym.BehaviorSymbol)
            yield from (each for each in entries if is_invoked or _is_about_values(each, key))
        if isinstance(type_, sym.StructSymbol | sym.ActorSymbol):
            self.objects[key] = type_
        for special in self._special.get(key, ()):
            inner = replace(place, owner=special, prefix=key, it=key)
            for statement in special.statements:
                yield from self._of_statement(inner, special, statement, depth + 1)
        if node.default is not None and node.default not in self._model.quantities:
            yield self._write.setting(place, key, field.type, node.default, "default value")
        yield from self._of_with_field(replace(place, it=key, it_type=type_), node)

    def _of_element(self, place: Place, element: sym.FieldSymbol, depth: int) -> Iterator[Entry]:
        """Yield the constraints of the type of an element on a list."""
        type_, key = symbol_of(element.type), (element,)
        if isinstance(type_, sym.StructSymbol | sym.ActorSymbol):
            self.objects[key] = type_
        if type_ is not None and any(not each.is_as_library for each in supertypes(type_)):
            inner = replace(place, owner=type_, prefix=key, it=key)
            yield from self._of_type(inner, type_, depth + 1)

    def _of_with_field(self, inside: Place, node: ast.ParameterDeclaration) -> Iterator[Entry]:
        for rule in node.constraints:
            if isinstance(rule, ast.KeepConstraint | ast.RemoveDefault):
                yield from self._write.rule(inside, rule)

    # --- invocations ---

    def _of_tree(self, place: Place, directive: ast.DoDirective) -> Iterator[Entry]:
        for member in do_members(directive.member):
            match member:
                case ast.Invocation():
                    yield from self._of_instance(place, member, member.arguments)
                    yield from self._of_with(place, member, member.with_members)
                case ast.Composition():
                    yield from self._of_composition(place, member)
                    yield from self._of_with(place, member, member.with_members)
                case _:
                    continue

    def _of_composition(self, place: Place, node: ast.Composition) -> Iterator[Entry]:
        """Yield the value of the duration of a composition, if a constraint can mention it."""
        for argument in node.arguments if _is_mentioned_in(node.with_members) else ():
            is_first = argument.name is None and node.operator is not Operator.PARALLEL
            if is_first or (argument.name is not None and argument.name.text == DURATION.name):
                key = (*place.prefix, node, DURATION)
                yield self._write.setting(place, key, DURATION.type, argument.value, "argument")

    def _of_with(
        self,
        place: Place,
        node: ast.Invocation | ast.Composition,
        members: tuple[ast.WithMember, ...],
    ) -> Iterator[Entry]:
        binding = self._model.bindings.get(node)
        callee = binding.callee if binding is not None else None
        it_type = callee if isinstance(callee, sym.TypeSymbol) else None
        inside = replace(place, it=(*place.prefix, node), it_type=it_type)
        for member in members:
            match member:
                case ast.KeepConstraint() | ast.RemoveDefault():
                    yield from self._write.rule(inside, member)
                case ast.ModifierApplication():
                    yield from self._of_instance(inside, member, member.arguments)
                case ast.UntilDirective():
                    continue

    def _of_instance(
        self, place: Place, node: Instance, arguments: tuple[ast.Argument, ...]
    ) -> Iterator[Entry]:
        """Yield the callee's constraints on its parameters, and the values of the arguments."""
        binding = self._model.bindings.get(node)
        if binding is None or not isinstance(binding.callee, sym.BehaviorSymbol):
            return
        callee = binding.callee
        prefix = (*place.prefix, node)
        if node in place.prefix:
            return  # a modifier that applies itself
        if callee.origin == "user":
            # In a modifier `it` is the modified behavior (§7.3.12).
            it = place.it if isinstance(callee, sym.ModifierSymbol) else prefix
            handed_in = {**place.handed_in, **dict(_objects(place, prefix, binding))}
            inner = replace(
                place, owner=callee, prefix=prefix, it=it, it_type=None, handed_in=handed_in
            )
            yield from self._of_type(inner, callee, depth=1)
        elif added := [each for t in supertypes(callee) for each in t.added]:
            inner = replace(place, owner=callee, prefix=prefix, it=prefix, it_type=None)
            for statement in added:
                yield from self._of_statement(inner, callee, statement, depth=1)
        elif not _can_be_constrained(node):
            return
        for parameter, value in binding.arguments:
            if isinstance(parameter, sym.FieldSymbol):
                key = (*prefix, parameter)
                yield self._write.setting(place, key, parameter.type, value, "argument")


def _objects(place: Place, prefix: Key, binding: Binding) -> Iterator[tuple[Key, Key]]:
    """Yield the parameters of a callee that are objects, each with the passed object."""
    for parameter, value in binding.arguments:
        if isinstance(parameter, sym.FieldSymbol) and isinstance(
            symbol_of(parameter.type), sym.ActorSymbol | sym.StructSymbol
        ):
            key = place.locate(value)
            if key is not None:
                yield (*prefix, parameter), key


def _can_be_constrained(node: Instance) -> bool:
    """Whether some constraint can mention the parameters of a library behavior or modifier."""
    if isinstance(node, ast.ModifierApplication):
        return False
    return node.label is not None or _is_mentioned_in(node.with_members)


def _is_mentioned_in(members: tuple[ast.WithMember, ...]) -> bool:
    """Whether a constraint of a `with`, or of a modifier in it, can mention parameters by `it`."""
    return any(isinstance(m, ast.KeepConstraint | ast.ModifierApplication) for m in members)


def _is_about_values(entry: Entry, behavior: Key) -> bool:
    """Whether an entry is about the values of a behavior that nothing invokes (§7.2.2.2).

    It has no objects, so constraints on their members apply to nothing.
    """
    if isinstance(entry, Removal):
        keys: list[Key | None] = [entry.subject]
    else:
        keys = [each.key for each in entry.operations.items]
    depth = len(behavior)
    return all(len(key) <= depth + 1 for key in keys if key is not None and key[:depth] == behavior)
