"""Vehicle lights that depend on the motion, which CARLA does not switch itself."""

from __future__ import annotations

from osc2tx_runtime.world.plant.scene import Setpoint

BRAKE, RIGHT, LEFT, REVERSE = 8, 16, 32, 64
"""Flags of `carla.VehicleLightState`."""

ON, OFF = 1.3, 0.7
"""Decelerations (m/s^2) above which brake lights shine, and below which they must not (UN
Regulation 13-H, 5.2.22); between them they are unchanged."""

ASIDE = 0.1  # m/s across the lane


class MotionLights:
    """Brake, turn and reversing lights of one vehicle."""

    def __init__(self) -> None:
        self._brake, self._turn = 0, 0

    def after(self, setpoint: Setpoint) -> int:
        """Return the flags for a commanded step.

        After braking to standstill the brake remains applied. A turn light shines from the start of
        a lane change until the lateral motion ends.
        """
        state = setpoint.state
        if state.v:
            slowing = -state.a if state.v > 0.0 else state.a
            self._brake = BRAKE if slowing > (OFF if self._brake else ON) else 0
        if abs(state.lateral_speed) < ASIDE:
            self._turn = 0
        elif setpoint.changes_lane:
            self._turn = LEFT if state.lateral_speed > 0.0 else RIGHT
        return self._brake | self._turn | (REVERSE if state.v < 0.0 else 0)
