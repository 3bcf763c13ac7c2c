"""Failures of members: another time than is written, or an end before the `until`.

A member of a race that fails leaves it; elsewhere the scenario fails, which the verdict of 1.3 can
tell.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from osc2tx.backends.xosc.conditions.flow import Flow
from osc2tx.backends.xosc.flattening.builder import StoryboardBuilder

Role: TypeAlias = Literal["alone", "racer", "in a race"]
"""Whether a member that fails takes the scenario with it, leaves a race, or others of a race."""


def fail_scenario(builder: StoryboardBuilder, name: str, failed: Flow) -> bool:
    """Let the scenario end with a flow; return whether the document can tell that it has failed."""
    ctx = builder.ctx
    can_tell = ctx.can("SetMonitorAction", "1.3")
    if can_tell:
        failed = builder.tell_failure(name, failed)
    elif not builder.is_outermost:  # events that are stopped with their act are complete too
        failed = builder.keep(ctx.names.new(name), failed)
    builder.finished = builder.finished | failed
    return can_tell
