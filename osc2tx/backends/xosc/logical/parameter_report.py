"""Entries of the loss report about open parameters."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.logical.documents import Logical
from osc2tx.backends.xosc.logical.parameters import OpenParameter, told
from osc2tx.backends.xosc.scopes import key_of
from osc2tx.losses.entries import NOTHING, Remedy

MOST_NAMES = 4
"""Parameters of the document that a note names."""


def report_parameters(found: Logical, parameters: Sequence[OpenParameter]) -> None:
    """Say which parameters can still be chosen, and what the others are."""
    known = {parameter.key for parameter in parameters}
    for parameter in parameters:
        if parameter in found.kept and found.ctx.version >= "1.1":
            note = _note(found, parameter)
            found.ctx.report.exact(parameter.construct, parameter.span, note)
        else:
            _report_loss(found, parameter)
    for scope in found.ctx.scope.all():
        for declaration in scope.scenario.declarations:
            if (
                isinstance(declaration, ir.Parameter)
                and declaration.value is None
                and key_of(scope.path, declaration) not in known
                and not scope.values.is_given(declaration.name)
            ):
                _report_value(found.ctx, declaration)


def _report_value(ctx: Context, declaration: ir.Parameter) -> None:
    """Report a parameter that is none of the document."""
    construct = f"parameter {declaration.name}"
    match declaration.domain:
        case ir.RangeValue():
            ctx.report.exact(construct, declaration.span, "it has just one value")
        case ir.Choices():
            reason = "OpenSCENARIO XML has no parameters with such values"
            bound = "every run is one that the scenario allows; it always has the first value"
            ctx.report.approximate(construct, declaration.span, reason, bound)


def _note(found: Logical, parameter: OpenParameter) -> str:
    """Return what follows from a parameter that stays open."""
    following = found.causes.get(parameter.key, ())
    if not following:
        return ""
    named = ", ".join(following[:MOST_NAMES])
    more = f" and {len(following) - MOST_NAMES} more" if len(following) > MOST_NAMES else ""
    follow = "follows" if len(following) == 1 else "follow"
    return f"{named}{more} {follow} from it in each row of the table of values"


def _report_loss(found: Logical, parameter: OpenParameter) -> None:
    ctx, point = found.ctx, found.ctx.choosing.point
    if parameter in found.kept:
        reason = "OpenSCENARIO XML 1.0 has parameters, but no values for them"
        remedy = Remedy(version="1.1")
    elif ctx.version == "1.0":
        reason = "OpenSCENARIO XML 1.0 has no expressions and no values for parameters"
        remedy = Remedy(version="1.1")
    else:
        reason = "which elements there are depends on it"
        remedy = NOTHING
    values = parameter.told(found.domain.values(parameter, point))
    bound = f"{parameter.name} is {told(point[parameter.key])} of {values}"
    ctx.report.approximate(
        parameter.construct,
        parameter.span,
        reason,
        f"every run is one that the scenario allows; {bound}",
        remedy,
    )
