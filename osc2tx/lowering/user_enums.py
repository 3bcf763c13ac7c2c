"""Enums that the scenario's files declare, as types of the module."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym


def lower_enums(model: SemanticModel, module: ir.Module) -> tuple[ir.UserEnum, ...]:
    """Return the enums of the root file, and those of imported files that a module speaks of.

    Args:
        model: The checked program.
        module: Its other parts.
    """
    lowered = tuple(map(_lower_enum, _user_enums(model)))
    own = {each.span for each in lowered if each.span.source is model.root.span.source}
    if len(own) == len(lowered):
        return lowered
    words = set(ir.words((module.scenarios, module.types, module.actions, module.modifiers)))
    return tuple(each for each in lowered if each.span in own or each.name in words)


def _user_enums(model: SemanticModel) -> Iterator[sym.EnumSymbol]:
    return (each for each in model.symbols if isinstance(each, sym.EnumSymbol))


def _lower_enum(symbol: sym.EnumSymbol) -> ir.UserEnum:
    type_ = lower_type(types.EnumType(symbol))
    return ir.UserEnum(name=type_.name, span=symbol.span, members=type_.members)
