"""The monitors of a run: the phases of the running actions."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.monitoring.phase import UNMEASURABLE, Phase, Violation
from osc2tx_runtime.domain.monitoring.registry import conditions_of
from osc2tx_runtime.language.actions.action import Action

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.base_action import BaseAction
    from osc2tx_runtime.language.context import ExecutionContext


class Monitors:
    """Checks each phase of a run, from states alone.

    Args:
        context: The run.

    Attributes:
        violations: The findings of the phases that have ended.
    """

    def __init__(self, context: ExecutionContext) -> None:
        self._context = context
        self._begun: list[Action] = []
        self._phases: dict[Action, Phase] = {}
        self._watched: list[Phase] = []
        self._resting: dict[str, list[Phase]] = {}  # by actor
        self._unsteady: Collection[str] = ()  # actors, up to the step before
        self.violations: list[Violation] = []

    def begins(self, action: BaseAction) -> None:
        """Register a phase that begins; its first state is the one of the settled instant."""
        if isinstance(action, Action) and action.actor.id in self._context.cast():
            self._begun.append(action)

    def observe(self) -> None:
        """Check the states of a settled instant; phases of actors with unchanged motion rest."""
        context = self._context
        time, unsteady = context.time, context.world.unsteady()
        if self._resting and (unsteady or self._unsteady):
            for actor in (*unsteady, *self._unsteady):
                self._watched += self._resting.pop(actor, ())
        self._unsteady = unsteady
        if self._watched:
            watched = []
            for phase in self._watched:
                phase.observe(time)
                if phase.rests:
                    self._resting.setdefault(phase.actor, []).append(phase)
                else:
                    watched.append(phase)
            self._watched = watched
        if self._begun:
            for action in self._begun:
                phase = Phase(action, context.world, time, context.dt)
                try:
                    is_watched = phase.begin(conditions_of(phase))
                except UNMEASURABLE:  # no value: the planning reports it
                    continue
                self._phases[action] = phase
                if is_watched:
                    self._watched.append(phase)
            self._begun.clear()

    def leaves(self, action: BaseAction) -> None:
        """Drop a phase that is interrupted: its conditions no longer count."""
        self._close(action)

    def ends(self, action: BaseAction) -> list[Violation]:
        """Check the last state of a phase; return the violations that fail it."""
        phase = self._close(action)
        if phase is None:
            return []
        phase.end(self._context.time)
        found = phase.violations()
        self.violations += found
        for violation in found:
            self._context.trace.violation(violation.words(), violation.source)
        return [each for each in found if each.severity == "failure"]

    def _close(self, action: BaseAction) -> Phase | None:
        if not isinstance(action, Action):
            return None
        if action in self._begun:
            self._begun.remove(action)
        phase = self._phases.pop(action, None)
        if phase is None:
            return None
        for phases in (self._watched, self._resting.get(phase.actor, [])):
            if phase in phases:
                phases.remove(phase)
        return phase
