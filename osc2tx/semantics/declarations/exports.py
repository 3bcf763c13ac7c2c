"""Exports of namespaces (§7.7.4)."""

from __future__ import annotations

from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.builtins import COMPOSITION
from osc2tx.semantics.declarations.members import members_of
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import Context, Scope
from osc2tx.semantics.symbols import EnumSymbol, EventSymbol, MethodSymbol, Symbol, TypeSymbol
from osc2tx.syntax import ast

Definitions = dict[str, set[str]]


def resolve_exports(r: Resolution) -> None:
    """Fill the export lists; a name that is used itself is passed on under its own namespace."""
    if not r.scope.named_exports:
        return
    homes = _homes(r.scope)
    pending = list(r.scope.named_exports)
    while pending:
        left = [entry for entry in pending if not _resolve(r.scope, homes, *entry)]
        if len(left) == len(pending):
            break
        pending = left
    for item, context in pending:
        _report(r, homes, item, context)


def _homes(scope: Scope) -> Definitions:
    """Return the namespaces in which each name is defined."""
    homes: Definitions = {}

    def add(symbol: Symbol) -> None:
        homes.setdefault(symbol.name, set()).add(symbol.namespace)

    for layer in scope.layers():
        for symbol in layer.declared:
            add(symbol)
            if isinstance(symbol, EnumSymbol):
                for item in symbol.members.values():
                    add(item)
            elif isinstance(symbol, TypeSymbol):
                for member in symbol.members.values():
                    add(member)
                    if isinstance(member, EventSymbol | MethodSymbol):
                        for parameter in member.parameters:
                            add(parameter)
        for extension in layer.extensions:
            if isinstance(extension, ast.TypeExtension):
                context = scope.context_of(extension)
                for statement in extension.members:
                    for member in members_of(statement, COMPOSITION, context, "user"):
                        add(member)
    return homes


def _resolve(scope: Scope, homes: Definitions, item: ast.ExportItem, context: Context) -> bool:
    name = item.name
    assert name is not None
    defined = homes.get(name, set())
    if item.namespace is not None:
        found = defined & {item.namespace}
    elif context.namespace in defined:
        found = {context.namespace}
    else:
        found = {
            home for home in defined if any(_offers(scope, ns, home, name) for ns in context.uses)
        }
    offered = scope.exports.setdefault(context.namespace, set())
    offered |= {(home, name) for home in found}
    return bool(found)


def _offers(scope: Scope, namespace: str, home: str, name: str) -> bool:
    return any(
        item in layer.exports.get(namespace, ())
        for layer in scope.layers()
        for item in ((home, name), (home, None))
    )


def _report(r: Resolution, homes: Definitions, item: ast.ExportItem, context: Context) -> None:
    namespace = item.namespace or context.namespace
    if not r.scope.has_namespace(namespace):
        r.report("OSC206", item.span, f"no namespace `{namespace}`")
        return
    r.report(
        "OSC214",
        item.span,
        f"namespace `{namespace}` has no `{item.name}` to export",
        help=name_meant(item.span, [n for n, found in homes.items() if namespace in found]),
    )
