"""The friction circle: limits of the speed that a vehicle can follow."""

from __future__ import annotations

from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.state import ActorState

from .friction import RoadCondition, along_limit, grip

_PROBE = 1.0  # m along the lane over which its curvature is taken


class Wheels:
    """Grip of one vehicle on the road.

    Attributes:
        road: Condition of the road.
        slipping: In the last step it could not follow the wanted speed.
        sliding: Why it cannot follow its lane; None while it can.
    """

    def __init__(self, road: RoadCondition) -> None:
        self.road = road
        self.slipping = False
        self.sliding: str | None = None
        self._aside = 0.0  # m/s across the lane, one step before

    @property
    def limited(self) -> bool:
        """True if the road takes anything away."""
        return self.road != "dry"

    def held(self, wanted: float, state: ActorState, curvature: float, dt: float) -> float:
        """Speed (m/s) at the next step: the wanted one, as far as the friction circle allows.

        Args:
            wanted: Speed that is commanded.
            state: Present state.
            curvature: Of the way (1/m).
            dt: Length of the step (s).
        """
        across = state.v * state.v * curvature + (state.lateral_speed - self._aside) / dt
        self._aside = state.lateral_speed
        most = grip(self.road)
        left = along_limit(most, across)
        self.sliding = None
        if left is None:
            self.sliding = (
                f"it slides: lateral acceleration {abs(across):.2f} m/s^2 exceeds the grip limit of"
                f" {most:.2f} m/s^2"
            )
            left = 0.0
        speed = min(max(wanted, state.v - left * dt), state.v + left * dt)
        self.slipping = abs(speed - wanted) > 1e-9
        return speed


def curvature_ahead(road_map: RoadMap, place: LanePosition | None, route: Route | None) -> float:
    """Curvature (1/m) of the lane right ahead; 0 off the lanes and at their end."""
    if place is None:
        return 0.0
    step = road_map.advance(place, _PROBE, route)
    if step.travelled < 0.5 * _PROBE:
        return 0.0
    turn = turn_between(road_map.pose(place).h, road_map.pose(step.position).h)
    return turn / step.travelled
