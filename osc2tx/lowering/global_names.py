"""Names of global parameters (§7.3.14), which must differ from those of a scenario's own fields.

A global goes by its plain name, by which settings know it in all scenarios; where two namespaces
have one of a name, by its full name. A field of the scenario that hides it stands apart by a mark.
"""

from __future__ import annotations

from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym

# Cannot be in a name of the language, so no field has it.
MARK = "global "


def global_name(ctx: LoweringContext, parameter: sym.FieldSymbol) -> str:
    """Return the name of a global parameter, and note that it is used."""
    name = setting_name(ctx, parameter)
    if name in ctx.own_names:
        name = f"{MARK}{name}"
    ctx.globals.setdefault(name, parameter)
    return name


def setting_name(ctx: LoweringContext, parameter: sym.FieldSymbol) -> str:
    """Return how settings of a run call a global parameter."""
    others = (
        symbol
        for symbol in ctx.model.symbols
        if isinstance(symbol, sym.FieldSymbol) and symbol.owner is None
    )
    is_shared = any(o is not parameter and o.name == parameter.name for o in others)
    return f"{parameter.namespace}::{parameter.name}" if is_shared else parameter.name
