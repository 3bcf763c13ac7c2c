"""Tracking of the reference by a driven actor, and completion of its command.

A command is done when its reference has reached the end *and* the actor was measured there, within
the tolerances. An actor that is late, or leaves its path, fails its command with the deviations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from osc2tx_runtime.world.measuring.deviation import (
    HEADING_TOLERANCE,
    OFF_ITS_PATH,
    PATIENCE,
    PLACE_TOLERANCE,
    SPEED_TOLERANCE,
    Deviation,
)
from osc2tx_runtime.world.protocol import LONGITUDINAL, PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState

_LEFT = 1.0  # s of deviation after which an actor has left its path


class Tracking:
    """The deviations of one actor over its steps."""

    def __init__(self) -> None:
        self._deviation: Deviation | None = None
        self._standing = False  # the reference
        self._late: dict[str, float] = {}
        self._astray = 0.0  # s of deviation from its path

    def step(
        self,
        state: ActorState,
        reference: ActorState,
        commanded: Mapping[str, Progress],
        dt: float,
    ) -> None:
        """Note a step.

        Args:
            state: Measured state at its end.
            reference: Reference at its end.
            commanded: Progress of the reference in each slot.
            dt: Its length (s).
        """
        self._deviation = Deviation.of(state, reference)
        self._standing = reference.v == 0.0
        for slot, progress in commanded.items():
            late = self._late.get(slot, -dt) + dt
            self._late[slot] = late if progress.done else -dt
        astray = abs(self._deviation.place) > OFF_ITS_PATH
        self._astray = self._astray + dt if astray else 0.0

    def forget(self, slot: str) -> None:
        """Restart with a new command of a slot."""
        self._late.pop(slot, None)

    def deviation(self, slots: Sequence[str]) -> Deviation | None:
        """Its deviation; None before a measurement."""
        if self._deviation is None:
            return None
        late = max((self._late.get(slot, 0.0) for slot in slots), default=0.0)
        return self._deviation._replace(late=max(late, 0.0))

    def progress(self, slot: str, commanded: Progress) -> Progress:
        """Progress of the command in a slot, given the progress of the reference."""
        if commanded.failed is not None or self._deviation is None:
            return commanded
        off = self._deviation
        if self._astray > _LEFT:
            return Progress(False, f"it deviated {abs(off.place):.1f} m from its path")
        if not commanded.done:
            return PENDING
        missed = self._missed(slot, off)
        if missed is None:
            return REACHED
        if self._late.get(slot, 0.0) > PATIENCE:
            return Progress(False, f"{missed}, {PATIENCE:g} s after its time of arrival")
        return PENDING

    def _missed(self, slot: str, off: Deviation) -> str | None:
        """The deviation at the present step; None if all is within the tolerances."""
        if slot == LONGITUDINAL:
            most = 0.0 if self._standing else SPEED_TOLERANCE
            return f"its speed deviates by {off.speed:+.2f} m/s" if abs(off.speed) > most else None
        if abs(off.place) > PLACE_TOLERANCE:
            return f"it is {abs(off.place):.2f} m off its path"
        if abs(off.heading) > HEADING_TOLERANCE:
            return f"its heading deviates by {math.degrees(off.heading):+.1f} degrees from its path"
        return None
