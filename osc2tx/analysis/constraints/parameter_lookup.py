"""The parameter that a name or path denotes at a position in the text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import is_subtype
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """The scope of an expression.

    Attributes:
        model: The checked program.
        owner: The type whose members plain names mean; `None` for global parameters.
        prefix: The instance of that type; empty for the analysed type.
        it: The meaning of `it`; `None` if it is not a parameter.
        it_type: The type of `it`, whose members plain names may mean too.
        handed_in: Parameters that are objects of the invoker, with these objects.
    """

    model: SemanticModel
    owner: sym.TypeSymbol | None
    prefix: Key
    it: Key | None
    it_type: sym.TypeSymbol | None = None
    handed_in: Mapping[Key, Key] = field(default_factory=dict)

    def locate(self, expression: ast.Expression) -> Key | None:
        """Return the parameter; `None` for other names, and for values that the world changes."""
        path: list[sym.Symbol] = []
        current = expression
        while isinstance(current, ast.MemberAccess | ast.Cast | ast.Index):
            if isinstance(current, ast.Index):
                base = self.locate(current.base)
                list_ = base[0] if base is not None and len(base) == 1 else None
                list_ = list_ if isinstance(list_, sym.Symbol) else None
                element = self.model.element_of(list_, current.index)
                return None if element is None else (element, *reversed(path))
            if isinstance(current, ast.Cast):  # of an object: it is the same one
                if not path:
                    return None
                current = current.base
                continue
            symbol = self.model.symbol_of(current)
            if not isinstance(symbol, sym.FieldSymbol) or symbol.is_variable:
                return None
            path.append(symbol)
            current = current.base
        root = self._root(current)
        if root and path and is_actor(path[-1]):
            receiver = self._receiver(root[-1])
            if receiver is not None:
                root = receiver
                path.pop()
        key = () if root is None else (*root, *reversed(path))
        return self.owned(key) or None  # the instance as a whole is no parameter of it

    def _receiver(self, node: sym.Symbol | ast.Node) -> Key | None:
        """Return the actor of an invocation: that of its receiver."""
        binding = self.model.bindings.get(node) if isinstance(node, ast.Invocation) else None
        receiver = None if binding is None else binding.receiver
        return None if receiver is None else self.locate(receiver)

    def owned(self, key: Key) -> Key:
        """Return a path below a parameter as a path below its passed object."""
        for length in range(len(key), 1, -1):
            if key[:length] in self.handed_in:
                return (*self.handed_in[key[:length]], *key[length:])
        return key

    def _root(self, expression: ast.Expression) -> Key | None:
        if isinstance(expression, ast.ItExpression):
            return self.it
        if not isinstance(expression, ast.NameExpression):
            return None
        symbol = self.model.symbol_of(expression)
        if isinstance(symbol, sym.LabelSymbol):
            return (*self.prefix, symbol.node)
        if not isinstance(symbol, sym.FieldSymbol) or symbol.is_variable:
            return None
        if symbol.owner is None:  # global, or built in: `actor`, `duration`
            is_global = symbol.node is not None
            return (symbol,) if is_global else (*self.prefix, symbol)
        if self.owner is not None and is_subtype(self.owner, symbol.owner):
            return (*self.prefix, symbol)
        if self.it is not None and self.it_type and is_subtype(self.it_type, symbol.owner):
            return (*self.it, symbol)
        return None


def is_actor(field: sym.Symbol) -> bool:
    """Whether a field is the implicit one of a behavior, its actor."""
    return isinstance(field, sym.FieldSymbol) and field.node is None and field.name == "actor"


def name_of(key: Key) -> str:
    """Return a parameter as one would write it, `obstacle_pose.position.x`."""
    return ".".join(part for item in key if (part := _name(item)))


def _name(item: sym.Symbol | ast.Node) -> str:
    match item:
        case sym.Symbol():
            return item.name
        case ast.Invocation() | ast.Composition() if item.label is not None:
            return item.label.text
        case ast.Invocation():
            return item.behavior.text
        case ast.ModifierApplication():
            return item.modifier.text
        case _:
            return ""


def is_of_scope(key: Key) -> bool:
    """Whether a parameter belongs to the type itself, not to an invocation in it."""
    return isinstance(key[0], sym.FieldSymbol)
