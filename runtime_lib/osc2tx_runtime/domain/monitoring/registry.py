"""The registry of monitors: the conditions of a modifier, or the reason why it has none."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeVar

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.monitoring.conditions import Condition
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase

Monitor = Callable[[Any, "Phase"], Iterable[Condition]]
"""Takes a modifier and its phase, whose first state is the present one."""

MONITORS: dict[str, Monitor] = {}
"""By the name of the modifier."""

CLARIFIED: dict[str, Callable[[Any, Phase], Iterable[Modifier | Condition]]] = {}
"""By the name of the action: the modifiers and conditions that it stands for."""

UNMONITORED: dict[str, str] = {}
"""Why there is no monitor, by the name of the modifier or action."""

MonitorT = TypeVar("MonitorT", bound=Callable[..., Any])


def monitors(name: str) -> Callable[[MonitorT], MonitorT]:
    """Register the decorated function as the monitor of a modifier."""

    def register(function: MonitorT) -> MonitorT:
        MONITORS[name] = function
        return function

    return register


def stands_for(*names: str) -> Callable[[MonitorT], MonitorT]:
    """Register the decorated function: the modifiers that actions of these names stand for."""

    def register(function: MonitorT) -> MonitorT:
        CLARIFIED.update(dict.fromkeys(names, function))
        return function

    return register


def unmonitored(reason: str, *names: str) -> None:
    """State why modifiers or actions have no monitor."""
    UNMONITORED.update(dict.fromkeys(names, reason))


def conditions_of(phase: Phase) -> Iterator[Condition]:
    """Yield the conditions of an action: those it implies, then those of its modifiers."""
    clarified = CLARIFIED.get(phase.action.registered.name)
    if clarified is not None:
        for each in clarified(phase.action, phase):
            for condition in (each,) if isinstance(each, Condition) else _stated(each, phase):
                yield replace(condition, is_target=True)
    for modifier, source in phase.action.with_sources():
        for condition in _stated(modifier, phase):
            yield replace(condition, source=source)


def _stated(modifier: Modifier, phase: Phase) -> Iterable[Condition]:
    monitor = MONITORS.get(modifier.name)
    return () if monitor is None else monitor(modifier, phase)
