"""Where a command in closed form will have led after a time."""

from __future__ import annotations

from osc2tx_runtime.world.step_inputs import Outlook

from .acceleration import AccelerationRun, AssignedSpeed, ConstantAcceleration
from .execution import Longitudinal, ProfileRun

_PIECES = 64  # of the time in which the way is summed up


def outlook_of(run: Longitudinal | None, steps: int, dt: float, *, moved: bool) -> Outlook | None:
    """What an actor will have done after so many steps from the present one.

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
    mean = (sum(speeds) - 0.5 * (speeds[0] + speeds[-1])) / pieces
    return Outlook(mean * steps * dt, speeds[-1])
