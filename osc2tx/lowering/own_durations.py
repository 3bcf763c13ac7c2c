"""How long a scenario takes where its constraints say so: `keep(duration == 3s)` (§7.3.5.1.3)."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis import single_value
from osc2tx.analysis.operation_list import Key
from osc2tx.lowering.composed_behaviors import Composed
from osc2tx.lowering.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.open_durations import with_open_duration
from osc2tx.semantics.builtins import DURATION
from osc2tx_classes import replace

_OWN: Key = (DURATION,)


def own_duration(ctx: LoweringContext, constraints: ConstraintLowering) -> ir.Expression | None:
    """Return the duration of a scenario, or its bounds; others may then compute with it."""
    if _OWN not in constraints.found.by_key:
        return None
    setting = constraints.setting(_OWN, DURATION.type)
    if setting.value is not None:
        ctx.given[_OWN] = setting.value
        return setting.value
    match setting.domain:
        case ir.RangeValue() as bounds:
            return bounds
        case ir.Choices() as listed:
            drawn = ctx.draw("duration", listed, listed.elements[0].type)
            ctx.given[_OWN] = drawn
            return drawn
    return None


def leaves_duration_open(ctx: LoweringContext, behavior: Composed) -> bool:
    """Whether constraints in a behavior say how long it takes, and let it be several times."""
    found = ctx.analysis.types[behavior]
    if _OWN not in found.by_key:
        return False
    domain = found.domains_to_set().get(_OWN)
    return domain is None or single_value(domain) is None


def lasting(ctx: LoweringContext, body: ir.Behavior, duration: ir.Expression | None) -> ir.Behavior:
    """Return a body that takes so long."""
    if duration is None:
        return body
    made: ir.Serial | ir.Parallel | ir.OneOf
    if isinstance(body, ir.Serial | ir.Parallel | ir.OneOf) and body.duration is None:
        made = replace(body, duration=duration)
    else:
        made = ir.Serial(
            span=body.span, label=None, name=body.name, members=(body,), duration=duration
        )
    return with_open_duration(ctx, made, "duration")
