"""The expected motion of a command in closed form."""

from __future__ import annotations

from osc2tx_runtime.world.step_inputs import Outlook

from .acceleration import AccelerationRun, ConstantAcceleration
from .execution import Longitudinal, ProfileRun

_PIECES = 64  # intervals between samples of the speed


def outlook_of(run: Longitudinal | None, steps: int, dt: float, *, moved: bool) -> Outlook | None:
    """The expected motion of an actor over a number of steps from the present one.

    Args:
        run: The execution of its command.
        steps: At least one.
        dt: Their length (s).
        moved: Whether its speed at the next step is already computed.

    Returns:
        None if the command does not determine it, or depends on other actors.
    """
    if not isinstance(run, ProfileRun | ConstantAcceleration | AccelerationRun):
        return None
    first, pieces = (-1 if moved else 0), min(steps, _PIECES)
    speeds = [run.foreseen(first + steps * i / pieces, dt) for i in range(pieces + 1)]
    return Outlook((sum(speeds) - 0.5 * (speeds[0] + speeds[-1])) / pieces, speeds[-1])
