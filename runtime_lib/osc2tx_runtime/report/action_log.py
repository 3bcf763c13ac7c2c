"""Pairs the start and the end lines of actions."""

from __future__ import annotations

from dataclasses import field

from osc2tx_classes import dataclass

from .json_values import Json, short, text

__all__ = ["ActionLog"]

_Key = tuple[str, str, str]


@dataclass
class _Action:
    """One action from its start to its end (s); `end` is None while it runs."""

    actor: str
    name: str
    source: str
    start: float
    end: float | None = None
    status: str = "running"
    reason: str = ""

    def as_json(self) -> Json:
        """The form the page reads."""
        return {
            "actor": self.actor,
            "name": self.name,
            "source": self.source,
            "start": short(self.start, 4),
            "end": None if self.end is None else short(self.end, 4),
            "status": self.status,
            "reason": self.reason,
        }


@dataclass
class ActionLog:
    """Collects action lines; equal actions are paired first in, first out."""

    _actions: list[_Action] = field(default_factory=list)
    _running: dict[_Key, list[_Action]] = field(default_factory=dict)

    def add(self, time: float, line: Json) -> None:
        """Take one line of kind "action" at `time` (s)."""
        actor, name, source = (
            text(line.get("actor")),
            text(line.get("name")),
            text(line.get("source")),
        )
        status = text(line.get("status"))
        waiting = self._running.setdefault((actor, name, source), [])
        if status == "start":
            waiting.append(self._begin(actor, name, source, time))
            return
        # An end without a start happens when a trace is cut: shown as an instant.
        action = waiting.pop(0) if waiting else self._begin(actor, name, source, time)
        action.end, action.status = time, status or "end"
        action.reason = text(line.get("reason"))

    def _begin(self, actor: str, name: str, source: str, time: float) -> _Action:
        action = _Action(actor, name, source, time)
        self._actions.append(action)
        return action

    def as_json(self) -> list[Json]:
        """All actions in order of their starts."""
        ordered = sorted(self._actions, key=lambda action: action.start)
        return [action.as_json() for action in ordered]
