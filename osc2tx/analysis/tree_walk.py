"""Walking syntax trees, without recursion."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import fields
from operator import attrgetter
from typing import TypeVar, cast

from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast

SKIPPED = frozenset({"span", "comments", "trailing_comment", "comments_below", "end_comments"})
_PLAIN = frozenset({"str", "str | None", "float", "int", "bool", "int | float", "tuple[str, ...]"})
_FIELDS: dict[type[ast.Node], Callable[[ast.Node], tuple[object, ...]]] = {}
_N = TypeVar("_N", bound=ast.Node)


def do_members(root: ast.BehaviorMember) -> Iterator[ast.BehaviorMember]:
    """Yield a member of a `do` tree and all below it, in source order."""
    stack: list[ast.BehaviorMember] = [root]
    while stack:
        member = stack.pop()
        yield member
        if isinstance(member, ast.Composition):
            stack += reversed(member.members)


def do_directives(scenario: sym.ScenarioSymbol | sym.ActionSymbol) -> list[ast.DoDirective]:
    """Return the `do`s of a behavior, those of its bases first."""
    return [
        statement
        for ancestor in reversed(list(supertypes(scenario)))
        for statement in ancestor.statements
        if isinstance(statement, ast.DoDirective)
    ]


def nodes_below(root: ast.Node) -> Iterator[ast.Node]:
    """Yield a node and all below it, in source order."""
    stack: list[ast.Node] = [root]
    while stack:
        node = stack.pop()
        yield node
        stack += reversed(children_of(node))


def children_of(node: ast.Node) -> list[ast.Node]:
    """Return the nodes right below a node, in source order."""
    children: list[ast.Node] = []
    kind = node.__class__
    for value in (_FIELDS.get(kind) or _child_fields(kind))(node):
        if value.__class__ is tuple:
            children += value
        elif isinstance(value, ast.Node):
            children.append(value)
    return children


class NodesByKind:
    """The nodes of a tree by their classes: one walk for all searches."""

    def __init__(self, root: ast.Node, closed: tuple[type[ast.Node], ...] = ()) -> None:
        """Walk a tree.

        Args:
            root: Its root.
            closed: Classes of nodes below which nothing is looked at.
        """
        self._found: defaultdict[type[ast.Node], list[ast.Node]] = defaultdict(list)
        stack = [root]
        while stack:
            node = stack.pop()
            kind = type(node)
            self._found[kind].append(node)
            if kind not in closed:
                stack += reversed(children_of(node))

    def of(self, kind: type[_N]) -> list[_N]:
        """Return the nodes of a class, not of its subclasses, in source order."""
        return cast("list[_N]", self._found.get(kind, []))


def _child_fields(kind: type[ast.Node]) -> Callable[[ast.Node], tuple[object, ...]]:
    """Return a getter of the fields of a class that may hold a node or a tuple of nodes."""
    names = [
        field.name
        for field in fields(kind)
        if field.name not in SKIPPED and field.type not in _PLAIN
    ]
    read = attrgetter(*names) if names else _nothing
    _FIELDS[kind] = read if len(names) != 1 else _in_tuple(attrgetter(*names))
    return _FIELDS[kind]


def _in_tuple(read: Callable[[ast.Node], object]) -> Callable[[ast.Node], tuple[object, ...]]:
    return lambda node: (read(node),)


def _nothing(node: ast.Node) -> tuple[object, ...]:
    return ()
