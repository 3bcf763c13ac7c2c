"""Extensions: members added to a type from outside (§7.3.9)."""

from __future__ import annotations

from osc2tx.semantics.declarations.collect import Collector
from osc2tx.semantics.declarations.resolve_types import resolve_behavior_name, resolve_type_name
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import Context
from osc2tx.semantics.symbols import (
    ActorSymbol,
    EnumSymbol,
    PrimitiveSymbol,
    StructSymbol,
    TypeSymbol,
)
from osc2tx.syntax import ast


def apply_extension(
    r: Resolution,
    collector: Collector,
    node: ast.EnumExtension | ast.TypeExtension | ast.PrimitiveExtension,
) -> None:
    """Add the declarations of an extension to its type (§7.3.9)."""
    context = r.scope.contexts[node]
    match node:
        case ast.EnumExtension():
            enum = resolve_type_name(r, node.name, context)
            if isinstance(enum, EnumSymbol):
                _note_extended(r, enum)
                collector.collect_enum_members(enum, node.members, context)
            elif enum is not None:
                r.report("OSC321", node.name.span, f"`{node.name}` is not an enum")
        case ast.PrimitiveExtension():
            r.needs_standard(node.span, f"`extend {node.primitive}`")
            primitive = _primitive(r, node)
            collector.collect_body(primitive, node.members, context, extends=True)
        case ast.TypeExtension():
            target = _extended_type(r, node, context)
            if target is not None:
                _check_members(r, target, node)
                _note_extended(r, target)
                if collector.origin == "user" != target.origin:
                    target.is_extended = True
                collector.collect_body(target, node.members, context, extends=True)


def _primitive(r: Resolution, node: ast.PrimitiveExtension) -> PrimitiveSymbol:
    known = r.scope.primitive_named(node.primitive)
    if known is None:
        known = PrimitiveSymbol(name=node.primitive, namespace="null", span=node.span)
        r.scope.primitives[node.primitive] = known
    elif known not in r.scope.primitives.values():
        _note_extended(r, known)
    return known


def _note_extended(r: Resolution, symbol: TypeSymbol | EnumSymbol) -> None:
    if symbol not in r.scope.nodes and symbol not in r.scope.extended:
        r.scope.extended.append(symbol)


def _extended_type(r: Resolution, node: ast.TypeExtension, context: Context) -> TypeSymbol | None:
    if node.name.actor is None and not r.scope.types_named(node.name.name.text):
        modifiers = r.scope.modifiers_named(node.name.name.text)
        if modifiers:
            _report_modifier(r, node)
            return None
    if node.name.actor is not None:
        modifiers = r.scope.modifiers_named(node.name.name.text)
        if modifiers and not r.scope.behaviors_named(node.name.name.text):
            _report_modifier(r, node)
            return None
        return resolve_behavior_name(r, node.name, context)
    symbol = resolve_type_name(r, node.name.name, context)
    if symbol is None or isinstance(symbol, TypeSymbol):
        return symbol
    r.report("OSC321", node.name.span, f"`{node.name}` has no members that could be extended")
    return None


def _check_members(r: Resolution, target: TypeSymbol, node: ast.TypeExtension) -> None:
    if isinstance(target, StructSymbol | ActorSymbol):
        for member in node.members:
            if isinstance(member, ast.DoDirective | ast.OnDirective):
                r.report("OSC321", member.span, f"`{target.name}` is not a behavior")


def _report_modifier(r: Resolution, node: ast.TypeExtension) -> None:
    r.report(
        "OSC321",
        node.name.span,
        f"`{node.name}` is a modifier; it cannot be extended",
        help="add the members where it is declared, or declare a modifier of another name",
    )
