"""Checks that the modifiers of an action can be combined, before the run."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeAlias

from osc2tx_runtime.domain.modifiers.calls import RULES, ModifierCall
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_shared.rules import Clash, Timing, clashes, is_across

if TYPE_CHECKING:
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion

_Clash: TypeAlias = Clash[ModifierCall]


def check_modifiers(action: ModifiedMotion) -> None:
    """Reject modifiers that contradict each other, or have no effect here.

    Raises:
        UnsupportedError: They cannot be executed together, or at that time.
        ScenarioError: A modifier is given twice, or without one that it requires.
    """
    calls = [ModifierCall(modifier) for modifier in action.modifiers]
    duration = action.duration
    seconds = float(duration) if isinstance(duration, int | float) else None
    timing = Timing(duration is not None, action.end_is_known, seconds)
    for clash in clashes(calls, RULES, timing):
        error = _error(action.action_name, clash)
        error.source = action.source or None
        raise error


def _error(action: str, clash: _Clash) -> ScenarioError:
    *_, last = clash.calls
    match clash.kind:
        case "same thing":
            both = " and ".join(call.name for call in clash.calls)
            return UnsupportedError(f"{action}: {both} constrain the same motion; give one")
        case "twice":
            return ScenarioError(f"{action} has {last.name} twice")
        case "no start":
            return UnsupportedError(f"{action}: {last.name} {clash.text}")
        case "contradiction":
            return UnsupportedError(f"{action}: {clash.text}")
        case "rule":
            return ScenarioError(f"{action}: {last.name}: {clash.text}")


def check_options(action: ModifiedMotion) -> None:
    """Reject options of vehicles on lanes for other actors; called when the actor is known.

    Raises:
        UnsupportedError: The actor does not follow lanes.
    """
    if not action.movable.lane_bound:
        for text in _bound_to_lanes(action):
            raise UnsupportedError(f"{action.action_name}: {text}", action.source or None)


def _bound_to_lanes(action: ModifiedMotion) -> Iterator[str]:
    for call in map(ModifierCall, action.modifiers):
        if is_across(call, RULES):
            yield "only vehicles on lanes have a lateral speed"
        if call.modifier.facts.rules.lanes_only and call.at != "start":
            yield f"{call.name} is for vehicles, which follow lanes"
