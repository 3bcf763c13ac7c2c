"""Declarations of physical types and units (§7.3.4)."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.semantics.declarations.collect import dimension_of
from osc2tx.semantics.declarations.resolve_types import resolve_type_name
from osc2tx.semantics.resolution import Resolution, declared_here
from osc2tx.semantics.scope import Context
from osc2tx.semantics.symbols import PhysicalTypeSymbol, Symbol, UnitSymbol
from osc2tx.semantics.types import Dimension, PhysicalType
from osc2tx.semantics.units import LARGEST, SMALLEST, is_measurable
from osc2tx.syntax import ast


def check_physical_types(r: Resolution) -> None:
    """Check that each dimension has one type: the type of a unit would be ambiguous."""
    seen: dict[Dimension, PhysicalTypeSymbol] = {}
    for layer in reversed(list(r.scope.layers())):
        for symbol in layer.declared:
            if not isinstance(symbol, PhysicalTypeSymbol):
                continue
            earlier = seen.setdefault(symbol.dimension, symbol)
            if layer is r.scope:
                node = r.scope.nodes[symbol]
                if isinstance(node, ast.PhysicalTypeDeclaration):
                    _check_exponents(r, node.exponents)
                if earlier is not symbol and _is_declared(r, symbol):
                    _report_same_dimension(r, symbol, earlier)


def _is_declared(r: Resolution, symbol: PhysicalTypeSymbol) -> bool:
    """Whether the declaration is effective: no other one has its name and namespace."""
    return any(symbol is known for known in r.scope.types.get(symbol.name, ()))


def _report_same_dimension(
    r: Resolution, symbol: PhysicalTypeSymbol, earlier: PhysicalTypeSymbol
) -> None:
    known = f"{earlier.namespace}::{earlier.name}"
    what = f"`{symbol.name}` has the dimension of `{known}`, `{symbol.dimension}`"
    if not r.relaxes("OSC616", symbol.span, f"{what}; it is taken as the same", key=symbol.name):
        r.report(
            "OSC322",
            symbol.span,
            what,
            help=f"use `{earlier.name}`",
            labels=declared_here(earlier),
        )


def _check_exponents(r: Resolution, exponents: Sequence[ast.SiExponent]) -> None:
    given: set[str] = set()
    for exponent in exponents:
        if exponent.base in given:
            r.report("OSC305", exponent.span, f"the exponent of `{exponent.base}` is given twice")
        given.add(exponent.base)


def resolve_unit(r: Resolution, symbol: Symbol, context: Context) -> None:
    """Give a unit its type, and check that it fits."""
    node = r.scope.nodes[symbol]
    if not isinstance(symbol, UnitSymbol) or not isinstance(node, ast.UnitDeclaration):
        return
    physical = resolve_type_name(r, node.physical_type, context)
    if physical is None:
        return
    if not isinstance(physical, PhysicalTypeSymbol):
        r.report("OSC305", node.physical_type.span, f"`{physical.name}` is not a physical type")
        return
    _check_exponents(r, node.exponents)
    if node.factor == 0:
        r.report("OSC305", node.span, "a factor of zero makes all values of the unit one")
    elif not is_measurable(node.factor, node.offset):
        r.report(
            "OSC516",
            node.span,
            "the factor or the offset of the unit is out of range",
            notes=[
                f"the factor may be {SMALLEST:g} to {LARGEST:g}, the offset {LARGEST:g} at most"
            ],
        )
    symbol.type = PhysicalType(physical.name, physical.dimension)
    dimension = dimension_of(node.exponents)
    if dimension != physical.dimension:
        r.report(
            "OSC305",
            node.name.span,
            f"unit `{symbol.name}` has dimension `{dimension}`, "
            f"its type `{physical.name}` has `{physical.dimension}`",
        )
