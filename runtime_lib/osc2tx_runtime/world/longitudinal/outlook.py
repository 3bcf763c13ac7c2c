"""How a command in closed form will go on for a time."""

from __future__ import annotations

from osc2tx_runtime.world.step_inputs import Outlook

from .acceleration import AccelerationRun, AssignedSpeed, ConstantAcceleration
from .execution import Longitudinal, ProfileRun

_PIECES = 64  # of the time, at whose ends the speed is asked


def outlook_of(run: Longitudinal | None, steps: int, dt: float, *, moved: bool) -> Outlook | None:
    """How an actor will go on for so many steps from the present one.

    Args:
        run: Its command at work.
        steps: At least one.
        dt: Their length (s).
        moved: Its speed at the next step has been computed already.

    Returns:
        None if the command does not tell, or depends on others.
    """
    if isinstance(run, AssignedSpeed) or not isinstance(
        run, ProfileRun | ConstantAcceleration | AccelerationRun
    ):
        return None
    first, pieces = (-1 if moved else 0), min(steps, _PIECES)
    speeds = [run.foreseen(first + steps * i / pieces, dt) for i in range(pieces + 1)]
    return Outlook((sum(speeds) - 0.5 * (speeds[0] + speeds[-1])) / pieces, speeds[-1])
