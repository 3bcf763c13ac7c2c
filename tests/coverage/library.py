"""The items of the standard library: actions, modifiers, methods, fields, with their versions.

The items are those of the library's own text; what the runtime carries out says its table; where an
item is used say the scenarios.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from osc2tx import ir, stdlib
from osc2tx.syntax import ast
from tests.coverage.sources import Source, children, scenarios

STANDARDS = ("2.1", "2.2")

Kind = Literal["action", "modifier", "method", "field"]
KINDS: tuple[Kind, ...] = ("action", "modifier", "method", "field")


@dataclass
class Item:
    """An item of the library.

    Attributes:
        kind: What it is.
        name: `vehicle.drive`; a modifier of any actor is `position`.
        parameters: Its parameters, in the latest version that has it.
        standards: The versions that have it.
        used: Scenarios that use it.
    """

    kind: Kind
    name: str
    parameters: tuple[str, ...]
    standards: list[str] = field(default_factory=list)
    used: list[Source] = field(default_factory=list)


def heirs(kind: str) -> Sequence[str]:
    """Return an actor and all that inherit from it, in the order of the library."""
    found = [kind]
    for statement in stdlib.library_file(stdlib.DOMAIN, STANDARDS[-1]).statements:
        if not isinstance(statement, ast.ActorDeclaration | ast.StructDeclaration):
            continue
        if str(statement.base) in found:
            found.append(str(statement.name))
    return found


def declared_items() -> Sequence[Item]:
    """Return all items, by kind and then in the order of the library."""
    found: dict[tuple[Kind, str], Item] = {}
    for standard in STANDARDS:
        for name in stdlib.LIBRARY:
            for kind, item, parameters in _items(stdlib.library_file(name, standard)):
                known = found.setdefault((kind, item), Item(kind, item, parameters))
                known.parameters = parameters
                known.standards.append(standard)
    return sorted(found.values(), key=lambda item: KINDS.index(item.kind))


def items() -> Sequence[Item]:
    """Return the same, with the scenarios that use them."""
    found = {(item.kind, item.name): item for item in declared_items()}
    # In a scenario a modifier goes by its own name, without that of the actor.
    by_use = {
        (k, name.rpartition(".")[2] if k == "modifier" else name): (k, name) for k, name in found
    }
    for source in scenarios():
        for use in _used(source):
            if use in by_use:
                found[by_use[use]].used.append(source)
    return list(found.values())


def _items(file: ast.File) -> Iterator[tuple[Kind, str, tuple[str, ...]]]:
    for statement in file.statements:
        match statement:
            case ast.ActionDeclaration():
                yield "action", str(statement.name), _parameters(statement.members)
            case ast.ModifierDeclaration(name=name):
                # Movement modifiers are applied without the actor in their declared name.
                yield "modifier", str(name), _parameters(statement.members)
            case ast.ActorDeclaration() | ast.StructDeclaration():
                yield from _members(statement)


def _members(
    statement: ast.ActorDeclaration | ast.StructDeclaration,
) -> Iterator[tuple[Kind, str, tuple[str, ...]]]:
    for member in statement.members:
        match member:
            case ast.MethodDeclaration(name=name, parameters=parameters):
                own = tuple(parameter.name.text for parameter in parameters)
                yield "method", f"{statement.name}.{name}", own
            case ast.ParameterDeclaration(names=names) | ast.VariableDeclaration(names=names):
                for name in names:
                    yield "field", f"{statement.name}.{name}", ()


def _parameters(members: Sequence[ast.Node]) -> tuple[str, ...]:
    fields = [member for member in members if isinstance(member, ast.ParameterDeclaration)]
    return tuple(name.text for member in fields for name in member.names)


def _used(source: Source) -> Mapping[tuple[Kind, str], None]:
    """Items that a scenario uses, in its IR."""
    module = source.compilation.ir
    found: dict[tuple[Kind, str], None] = {}
    pending: list[object] = [] if module is None else list(module.scenarios)
    while pending:
        node = pending.pop()
        match node:
            case ir.Invoke(owner=owner, action=action):
                found["action", f"{owner}.{action}"] = None
            case ir.ModifierCall(name=name):
                found["modifier", name] = None
            case ir.MethodCall(owner=owner, method=method):
                found["method", f"{owner}.{method}"] = None
            case ir.Attribute(owner=owner, name=name):
                found["field", f"{owner}.{name}"] = None
            case ir.Actor(lineage=lineage, values=values):
                for value in values:
                    found |= {("field", f"{kind}.{value.path[0]}"): None for kind in lineage}
            case ir.Struct(type=type_, values=values):
                found |= {("field", f"{type_}.{value.path[0]}"): None for value in values}
        if type(node).__module__.startswith(ir.__name__):
            pending.extend(children(node))
    return found
