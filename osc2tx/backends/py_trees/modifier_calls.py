"""Which applications of modifiers defined by the user are calls of their functions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.py_trees.code import PyName
from osc2tx.backends.py_trees.naming import NameTable, identifier

Group: TypeAlias = (
    "tuple[ir.Application | None, ir.UserModifier | None, tuple[ir.ModifierCall, ...]]"
)
"""Consecutive modifiers of one application, with it, and with its modifier if they are its whole
result."""


class ModifierCalls:
    """Knows the functions of a module.

    Args:
        modifiers: The modifiers that have one.
        names: Names of the module.
    """

    def __init__(self, modifiers: Iterable[ir.UserModifier], names: NameTable) -> None:
        self._modifiers = {modifier.key: modifier for modifier in modifiers}
        self._names = names

    def fitting(
        self, application: ir.Application, calls: Sequence[ir.ModifierCall]
    ) -> ir.UserModifier | None:
        """Return the modifier whose function returns just these calls; `None` if it does not.

        Args:
            application: Where it is applied.
            calls: The library modifiers that remain there.
        """
        modifier = self._modifiers.get(application.key)
        given = {argument.parameter: argument.value for argument in application.arguments}
        if modifier is None or any(map(ir.is_live, given.values())):
            return None
        defaults = {p.name: p.default for p in modifier.parameters if p.default is not None}
        expected = ir.applied_with(modifier.calls, defaults | given)
        return modifier if ir.means_same(expected, tuple(calls)) else None

    def groups(self, calls: Iterable[ir.ModifierCall], depth: int) -> Iterator[Group]:
        """Yield the calls of one application together."""
        for application, group in groupby(calls, lambda call: call.application(depth)):
            parts = tuple(group)
            fitting = None if application is None else self.fitting(application, parts)
            yield application, fitting, parts

    def note(
        self, calls: Iterable[ir.ModifierCall], applied: set[str], called: set[str], depth: int = 0
    ) -> None:
        """Note the keys of the applied modifiers, and of the modifiers with fitting functions."""
        for application, modifier, parts in self.groups(calls, depth):
            if application is None:
                continue
            applied.add(application.key)
            if modifier is None:
                self.note(parts, applied, called, depth + 1)
            else:
                called.add(modifier.key)

    def name(self, modifier: ir.UserModifier) -> PyName:
        """Return the name of the function of a modifier."""
        return self._names[modifier.key]

    def arguments(
        self, modifier: ir.UserModifier, application: ir.Application
    ) -> list[tuple[PyName, ir.Expression]]:
        """Return the arguments of a call that are not the defaults of its parameters."""
        defaults = {p.name: p.default for p in modifier.parameters}
        hidden = self.hidden(modifier)
        return [
            (parameter_name(argument.parameter, hidden), argument.value)
            for argument in application.arguments
            if not ir.means_same(argument.value, defaults[argument.parameter])
        ]

    def hidden(self, modifier: ir.UserModifier) -> frozenset[str]:
        """Return the names that a function reads, which its parameters must not have."""
        applied = [each for call in modifier.calls for each in call.applied]
        values = [argument.value for call in modifier.calls for argument in call.arguments]
        values += [argument.value for each in applied for argument in each.arguments]
        values += [p.default for p in modifier.parameters if p.default is not None]
        parts = (part for value in values for part in ir.walk(value))
        units = (part.unit.name for part in parts if isinstance(part, ir.Quantity))
        called = (call.name for call in modifier.calls)
        others = (self._modifiers[each.key].name for each in applied)
        return frozenset(map(identifier, (*units, *called, *others)))


def never_called(module: ir.Module) -> set[str]:
    """Return the keys of modifiers that the scenarios of a file apply without one call of them.

    One that no scenario of the file applies is there for other files.
    """
    functions = ModifierCalls(module.modifiers, NameTable())
    nodes = [node for each in module.scenarios for node in ir.walk_behaviors(each.body)]
    every = (*module.bases, *module.scenarios)
    lists = [node.modifiers for node in nodes if isinstance(node, ir.Invoke)]
    lists += [placement.modifiers for each in every for placement in each.placements]
    applied, called = set[str](), set[str]()
    for calls in lists:
        functions.note(calls, applied, called)
    for modifier in module.modifiers:
        if modifier.key not in applied or modifier.key in called:
            functions.note(modifier.calls, applied, called)
    return applied - called


def parameter_name(name: str, hidden: frozenset[str]) -> PyName:
    """Name a parameter; one called `m` would hide the unit in `5 * m`."""
    wanted = identifier(name)
    return PyName(f"{wanted}_" if wanted in hidden else wanted)
