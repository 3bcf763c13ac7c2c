"""Attendance of a run: software under test that needs time, a spectator."""

from __future__ import annotations

import math
import select
import sys
import time
from collections.abc import Sequence
from dataclasses import field

from osc2tx_runtime.errors import SettingsError, SimulatorError
from osc2tx_runtime.opendrive import Pose
from osc2tx_shared.classes import dataclass
from osc2tx_shared.text import complain

from .cast import Command
from .client_process import ClientProcess
from .frames import transform_of

BEHIND, ABOVE, DOWN = 8.0, 4.0, math.radians(15.0)
"""Position of the camera relative to the actor that it follows (m), and its pitch."""


@dataclass
class Attendance:
    """Actions of a run for its observers; none of them changes a trace.

    Attributes:
        patience: Time (s) to wait for a first control; None: no wait.
        pace: Factor of real time; None: as fast as possible.
        viewed: The actor that the camera follows, if any.
    """

    patience: float | None = None
    pace: float | None = None
    viewed: str | None = None
    _camera: int | None = None
    _due: float = field(default=0.0)

    def wait_for_control(
        self, client: ClientProcess, actors: Sequence[int], *, ticks: bool
    ) -> None:
        """Delay the scenario until all these vehicles are controlled.

        Steps of the simulator continue meanwhile, as software under test may need them.

        Raises:
            SimulatorError: They are not controlled in time.
        """
        if self.patience is None or not actors:
            return
        complain(f"waiting for control ({self.patience:g} s at most; Enter begins at once)")
        end = time.monotonic() + self.patience
        while not client.ask("controlled", actors) and not _was_enter_pressed():
            if time.monotonic() > end:
                waited = f"{self.patience:g} s"
                raise SimulatorError(
                    f"--wait-control: the external actors are not controlled within {waited}"
                )
            client.ask("step", [])
            if ticks:
                time.sleep(0.02)  # faster than real time does not help software that attaches

    def take_camera(self, client: ClientProcess, actors: Sequence[str]) -> None:
        """Take the camera of the server's window, if it has to follow an actor."""
        if self.viewed is not None:
            if self.viewed not in actors:
                raise SettingsError(f"--carla-view {self.viewed}: the scenario has no such actor")
            self._camera = client.ask("spectator")

    def start(self) -> None:
        """Note the time of the first step."""
        self._due = time.monotonic()

    def pause(self, dt: float) -> None:
        """Wait until the next step of a length (s) may be made."""
        if self.pace is not None:
            self._due += dt / self.pace
            time.sleep(max(0.0, self._due - time.monotonic()))

    def view(self, pose: Pose) -> list[Command]:
        """Return the command that makes the camera follow an actor."""
        if self._camera is None:
            return []
        x = pose.x - BEHIND * math.cos(pose.h)
        y = pose.y - BEHIND * math.sin(pose.h)
        behind = Pose(x, y, pose.z + ABOVE, pose.h, DOWN)
        return [("place", self._camera, *transform_of(behind))]


def _was_enter_pressed() -> bool:
    """Return whether Enter was pressed at the terminal."""
    if not sys.stdin.isatty() or not select.select([sys.stdin], [], [], 0.0)[0]:
        return False
    sys.stdin.readline()
    return True
