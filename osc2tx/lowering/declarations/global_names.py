"""Names of global parameters (§7.3.14), which must differ from those of a scenario's own fields.

A global has its plain name, which settings use in all scenarios, or its full name if two namespaces
have the name. A field of the scenario that hides it gets a mark.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym


def global_name(ctx: LoweringContext, parameter: sym.FieldSymbol) -> str:
    """Return the name of a global parameter, and note that it is used."""
    name = _name(ctx, parameter)
    if name in ctx.own_names:
        name = f"{ir.GLOBAL_MARK}{name}"
    ctx.state.globals.setdefault(name, parameter)
    return name


def field_name(ctx: LoweringContext, field: sym.FieldSymbol) -> str:
    """Return the name of a field or global parameter in the scenario."""
    is_global = field.owner is None and field.node is not None
    return global_name(ctx, field) if is_global else field.name


def _name(ctx: LoweringContext, parameter: sym.FieldSymbol) -> str:
    """Return how settings of a run call a global parameter."""
    others = (other for other in ctx.model.global_parameters if other is not parameter)
    is_shared = any(other.name == parameter.name for other in others)
    return f"{parameter.namespace}::{parameter.name}" if is_shared else parameter.name
