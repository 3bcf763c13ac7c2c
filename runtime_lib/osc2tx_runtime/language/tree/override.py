"""The modifier `override`: one behavior ends or blocks another."""

from __future__ import annotations

from typing import Any, Literal

from py_trees.decorators import Decorator

from osc2tx_runtime.language.tree.base import (
    INVALID,
    RUNNING,
    SUCCESS,
    Activity,
    Behaviour,
    Node,
    Status,
)
from osc2tx_runtime.language.tree.members import ended_late, pulse_of

Mode = Literal["on_start", "when_active"]


class Overridden(Node, Decorator):
    """Encloses a behavior that others override.

    It ends with success when one of them starts; with `when_active` it is also skipped, with
    success, if one of them runs when it would start. Changes of a pass are visible from the next
    pass, so the order of the visit has no effect.

    Args:
        behavior: The overridden behavior.
    """

    synthetic = True

    def __init__(self, behavior: Behaviour) -> None:
        super().__init__(name=f"{behavior.name} unless overridden", child=behavior)
        self.source = getattr(behavior, "source", "")
        self._by: list[tuple[str, Activity, Mode]] = []
        self._begun = 0

    def add(self, by: Node, mode: Mode) -> None:
        """Let another behavior override this one."""
        by.activity = by.activity or Activity()
        self._by.append((by.label or by.name, by.activity, mode))

    def setup(self, **kwargs: Any) -> None:
        """Take the context, and the nature of the behavior."""
        super().setup(**kwargs)
        child = self.decorated
        self._pulse_child = pulse_of(child)
        self.open_ended = isinstance(child, Node) and child.open_ended
        self.instant = isinstance(child, Node) and child.instant
        self.may_end = True  # so an open-ended behavior may have successors in a serial

    def initialise(self) -> None:
        """Store the pass of the start."""
        self._begun = self.context.tick

    def goes_on(self) -> bool:
        """Return whether only the surroundings of the behavior end it."""
        return isinstance(self.decorated, Node) and self.decorated.goes_on()

    def open_since(self) -> tuple[int, float]:
        """Return since when only they do."""
        child = self.decorated
        return child.open_since() if isinstance(child, Node) else super().open_since()

    def lateness(self) -> float:
        """Return the status of the behavior, if it has ended."""
        return ended_late(self.decorated) if self.decorated.status is SUCCESS else 0.0

    def pulse(self) -> Status:
        """Run the behavior unless it is overridden."""
        tick = self.context.tick
        if self.status is not RUNNING:
            blocking = [n for n, a, mode in self._by if mode == "when_active" and a.is_active(tick)]
            if blocking:
                self._note("skipped", blocking)
                self.status = SUCCESS
                return SUCCESS
            self._begin()
        ending = [name for name, a, _ in self._by if a.started_since(self._begun, tick)]
        if ending:
            self._note("ended", ending)
            for node in self.decorated.children:  # interrupted; the behavior itself has ended
                if node.status is RUNNING:
                    node.stop(INVALID)
            if self.context.monitors is not None:
                self.context.monitors.leaves(self.decorated)
            self.stop(SUCCESS)
            return self.status
        status = self._pulse_child()
        if status is not RUNNING:
            self.stop(status)
        return self.status

    def _note(self, what: str, by: list[str]) -> None:
        child = self.decorated
        name = getattr(child, "label", None) or child.name
        self.context.trace.override(name, what, sorted(by)[0], self.source)


def guard(node: Node) -> Overridden:
    """Return the guard around a node; create it if there is none."""
    above = node.parent
    if isinstance(above, Overridden):
        return above
    node.parent = None
    made = Overridden(node)
    if above is not None:
        above.children[above.children.index(node)] = made
        made.parent = above
        if isinstance(above, Decorator):
            above.decorated = made
    return made
