"""Reports about changes of the speed that a tool makes otherwise than the world."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.facts.actors import way_by_acceleration
from osc2tx.backends.xosc.report import Remedy
from osc2tx.backends.xosc.state import STEADY, known

GENERIC = Remedy(profile="generic")


def note_acceleration(leaf: Leaf, target: float, profile: str, peak: float | None) -> None:
    """Report that a change takes over an acceleration: that of the XML begins without any."""
    rate, speed, limits = leaf.state.rate, leaf.state.speed, leaf.limits
    rates = leaf.state.pending if rate is None else known(rate)
    if rates == STEADY or leaf.ctx.profile.carries_acceleration:
        return
    if speed is None:
        time = max(map(abs, rates)) / limits.jerk
        bound = f"it comes to its speed at most {2.0 * time:.2g} s sooner or later"
    else:
        ways = [way_by_acceleration(v, target, profile, peak, rates, limits) for v in speed]
        bound = f"at most {max(ways):.2g} m ahead or behind"
    leaf.ctx.report.approximate(
        leaf.construct,
        leaf.node.span,
        "it takes over the acceleration of the change before; one of the XML begins without any",
        bound,
        Remedy(profile="esmini"),
    )
